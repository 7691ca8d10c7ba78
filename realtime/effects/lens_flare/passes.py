"""Bright blocks, their ghosts, and the sum."""

from pathlib import Path

from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...pictures.blocks import BrightBlocks, WithBlocks
from ...pictures.canvas import Canvas
from ...shaders import source
from ...stage import Stage


class Passes:
    """Draws the picture with its flare.

    Attributes:
        image: the texture that holds it.
    """

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        divisor = int(knobs["divisor"])
        self._bright = BrightBlocks(stage.device, stage.size, float(knobs["threshold"]), divisor)
        self._ghosts = Canvas(stage.device, self._bright.size)
        self._pass = FullscreenPass(stage.device, source("ghosts.frag", folder=folder), dict(knobs))
        self._sum = WithBlocks(stage.device, stage.size, float(knobs["strength"]), divisor)
        self.image = self._sum.texture

    def draw(self, image) -> None:
        """Of `image`, a texture."""
        self._bright.draw(image)
        self._pass.draw(self._ghosts.framebuffer, {"bright": self._bright.texture})
        self._sum.draw(image, self._ghosts.texture)
