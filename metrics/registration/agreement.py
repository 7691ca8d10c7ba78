"""On which factor two images agree: in their levels, and in their contrasts.

A frame that is exposed by f has f times the level of the truth, and f times its contrast, nearly everywhere. A light
that is left out, or ambient light that is too strong, changes levels and leaves the contrast of what the other lights
draw; a wrong material changes here one and there the other. So a factor counts only where both speak for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.ndimage import gaussian_filter, uniform_filter

from .resampling import reduce

_SIDE = 128  # cells along the longer side, about
_BLUR = 1.2  # cells
_WINDOW = 0.3  # of the shorter side, over which contrast is measured
_DARK = 0.01  # of the typical level: darker cells are not asked
_NOISY = 0.2  # relative noise of a cell that is not asked
_FLAT = 0.02  # relative contrast of a window that is not asked
_ALIKE = 0.8  # correlation of a window that is asked
_BIN, _KERNEL, _RANGE = 0.005, 0.05, 40.0  # of the logarithm: the mode's histogram and its smoothing
LEVELS, CONTRASTS = 0.1, 0.15
"""How far from a factor, in the logarithm, levels and contrasts speak for it."""
_FAR = 1.5  # of the logarithm: what is farther off is simply wrong
_LEAST = 32  # cells, or windows, that must be left to ask
_EXPONENTS = np.geomspace(0.3, 3.4, 32)
_SOME = 5000  # levels are enough to find an exponent


@dataclass(frozen=True, eq=False)
class Agreement:
    """What levels and contrasts say of an image.

    Attributes:
        levels, contrasts: logarithms of the ratios to the reference's, of every cell or window that is asked.
        weights: of the levels.
        asked: how many windows have contrast in the reference; not all of them are alike in the tested image.
    """

    levels: np.ndarray
    weights: np.ndarray
    contrasts: np.ndarray
    asked: int

    @cached_property
    def level(self) -> float:
        """The logarithm of the factor that most levels share."""
        return _mode(self.levels, self.weights)

    @cached_property
    def contrast(self) -> float:
        """The logarithm of the factor that most contrasts share."""
        return _mode(self.contrasts, np.ones(len(self.contrasts)))

    @property
    def tells(self) -> bool:
        """Whether there is anything to go by."""
        return len(self.levels) >= _LEAST and len(self.contrasts) >= _LEAST

    def support(self, factor: float) -> float:
        """The share of the levels times the share of the contrasts that speak for a factor (its logarithm), 0…1."""
        return self.level_share(factor) * self.contrast_share(factor)

    def level_share(self, factor: float) -> float:
        """The share of levels near a factor."""
        near = np.abs(self.levels - factor) < LEVELS
        return float(self.weights[near].sum() / self.weights.sum()) if len(near) else 0.0

    def contrast_share(self, factor: float) -> float:
        """The share of contrasts near a factor."""
        return float(np.count_nonzero(np.abs(self.contrasts - factor) < CONTRASTS)) / max(self.asked, 1)

    @property
    def spread(self) -> float:
        """Half of the levels are within this of the one that most share."""
        return float(np.median(np.abs(self.levels - self.level))) if len(self.levels) else 0.0

    @property
    def brighter(self) -> float:
        """The share of levels that are clearly too bright, 0…1."""
        return float(self.weights[self.levels > LEVELS].sum() / self.weights.sum()) if len(self.levels) else 0.0

    @property
    def off(self) -> tuple[float, float]:
        """How far levels and contrasts are from the reference's: means of the logarithm's magnitude, cut at 1.5."""
        if not self.tells:
            return _FAR, _FAR
        levels, contrasts = (np.minimum(np.abs(part), _FAR) for part in (self.levels, self.contrasts))
        return float(np.average(levels, weights=self.weights)), float(contrasts.mean())

    @property
    def sharpness(self) -> float:
        """How close levels are to the one that most share, 0…1: finer than the share."""
        if not len(self.levels):
            return 0.0
        return float(np.average(np.exp(-(((self.levels - self.level) / 0.03) ** 2) / 2), weights=self.weights))


class Truth:
    """The reference's levels and contrasts, to hold images against.

    Args:
        reference: (H, W, 3) mean of the batches, linear.
        variance: (H, W, 3) of its noise, or None.
        valid: (H, W) bool, the pixels to ask.
    """

    def __init__(self, reference: np.ndarray, variance: np.ndarray | None, valid: np.ndarray) -> None:
        self._factor = max(1, max(valid.shape) // _SIDE)
        self._valid = valid
        share = reduce(valid.astype(float), self._factor)
        self._weight = np.where(share > 0.5, share, 0.0)
        self._near = gaussian_filter(self._weight, _BLUR)
        self._size = max(3, round(_WINDOW * min(self._weight.shape)))
        self._around = uniform_filter(self._weight, self._size)
        self._level = self._cells(reference)
        noise = np.zeros_like(self._level)
        if variance is not None:
            noise = self._cells(variance) / self._factor**2 / (4 * np.pi * _BLUR**2)
        there = self._weight > 0
        lit = self._level[there]
        self._typical = float(np.minimum(lit, np.percentile(lit, 95)).mean()) if lit.size else 0.0
        with np.errstate(divide="ignore", invalid="ignore"):
            certain = np.sqrt(noise) < _NOISY * self._level
        self._asked = there[..., None] & certain & (self._level > _DARK * self._typical) & (self._level > 0)
        mean = self._windows(self._level)
        noise_around = self._windows(noise)
        self._contrast = self._windows(self._level**2) - mean**2 - noise_around
        self._mean = mean
        plain = (self._contrast > 2 * noise_around) & (self._contrast > (_FLAT * mean) ** 2)
        self._windows_asked = there[..., None] & plain & (mean > _DARK * self._typical)

    def agreement(self, tested: np.ndarray) -> Agreement:
        """How an image's levels and contrasts compare.

        Args:
            tested: (H, W, 3) linear, finite, not negative.
        """
        level = self._cells(tested)
        mean = self._windows(level)
        contrast = self._windows(level**2) - mean**2
        common = self._windows(level * self._level) - mean * self._mean
        asked = self._windows_asked & (contrast > 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            alike = asked & (common > _ALIKE * np.sqrt(contrast * self._contrast))
            ratios = 0.5 * np.log(contrast[alike] / self._contrast[alike])
        seen = self._asked
        floor = 1e-4 * self._level[seen]
        levels = np.log(np.maximum(level[seen], floor) / self._level[seen])
        weights = np.broadcast_to(self._weight[..., None], seen.shape)[seen]
        return Agreement(levels, weights, ratios, int(np.count_nonzero(self._windows_asked)))

    def exponent(self, tested: np.ndarray) -> float:
        """The exponent under which most levels agree on one factor: tested ≈ factor · reference ** exponent."""
        level = self._cells(tested)
        seen = self._asked & (level > 0)
        if np.count_nonzero(seen) < _LEAST:
            return 1.0
        some = slice(None, None, max(1, np.count_nonzero(seen) // _SOME))
        mine, theirs = np.log(level[seen][some]), np.log(self._level[seen][some])
        weights = np.broadcast_to(self._weight[..., None], seen.shape)[seen][some]

        def agreeing(exponent: float) -> float:
            left = mine / exponent - theirs
            return float(weights[np.abs(left - _mode(left, weights)) < LEVELS / 2].sum())

        coarse = _EXPONENTS[int(np.argmax([agreeing(e) for e in _EXPONENTS]))]
        fine = coarse * np.geomspace(0.92, 1.08, 17)
        shares = np.array([agreeing(e) for e in fine])
        return float(fine[shares >= shares.max() - 1e-9].mean())

    def _cells(self, image: np.ndarray) -> np.ndarray:
        """(h, w, 3): blurred means over the pixels that are asked."""
        sums = reduce(np.where(self._valid[..., None], image, 0.0), self._factor)
        share = reduce(self._valid.astype(float), self._factor)
        means = sums / np.where(share > 0, share, 1.0)[..., None] * self._weight[..., None]
        blurred = np.stack([gaussian_filter(means[..., c], _BLUR) for c in range(3)], axis=2)
        return blurred / np.where(self._near > 0, self._near, 1.0)[..., None]

    def _windows(self, values: np.ndarray) -> np.ndarray:
        """(h, w, 3): means over windows."""
        sums = uniform_filter(values * self._weight[..., None], (self._size, self._size, 1))
        return sums / np.where(self._around > 1e-9, self._around, 1.0)[..., None]


def _mode(values: np.ndarray, weights: np.ndarray) -> float:
    """Where most of the weight is: the largest value of a smoothed histogram; 0 of nothing."""
    if not len(values):
        return 0.0
    first = float(values.min())
    counts = np.bincount((np.minimum(values - first, _RANGE) / _BIN).astype(int), weights)
    half = int(3 * _KERNEL / _BIN)
    kernel = np.exp(-((np.arange(-half, half + 1) * _BIN / _KERNEL) ** 2) / 2)
    return first + (int(np.argmax(np.convolve(counts, kernel))) - half + 0.5) * _BIN
