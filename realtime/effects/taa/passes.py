"""Two pictures in turn: the history, and what becomes of it."""

from pathlib import Path

from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...pictures.canvas import Canvas
from ...shaders import source
from ...stage import Stage
from .twin import share


class Passes:
    """Blends frames as they are drawn."""

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        self._blend = float(knobs["blend"])
        self._shown, self._next = (Canvas(stage.device, stage.size) for _ in range(2))
        defines = {"CLAMP": bool(knobs["clamp"]), "WEIGH": bool(knobs["weigh"])}
        values = {"exposure_scale": stage.scene.camera.exposure_scale()}
        self._pass = FullscreenPass(stage.device, source("taa.frag", defines, folder), values)
        self._frames = 0

    @property
    def texture(self):
        """What is shown."""
        return self._shown.texture

    def clear(self) -> None:
        """Forget the history."""
        self._frames = 0

    def add(self, radiance) -> None:
        """Blend a new frame, a texture, into the history."""
        textures = {"current": radiance, "history": self._shown.texture}
        self._pass.draw(self._next.framebuffer, textures, values={"share": share(self._frames, self._blend)})
        self._shown, self._next = self._next, self._shown
        self._frames += 1
