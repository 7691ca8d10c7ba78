"""Bright blocks, their blur along rows and columns, and the sum."""

from pathlib import Path

from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...pictures.blocks import BrightBlocks, WithBlocks
from ...pictures.canvas import Canvas
from ...shaders import source
from ...stage import Stage
from .blur import blur_radius, blur_sigma


class Passes:
    """Draws the picture with its bloom.

    Attributes:
        image: the texture that holds it.
    """

    def __init__(self, stage: Stage, knobs: Knobs, _folder: Path) -> None:
        divisor = int(knobs["divisor"])
        self._bright = BrightBlocks(stage.device, stage.size, float(knobs["threshold"]), divisor)
        self._rows, self._both = (Canvas(stage.device, self._bright.size) for _ in range(2))
        sigma = blur_sigma(knobs, stage.size[1])
        values = {"sigma": sigma, "radius": blur_radius(sigma)}
        self._blur = FullscreenPass(stage.device, source("gaussian_blur.frag"), values)
        self._sum = WithBlocks(stage.device, stage.size, float(knobs["strength"]), divisor)
        self.image = self._sum.texture

    def draw(self, image) -> None:
        """Of `image`, a texture."""
        self._bright.draw(image)
        self._blur.draw(self._rows.framebuffer, {"image": self._bright.texture}, values={"direction": (1, 0)})
        self._blur.draw(self._both.framebuffer, {"image": self._rows.texture}, values={"direction": (0, 1)})
        self._sum.draw(image, self._both.texture)
