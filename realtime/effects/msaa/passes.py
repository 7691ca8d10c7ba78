"""Finds the pixels that several triangles share, masks the others, and puts the pixel together."""

from pathlib import Path
from typing import Any

from ...averager import Averager
from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...gbuffer import GBuffer
from ...pictures.canvas import Canvas
from ...shaders import source
from ...stage import Stage
from . import offsets


class Passes:
    """Gathers the centre and the pattern's samples, in this order. After the centre only edges are lit."""

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        device, self._device, self._pattern = stage.device, stage.device, offsets(knobs)[1:]
        given = device, stage.geometry, stage.scene, stage.size, frozenset({"position"}), None
        self._first, self._other = GBuffer(*given, identity=True), GBuffer(*given, identity=True)
        self._found, self._edges = Canvas(device, stage.size), Canvas(device, stage.size)
        self._mean, self._centre, self._result = (Canvas(device, stage.size) for _ in range(3))
        self._compare = FullscreenPass(device, source("compare.frag", folder=folder), {})
        self._resolve = FullscreenPass(device, source("resolve.frag", folder=folder), {})
        self._averager = Averager(device)
        self._mask = None if stage.mask is None else Mask(device, stage.mask, folder)
        self._drawn = 0
        self.texture = self._result.texture

    def clear(self) -> None:
        """Begin with the pixels' centres, all of them."""
        self._drawn = 0
        self._find_edges()
        self._centre.framebuffer.clear()
        self._mean.framebuffer.clear()

    def add(self, radiance: Any) -> None:
        """Take the next sample, a texture of scene-linear radiance."""
        target, share = (self._mean, 1.0 / len(self._pattern)) if self._drawn else (self._centre, 1.0)
        self._averager.add(radiance, target.framebuffer, share)
        if self._drawn == 0 and self._mask is not None:
            self._mask.draw(self._edges.texture)
        self._drawn += 1
        if self._drawn > len(self._pattern):
            textures = {"edges": self._edges, "centre": self._centre, "mean": self._mean}
            self._resolve.draw(self._result.framebuffer, {name: canvas.texture for name, canvas in textures.items()})

    def _find_edges(self) -> None:
        """One where the pattern's samples see more than one triangle."""
        self._edges.framebuffer.clear()
        self._first.draw(tuple(self._pattern[0]))
        for offset in self._pattern[1:]:
            self._other.draw(tuple(offset))
            textures = {name: self._other.textures[name] for name in ("identity", "position")}
            textures |= {f"first_{name}": self._first.textures[name] for name in ("identity", "position")}
            self._compare.draw(self._found.framebuffer, textures)
            self._averager.add(self._found.texture, self._edges.framebuffer, 1.0)


class Mask:
    """Keeps full-screen passes from the pixels that are no edges."""

    def __init__(self, device: Any, depth: Any, folder: Path) -> None:
        self._device, self._target = device, device.framebuffer([], depth)
        self._program = device.program(source("mask.frag", folder=folder))
        self._vertices = device.fullscreen(self._program)

    def draw(self, edges: Any) -> None:
        """Let only these through, a texture."""
        gl = self._device.gl
        self._target.use()
        self._target.clear(depth=0.0)
        gl.enable_only(gl.DEPTH_TEST)
        gl.depth_func = ">="
        edges.use(0)
        self._device.draw(self._vertices, 3)
        gl.depth_func = "<"
