"""Pixels that are not finite: counted and located, never averaged away.

The rule of this package: a metric of a tested image with a NaN or an infinity in any pixel that the metric reads is
NaN, without an interval, and its `how` says how many such pixels there are and where the first is. Pixel-wise
metrics read the pixels inside the mask; metrics with a spatial filter (FLIP, SSIM) read the whole image. A
reference that is not finite is no truth to compare with, and raises `InputError`. Radiance is held in float32: what
lies beyond its range, 3.4e38, counts as infinite, so that squares and fourth powers of what remains fit into float64.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class NonFinite:
    """What is not finite in an image.

    Attributes:
        pixels: how many pixels have at least one channel that is not finite.
        nan: how many channel values are NaN.
        positive: how many channel values are +inf, or above float32's range.
        negative: how many channel values are -inf, or below it.
        first: (row, column) of the first few such pixels, in reading order.
    """

    pixels: int
    nan: int
    positive: int
    negative: int
    first: tuple[tuple[int, int], ...]

    def __bool__(self) -> bool:
        return self.pixels > 0

    def __str__(self) -> str:
        if not self:
            return "all pixels finite"
        kinds = ((self.nan, "NaN"), (self.positive, "+inf"), (self.negative, "-inf"))
        found = ", ".join(f"{count} {kind}" for count, kind in kinds if count)
        row, column = self.first[0]
        noun = "pixel" if self.pixels == 1 else "pixels"
        return f"{self.pixels} non-finite {noun} ({found}), first at row {row}, column {column}"


def find_non_finite(image: np.ndarray, mask: np.ndarray | None = None, limit: int = 8) -> NonFinite:
    """Counts and locates the values of an image that are not finite.

    Args:
        image: (H, W) or (H, W, C), any float type; judged as float32.
        mask: (H, W) boolean, the pixels to look at; all when None.
        limit: how many positions to list at most.
    """
    with np.errstate(over="ignore"):
        image = np.asarray(image).astype(np.float32, copy=False)
    bad = ~np.isfinite(image)
    if mask is not None:
        bad &= mask if image.ndim == 2 else mask[..., None]
    if not bad.any():
        return NonFinite(0, 0, 0, 0, ())
    values = image[bad]
    pixels = bad if image.ndim == 2 else bad.any(axis=2)
    rows, columns = np.nonzero(pixels)
    return NonFinite(
        pixels=int(rows.size),
        nan=int(np.isnan(values).sum()),
        positive=int(np.isposinf(values).sum()),
        negative=int(np.isneginf(values).sum()),
        first=tuple((int(r), int(c)) for r, c in zip(rows[:limit], columns[:limit], strict=True)),
    )
