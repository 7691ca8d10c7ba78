"""Down a chain of halved pictures, and up again."""

from pathlib import Path

from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...pictures.canvas import Canvas, interpolate
from ...shaders import source
from ...stage import Stage
from .twin import sizes


class Passes:
    """Draws the picture with its bloom.

    Attributes:
        image: the texture that holds it.
    """

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        self._device = stage.device
        halves = sizes(stage.size, int(knobs["levels"]))
        self._halves = [Canvas(stage.device, size) for size in halves]
        self._mixed = [Canvas(stage.device, size) for size in (stage.size, *halves[:-1])]
        self._halve = FullscreenPass(stage.device, source("halve.frag", folder=folder), {})
        self._mix = FullscreenPass(stage.device, source("mix_up.frag", folder=folder), {})
        self._shares = [float(knobs["strength"]), *[float(knobs["spread"])] * (len(halves) - 1)]
        self.image = self._mixed[0].texture

    def draw(self, image) -> None:
        """Of `image`, a texture."""
        interpolate(self._device, image)
        larger = [image, *(half.texture for half in self._halves)]
        for source_picture, half in zip(larger, self._halves, strict=False):
            self._halve.draw(half.framebuffer, {"image": source_picture}, values={"half_size": half.size})
        smaller = self._halves[-1].texture
        for picture, mixed, share in reversed(list(zip(larger, self._mixed, self._shares, strict=False))):
            self._mix.draw(mixed.framebuffer, {"image": picture, "smaller": smaller}, values={"share": share})
            smaller = mixed.texture
