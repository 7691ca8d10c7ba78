"""Where an image's content lies and how large it is, against the reference's."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .resampling import resample


@dataclass(frozen=True)
class Placement:
    """A shift, and scales about the image's centre.

    The content that the reference has at offset u from its centre, the tested image has at shift + u / scale. Scales
    are of the tangent of half the angle of view: where they are above 1 the tested image sees more.

    Attributes:
        right, down: pixels.
        across, upright: scales along rows and columns.
    """

    right: float = 0.0
    down: float = 0.0
    across: float = 1.0
    upright: float = 1.0

    def sources(self, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Where the reference has what the tested image's rows and columns show: (H,) and (W,) pixels."""
        (y, x), (row, column) = _offsets(shape), _centre(shape)
        return row + self.upright * (y - self.down), column + self.across * (x - self.right)

    def targets(self, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Where the tested image has what the reference's rows and columns show."""
        (y, x), (row, column) = _offsets(shape), _centre(shape)
        return row + self.down + y / self.upright, column + self.right + x / self.across

    def place(self, image: np.ndarray) -> np.ndarray:
        """(H, W, …): an image that lies as the reference, laid as the tested one."""
        return resample(image, *self.sources(image.shape))

    def undo(self, image: np.ndarray) -> np.ndarray:
        """(H, W, …): an image that lies as the tested one, laid as the reference."""
        return resample(image, *self.targets(image.shape))

    def in_coarser(self, factor: float) -> Placement:
        """The same in an image of fewer pixels."""
        return replace(self, right=self.right / factor, down=self.down / factor)


def inside(rows: np.ndarray, columns: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """(n, m) bool: which of these places lie within the pixels of an image, borders included."""
    row, column = (
        (at > -0.5 - 1e-9) & (at < side - 0.5 + 1e-9) for at, side in zip((rows, columns), shape[:2], strict=True)
    )
    return row[:, None] & column[None]


def _centre(shape: tuple[int, ...]) -> tuple[float, float]:
    return (shape[0] - 1) / 2, (shape[1] - 1) / 2


def _offsets(shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    row, column = _centre(shape)
    return np.arange(shape[0]) - row, np.arange(shape[1]) - column
