"""How much of a light that should be there an approximation brings, and how much that should not."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .comparison import Comparison
from .interval import MIN_BATCHES, mean_interval, u_statistic
from .measurement import Measurement
from .mse import rmse


@dataclass(frozen=True)
class Recovery:
    """An approximation t of a light R, over pixels and channels. All but `rmse` are pure numbers.

    Attributes:
        share: Σ t·R / Σ R·R: how much of the light's own pattern is in t; 1 for the light itself.
        energy: Σ t / Σ R: whether there is as much of it, wherever it lies.
        leaked: Σ max(t − R, 0) / Σ R: what is too bright; of black pixels all that is there.
        missing: Σ max(R − t, 0) / Σ R: what is too dark. energy = 1 + leaked − missing.
        rmse: in radiance.
    """

    share: Measurement
    energy: Measurement
    leaked: Measurement
    missing: Measurement
    rmse: Measurement


def recovery(comparison: Comparison) -> Recovery:
    """Compares one image with K batches of the light.

    Σ R·R is a U-statistic over pairs of batches, free of their noise. Noise makes `leaked` and `missing` larger, each
    by as much; the jackknife takes the first order of that off. All are NaN where the light is black.
    """
    tested = np.asarray(comparison.tested_batches[0], np.float64).reshape(1, -1)
    batches = np.stack([np.asarray(batch, np.float64).ravel() for batch in comparison.reference])
    gram = batches @ batches.T
    along = (batches @ tested[0]).astype(np.float64)
    sums = batches.sum(axis=1)

    def power(keep: np.ndarray) -> float:
        kept = gram[np.ix_(keep, keep)]
        return float(kept[0, 0]) if len(kept) == 1 else u_statistic(kept)[0]

    def apart(sign: int) -> Callable[[np.ndarray], float]:
        def part(keep: np.ndarray) -> float:
            mean = batches[keep].mean(axis=0)
            return _ratio(float(np.maximum(sign * (tested[0] - mean), 0).sum()), float(mean.sum()))

        return part

    def measured(ratio: Callable[[np.ndarray], float], how: str, unbiased: bool = True) -> Measurement:
        return _jackknife(ratio, len(batches), how, unbiased, comparison.confidence)

    return Recovery(
        measured(lambda keep: _ratio(float(along[keep].mean()), power(keep)), "Σ t·R over Σ R·R"),
        measured(lambda keep: _ratio(float(tested.sum()), float(sums[keep].mean())), "Σ t over Σ R"),
        measured(apart(1), "Σ max(t − R, 0) over Σ R", unbiased=False),
        measured(apart(-1), "Σ max(R − t, 0) over Σ R", unbiased=False),
        rmse(comparison),
    )


def _ratio(numerator: float, denominator: float) -> float:
    return numerator / denominator if denominator > 0 else float("nan")


def _jackknife(
    ratio: Callable[[np.ndarray], float], count: int, how: str, unbiased: bool, confidence: float
) -> Measurement:
    """A ratio of all batches, with its interval; where noise biases it, less that bias (Quenouille 1956)."""
    value = ratio(np.ones(count, bool))
    if count < MIN_BATCHES:
        return Measurement(value, how=f"{how}, {count} batches, no interval under {MIN_BATCHES}")
    left_out = np.array([ratio(keep) for keep in ~np.eye(count, dtype=bool)])
    if not np.isfinite([value, *left_out]).all():
        return Measurement(float("nan"), how="undefined: there is no such light, or an image is not finite")
    if not unbiased:
        value = count * value - (count - 1) * float(left_out.mean())
    low, high = mean_interval(value, left_out, confidence)
    return Measurement(value, low, high, how=f"{how}, {count} batches, jackknife, Student t")
