"""Bias: the signed mean difference, tested minus reference. Linear, so the reference's noise does not bias it."""

import math

import numpy as np

from .comparison import Comparison
from .interval import mean_interval
from .measurement import Measurement
from .mse import RADIANCE


def bias(comparison: Comparison) -> Measurement:
    """Mean over pixels and channels of tested − reference, in W/sr/m²; interval for K ≥ 2.

    Negative radiance is taken as it is.
    """
    if comparison.unusable():
        return comparison.failure(RADIANCE)
    m = comparison.moments
    return _measured(m.difference_means, np.ones(m.batches), RADIANCE, comparison.confidence)


def relative_bias(comparison: Comparison) -> Measurement:
    """The bias as a fraction of the reference's mean: a pure number; NaN where that mean is black or negative."""
    if comparison.unusable():
        return comparison.failure("")
    m = comparison.moments
    if not m.reference_means.mean() > 0:
        return Measurement(math.nan, unit="", how="undefined: the reference is black")
    return _measured(m.difference_means, m.reference_means, "", comparison.confidence)


def _measured(differences: np.ndarray, scales: np.ndarray, unit: str, confidence: float) -> Measurement:
    k = len(differences)
    value = float(differences.sum() / scales.sum())
    if k == 1:
        return Measurement(value, unit=unit, how="one reference image, no interval")
    left_out = (differences.sum() - differences) / (scales.sum() - scales)
    low, high = mean_interval(value, left_out, confidence)
    return Measurement(value, low, high, unit, f"mean over {k} batches, jackknife, Student t")
