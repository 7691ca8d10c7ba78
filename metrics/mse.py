"""Squared error, unbiased by the reference's noise: MSE, RMSE, nrmse, relmse.

The plain mean of (T − mean R)² is too large by the variance of the mean. The U-statistic over pairs of batches,
((Σ(T−R_k))² − Σ(T−R_k)²) / (K(K−1)), multiplies only differences of different batches (Hoeffding 1948). It may
come out negative near 0 and is reported so. Negative radiance is taken as it is.

With one batch the plain mean is all there is; it comes without an interval and says so.
"""

import math
from collections.abc import Callable

import numpy as np

from .comparison import Comparison
from .interval import MIN_BATCHES, squared_norm_interval, u_statistic
from .measurement import Measurement
from .moments import Moments

RADIANCE = "W/sr/m²"
_LARGEST = 1e150  # an interval takes squares, which float64 holds up to here


def mse(comparison: Comparison) -> Measurement:
    """Mean squared error over pixels and channels, in (W/sr/m²)².

    Unbiased for K ≥ 2; interval for K ≥ 4. The value, and the interval's lower end, may be negative.
    Negative radiance is taken as it is.
    """
    return _squared(comparison, f"({RADIANCE})²", lambda m, keep: 1.0)


def rmse(comparison: Comparison) -> Measurement:
    """√max(0, MSE), in W/sr/m², 0 or more; its interval is the MSE's, clipped at 0, under the root.

    Negative radiance is taken as it is.
    """
    return _root(_squared(comparison, RADIANCE, lambda m, keep: 1.0), RADIANCE)


def nrmse(comparison: Comparison) -> Measurement:
    """RMSE over the reference's mean, a pure number; NaN where that mean is not above 0, be it black or negative."""
    squared = _squared(comparison, "", lambda m, keep: _positive(_mean(m.reference_means, keep)) ** 2)
    return _root(squared, "")


def relmse(comparison: Comparison) -> Measurement:
    """Σ MSE / Σ R², both as U-statistics: a pure number; NaN where the reference is black. May be negative."""
    return _squared(comparison, "", lambda m, keep: _positive(_power(m.reference_gram, keep)))


def _squared(comparison: Comparison, unit: str, scale: Callable[[Moments, np.ndarray], float]) -> Measurement:
    """The MSE over scale(moments, batches that are kept), with the scale's own noise in the interval."""
    if comparison.unusable():
        return comparison.failure(unit)
    m = comparison.moments
    k = m.batches
    everything = np.ones(k, bool)
    divisor = scale(m, everything)
    if math.isnan(divisor):
        return Measurement(math.nan, unit=unit, how="undefined: the reference is black")
    if k == 1:
        return Measurement(
            float(m.gram[0, 0]) / divisor,
            unit=unit,
            how="plain mean over one reference image, its noise included",
        )
    value, left_out = u_statistic(m.gram)
    value /= divisor
    how = f"U-statistic over {k} batches"
    if k < MIN_BATCHES:
        return Measurement(value, unit=unit, how=f"{how}, no interval under {MIN_BATCHES}")
    keeps = ~np.eye(k, dtype=bool)
    left_out = left_out / np.array([scale(m, keep) for keep in keeps])
    if not (np.abs(left_out) < _LARGEST).all():
        return Measurement(value, unit=unit, how=f"{how}, no interval: the reference is nearly black")
    low, high = squared_norm_interval(value, left_out, m.gram / divisor, comparison.confidence)
    return Measurement(value, low, high, unit, f"{how}, jackknife, Student t")


def _root(squared: Measurement, unit: str) -> Measurement:
    if math.isnan(squared.value):
        return squared
    low, high = (None if x is None else math.sqrt(max(0.0, x)) for x in (squared.low, squared.high))
    return Measurement(math.sqrt(max(0.0, squared.value)), low, high, unit, f"root of {squared.how}")


def _mean(values: np.ndarray, keep: np.ndarray) -> float:
    return float(values[keep].mean())


def _power(gram: np.ndarray, keep: np.ndarray) -> float:
    kept = gram[np.ix_(keep, keep)]
    return float(kept[0, 0]) if len(kept) == 1 else u_statistic(kept)[0]


def _positive(x: float) -> float:
    return x if x > 0 else math.nan
