"""Percentiles of the error over the pixels: how wrong the worst one or five in a hundred are.

A small wrong highlight drowns in the mean of a large right background; in a percentile it does not. Linear
interpolation between order statistics, type 7 of Hyndman and Fan, "Sample Quantiles in Statistical Packages", The
American Statistician 1996. Noise biases a percentile more than a mean: reported as `noisy_mean` says.
"""

from collections.abc import Callable

import numpy as np

from .comparison import Comparison
from .flip import PIXELS_PER_DEGREE, flip_error
from .measurement import Measurement
from .mse import RADIANCE
from .noisy_mean import ErrorMap, measure_map

_RMS = ErrorMap("rms", lambda t, r: np.sqrt(np.mean((t - r) ** 2, axis=2)))


def rms_p95(comparison: Comparison, bound: bool = True) -> Measurement:
    """95th percentile over pixels of the root mean square over channels of tested − mean reference, in W/sr/m².

    Negative radiance is taken as it is.

    Args:
        comparison: the two sides, scene-linear.
        bound: whether to look for the bound, or only for the floor.
    """
    return _rms(comparison, 95, bound)


def rms_p99(comparison: Comparison, bound: bool = True) -> Measurement:
    """The 99th percentile; else as `rms_p95`."""
    return _rms(comparison, 99, bound)


def flip_p95(
    comparison: Comparison,
    display: Callable[[np.ndarray], np.ndarray] | None = None,
    pixels_per_degree: float = PIXELS_PER_DEGREE,
    bound: bool = True,
) -> Measurement:
    """95th percentile over pixels of LDR-FLIP, in [0, 1]; arguments as of `flip`."""
    return _flip(comparison, 95, display, pixels_per_degree, bound)


def flip_p99(
    comparison: Comparison,
    display: Callable[[np.ndarray], np.ndarray] | None = None,
    pixels_per_degree: float = PIXELS_PER_DEGREE,
    bound: bool = True,
) -> Measurement:
    """99th percentile over pixels of LDR-FLIP, in [0, 1]; arguments as of `flip`."""
    return _flip(comparison, 99, display, pixels_per_degree, bound)


def _rms(comparison: Comparison, percent: float, bound: bool) -> Measurement:
    how = f"{percent}th percentile of RMS error"
    return measure_map(comparison, _RMS, _percentile(percent), how=how, unit=RADIANCE, bound=bound)


def _flip(
    comparison: Comparison,
    percent: float,
    display: Callable[[np.ndarray], np.ndarray] | None,
    pixels_per_degree: float,
    bound: bool,
) -> Measurement:
    how = f"{percent}th percentile of FLIP, {pixels_per_degree:.1f} pixels per degree"
    error = flip_error(display, pixels_per_degree)
    return measure_map(comparison, error, _percentile(percent), how=how, bound=bound)


def _percentile(percent: float) -> Callable[[np.ndarray, np.ndarray | None], float]:
    return lambda values, mask: float(np.percentile(values if mask is None else values[mask], percent))
