"""Logarithms of the luminance at the grid's places, and their mean by mip levels."""

import math
from pathlib import Path

from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...pictures.canvas import Canvas, interpolate
from ...shaders import source
from ...stage import Stage


class Passes:
    """Meters a picture.

    Attributes:
        average: a texture of one texel, the log₂ of the average luminance.
    """

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        device, side, metering = stage.device, int(knobs["side"]), stage.scene.camera.metering
        assert metering is not None
        self._device = device
        self._grid, self._mean = Canvas(device, (side, side)), Canvas(device, (1, 1))
        values = {"floor_luminance": metering.floor, "side": side}
        self._look_up = FullscreenPass(device, source("log_luminance.frag", folder=folder), values)
        last = source("last_level.frag", folder=folder)
        self._last = FullscreenPass(device, last, {"level": math.log2(side)})
        self.average = self._mean.texture

    def draw(self, image) -> None:
        """Of `image`, a texture."""
        interpolate(self._device, image)
        self._look_up.draw(self._grid.framebuffer, {"image": image})
        self._grid.texture.build_mipmaps()
        self._last.draw(self._mean.framebuffer, {"logarithms": self._grid.texture})
