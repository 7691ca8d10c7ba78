"""The bright part of a picture in blocks of pixels, and adding blocks to a picture: on the device and in NumPy."""

import numpy as np

from lightmeter.scenes.optics.color import LUMINANCE

from ..device import Device
from ..fullscreen import FullscreenPass
from ..shaders import source
from .canvas import Canvas, Size, part_of
from .sampling import bilinear


class BrightBlocks(Canvas):
    """What of a picture is brighter than a threshold."""

    def __init__(self, device: Device, size: Size, threshold: float, divisor: int) -> None:
        super().__init__(device, part_of(size, divisor))
        self._pass = FullscreenPass(device, source("bright_blocks.frag"), {"threshold": threshold, "divisor": divisor})

    def draw(self, image) -> None:
        """Of `image`, a texture."""
        self._pass.draw(self.framebuffer, {"image": image})


class WithBlocks(Canvas):
    """A picture with blocks added to it, times a strength."""

    def __init__(self, device: Device, size: Size, strength: float, divisor: int) -> None:
        super().__init__(device, size)
        self._pass = FullscreenPass(device, source("add_blocks.frag"), {"strength": strength, "divisor": divisor})

    def draw(self, image, blocks) -> None:
        """Of two textures."""
        self._pass.draw(self.framebuffer, {"image": image, "blocks": blocks})


def bright_part(color: np.ndarray, threshold: float | np.ndarray) -> np.ndarray:
    """What of a colour is brighter than a threshold: (3, …) of (3, …)."""
    bright = np.tensordot(LUMINANCE, color, axes=1)
    return color * (np.maximum(bright - threshold, 0.0) / np.maximum(bright, 1e-20))


def bright_blocks(image: np.ndarray, threshold: float, divisor: int) -> np.ndarray:
    """The twin of `BrightBlocks`, of an (H, W, 3) picture whose row 0 is the device's."""
    height, width = image.shape[:2]
    columns, rows = part_of((width, height), divisor)
    bright = np.moveaxis(bright_part(np.moveaxis(image, -1, 0), threshold), 0, -1)
    wide = np.pad(bright, ((0, rows * divisor - height), (0, columns * divisor - width), (0, 0)), mode="edge")
    return wide.reshape(rows, divisor, columns, divisor, 3).mean(axis=(1, 3))


def with_blocks(image: np.ndarray, blocks: np.ndarray, strength: float, divisor: int) -> np.ndarray:
    """The twin of `WithBlocks`."""
    height, width = image.shape[:2]
    rows, columns = blocks.shape[:2]
    u, v = np.meshgrid((np.arange(width) + 0.5) / (columns * divisor), (np.arange(height) + 0.5) / (rows * divisor))
    return image + strength * bilinear(blocks, u, v)
