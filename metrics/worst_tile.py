"""The worst tile: the largest error of any place of about 16 × 16 pixels, and where it is.

A small wrong highlight drowns in the mean of a large right background; in its own tile it does not. The largest of
many noisy values is too large, however unbiased each of them is: reported as `noisy_mean` says.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from .comparison import Comparison
from .flip import PIXELS_PER_DEGREE, flip_error
from .measurement import Measurement
from .mse import RADIANCE
from .noise_bound import QUARTERS
from .noisy_mean import measure_map, measure_parts

TILE = 16
"""Pixels; the image is divided evenly, into tiles of this size as nearly as that goes."""
_ENOUGH = 0.25  # of a tile's pixels have to count: a sliver of a mask would be one pixel's error


@dataclass(frozen=True)
class Tiles:
    """An image divided into tiles.

    Attributes:
        rows: (n,) first row of each row of tiles.
        columns: (m,) first column of each column of tiles.
        counts: (n, m) pixels that count; 0 where too few of the tile do.
        mask: (H, W) which pixels count.
    """

    rows: np.ndarray
    columns: np.ndarray
    counts: np.ndarray
    mask: np.ndarray

    @classmethod
    def of(cls, comparison: Comparison) -> Tiles:
        """The tiles of a comparison's images."""
        size = comparison.height, comparison.width
        rows, columns = (np.arange(n) * side // n for side in size if (n := max(1, round(side / TILE))))
        mask = np.ones(size, bool) if comparison.mask is None else comparison.mask
        counts, areas = (_tile_sums(image.astype(np.int64), rows, columns) for image in (mask, np.ones(size)))
        enough = counts >= _ENOUGH * areas
        if not enough.any():
            enough = counts == counts.max()
        return cls(rows, columns, np.where(enough, counts, 0), mask)

    def sums(self, values: np.ndarray) -> np.ndarray:
        """(n, m) sums of (H, W) values over the pixels that count."""
        return _tile_sums(np.where(self.mask, values, 0).astype(np.float64), self.rows, self.columns)

    def largest(self, sums: np.ndarray) -> float:
        """The largest mean of any tile."""
        return float(self._means(sums).max())

    def where_largest(self, sums: np.ndarray) -> str:
        """That tile's place, in words."""
        row, column = np.unravel_index(np.argmax(self._means(sums)), sums.shape)
        height, width = self.mask.shape
        below, right = [*self.rows, height][row + 1] - 1, [*self.columns, width][column + 1] - 1
        return f"rows {self.rows[row]} to {below}, columns {self.columns[column]} to {right}"

    def _means(self, sums: np.ndarray) -> np.ndarray:
        return np.where(self.counts > 0, sums / np.maximum(self.counts, 1), -np.inf)


def rms_worst_tile(comparison: Comparison, bound: bool = True) -> Measurement:
    """The largest RMSE over any tile, in W/sr/m².

    Each tile's squared error is a U-statistic over the batches, as `mse` is: the reference's own noise does not bias
    it. Negative radiance is taken as it is.

    Args:
        comparison: the two sides, scene-linear.
        bound: whether to look for the bound, or only for the floor.
    """
    if comparison.unusable():
        return comparison.failure(RADIANCE)
    comparison.check_reference(comparison.mask)
    tiles = Tiles.of(comparison)
    squares = [np.zeros(tiles.counts.shape) for _ in QUARTERS]
    counts = [len(comparison.reference[q::4]) for q in QUARTERS]
    for k, image in enumerate(comparison.reference):
        tested = comparison.tested_batches[k if comparison.paired else 0]
        squares[k % 4] += tiles.sums(_square(tested, image))

    def squared(part: tuple[int, ...]) -> np.ndarray:
        """(n, m) sums of squared errors, unbiased where the part has two batches."""
        n = sum(counts[q] for q in part)
        of_mean = tiles.sums(_square(comparison.tested_part(part), comparison.reference_part(part)))
        return of_mean if n == 1 else (n * n * of_mean - sum(squares[q] for q in part)) / (n * (n - 1))

    def root(sums: np.ndarray) -> float:
        return float(np.sqrt(max(0.0, tiles.largest(sums))))

    def floors() -> list[float]:
        sides = [comparison.reference, *([comparison.tested_batches] if comparison.paired else [])]
        return [root(_between_halves(side, tiles)) for side in sides]

    found = measure_parts(
        comparison,
        lambda part: root(squared(part)),
        floors,
        how=f"largest RMSE of a tile of {TILE}×{TILE} pixels",
        unit=RADIANCE,
        bound=bound,
    )
    return _placed(found, tiles, squared(QUARTERS))


def flip_worst_tile(
    comparison: Comparison,
    display: Callable[[np.ndarray], np.ndarray] | None = None,
    pixels_per_degree: float = PIXELS_PER_DEGREE,
    bound: bool = True,
) -> Measurement:
    """The largest mean LDR-FLIP over any tile, in [0, 1]; arguments as of `flip`."""
    error = flip_error(display, pixels_per_degree)
    tiles = Tiles.of(comparison)
    found = measure_map(
        comparison,
        error,
        lambda values, mask: tiles.largest(tiles.sums(values)),
        how=f"largest mean FLIP of a tile of {TILE}×{TILE} pixels, {pixels_per_degree:.1f} pixels per degree",
        bound=bound,
    )
    if comparison.unusable(error.spatial):
        return found
    return _placed(found, tiles, tiles.sums(error.of(comparison, QUARTERS)))


def _between_halves(batches: list[np.ndarray], tiles: Tiles) -> np.ndarray:
    """(n, m) sums of squared differences between two halves, unbiased where there are two pairs of batches."""
    pairs = list(zip(batches[::2], batches[1::2], strict=False))
    total, squares = np.zeros(batches[0].shape), np.zeros(tiles.counts.shape)
    for one, other in pairs:
        total += np.subtract(one, other, dtype=np.float64)
        squares += tiles.sums(_square(one, other))
    n = len(pairs)
    of_sum = tiles.sums(_square(total, np.zeros_like(total)))
    return of_sum if n == 1 else (of_sum - squares) / (n * (n - 1))


def _placed(found: Measurement, tiles: Tiles, sums: np.ndarray) -> Measurement:
    return replace(found, how=f"{found.how}; it is {tiles.where_largest(sums)}")


def _square(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """(H, W), the mean over channels of (a − b)²."""
    difference = np.subtract(a, b, dtype=np.float64)
    return np.einsum("ijk,ijk->ij", difference, difference) / 3


def _tile_sums(values: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    return np.add.reduceat(np.add.reduceat(values, rows, axis=0), columns, axis=1)
