"""The lit frame so far: what surfaces have scattered towards the viewer when an effect that reads it is drawn."""

from typing import Any

import numpy as np

from .averager import Averager
from .device import Device


class ScatteredLight:
    """Direct and environment light as the frame has them: without what surfaces emit, and 0 where none is seen.

    Emission seen in a reflection is `direct` of that lamp, and the environment seen there is `environment`: what other
    surfaces *scatter* is all that `indirect` is made of.

    Attributes:
        texture: (H, W, 4) float32 radiance.
        framebuffer: over that texture.
    """

    def __init__(self, device: Device, size: tuple[int, int]) -> None:
        self._device, self._size = device, size
        self.texture = device.target(size)
        self.framebuffer = device.framebuffer([self.texture])

    def hold(self, image: np.ndarray) -> None:
        """Take an (H, W, 3) image, row 0 at the top, for it."""
        data = np.zeros((*image.shape[:2], 4), np.float32)
        data[..., :3] = image[::-1]
        self.texture.write(data, alignment=1)


class FrameScatteredLight(ScatteredLight):
    """That of a frame which is being drawn.

    Args:
        radiance: the framebuffer that the frame's radiance is added up in.
        emits: whether anything is there before light is reflected: emission, or an environment behind everything.
    """

    def __init__(self, device: Device, size: tuple[int, int], radiance: Any, emits: bool) -> None:
        super().__init__(device, size)
        self._radiance = radiance
        self._averager = Averager(device) if emits else None
        self._emission = device.target(size) if emits else None
        self._emission_buffer = device.framebuffer([self._emission]) if emits else None

    def remember_emission(self) -> None:
        """To be called when the G-buffer has been drawn, and nothing else."""
        if self._emission_buffer is not None:
            self._device.gl.copy_framebuffer(self._emission_buffer, self._radiance)

    def take(self) -> None:
        """Hold what has been added since."""
        self._device.gl.copy_framebuffer(self.framebuffer, self._radiance)
        if self._averager is not None:
            self._averager.add(self._emission, self.framebuffer, -1.0)
