"""The passes of a screen-space occlusion: the technique itself, at full or half resolution, and its blur."""

from pathlib import Path
from typing import Any

import numpy as np

from ..effect import Knobs
from ..projection import viewer
from ..shaders import Source, source
from ..stage import Stage
from ..uniforms import Uniforms, bind, set_uniforms
from .knobs import scale

SURFACE_THICKNESS = 0.05
"""Of the radius: what lies farther from a surface's plane is another surface, for blur and interpolation."""


class ScreenOcclusion:
    """Fills a texture with mean visible direction and visibility from what the G-buffer shows.

    Args:
        technique: the GLSL file with `vec4 occlusion(Surface, ivec2)`.
        defines, values: what it is compiled with and told, besides the knobs and the camera's frame.
    """

    def __init__(
        self,
        stage: Stage,
        knobs: Knobs,
        folder: Path,
        technique: str,
        defines: dict[str, object] | None = None,
        values: dict[str, Any] | None = None,
    ) -> None:
        self._stage, self._scale = stage, scale(knobs)
        self._thickness = SURFACE_THICKNESS * float(knobs["radius"])
        device, common = stage.device, stage.gbuffer.defines() | {"SCALE": self._scale}
        text = source("occlusion.frag", common | (defines or {})).text
        body = source(technique, folder=folder).text.removeprefix("#version 410\n")
        self._technique = device.program(Source(text.replace("EFFECT", body)))
        told = dict(knobs) | camera_frame(stage) | (values or {})
        self._told = Uniforms(self._technique, told)
        self._found = self._target()
        self._vertices = device.fullscreen(self._technique)
        self._blurred: Any = None
        if knobs["blur"] != "none":
            program = device.program(source("occlusion_blur.frag", common | {"SAME_SURFACE": knobs["blur"] != "box4"}))
            values = {"viewer": viewer(stage.scene.camera), "thickness": self._thickness}
            self._blurred = self._target(), program, Uniforms(program, values), device.fullscreen(program)

    def _target(self) -> tuple[Any, Any]:
        width, height = (-(-side // self._scale) for side in self._stage.size)
        texture = self._stage.device.target((width, height))
        return self._stage.device.framebuffer([texture]), texture

    def defines(self, _light: int | None) -> dict[str, object]:
        """What the shader that looks the occlusion up is compiled with."""
        return {"SCALE": self._scale}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """How far apart the places of one surface may lie."""
        return {"thickness": self._thickness}

    def textures(self, _light: int | None) -> dict[str, Any]:
        """What was found."""
        (_, texture), *_ = self._blurred or (self._found,)
        return {"occlusion_buffer": texture}

    def draw(self, _light: int | None) -> None:
        """Fill the texture from what the G-buffer holds now."""
        device, gbuffer = self._stage.device, self._stage.gbuffer
        buffers = gbuffer.samplers
        framebuffer, texture = self._found
        framebuffer.use()
        device.gl.enable_only(device.gl.NOTHING)
        self._told.write()
        set_uniforms(self._technique, {"view_projection": gbuffer.view_projection} | gbuffer.place)
        bind(self._technique, buffers)
        device.draw(self._vertices, 3)
        if self._blurred:
            (framebuffer, _), program, told, vertices = self._blurred
            framebuffer.use()
            told.write()
            set_uniforms(program, gbuffer.place)
            bind(program, buffers | {"occlusion_buffer": texture})
            device.draw(vertices, 3)


def camera_frame(stage: Stage) -> dict[str, Any]:
    """The camera as screen-space shaders take it: axes, how many pixels a metre has one metre away, and the size."""
    camera = stage.scene.camera
    axes = camera.matrix[:3, :3] / np.linalg.norm(camera.matrix[:3, :3], axis=0)
    half = camera.ymag if camera.yfov is None else np.tan(camera.yfov / 2)
    return {
        "viewer": viewer(camera),
        "camera_right": axes[:, 0],
        "camera_up": axes[:, 1],
        "camera_back": axes[:, 2],
        "pixels_per_metre": stage.size[1] / 2 / half,
        "screen_size": stage.size,
    }
