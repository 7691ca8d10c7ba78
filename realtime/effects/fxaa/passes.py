"""One pass over the code values."""

from pathlib import Path

from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...pictures.canvas import Codes
from ...shaders import source
from ...stage import Stage


class Passes:
    """Draws the filtered picture.

    Attributes:
        image: the texture that holds it.
    """

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        self._codes = Codes(stage.device, stage.size)
        self._pass = FullscreenPass(stage.device, source("fxaa.frag", folder=folder), dict(knobs))
        self.image = self._codes.texture

    def draw(self, image) -> None:
        """Of `image`, a texture of code values."""
        self._pass.draw(self._codes.framebuffer, {"image": image})
