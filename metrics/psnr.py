"""Peak signal-to-noise ratio."""

import math

from .comparison import Comparison
from .input_error import InputError
from .measurement import Measurement
from .mse import mse


def psnr(comparison: Comparison, peak: float = 1.0) -> Measurement:
    """10 log10(peak² / MSE) in dB, with the unbiased MSE: +inf where that is 0 or negative.

    Negative radiance is taken as it is.

    Args:
        comparison: the two sides.
        peak: the signal's largest value in the images' unit. It has to be stated: scene-linear radiance has none
            of its own. 1 is a display image's white.

    Raises:
        InputError: the peak is not above 0.
    """
    if not (math.isfinite(peak) and peak > 0):
        raise InputError(
            "PSNR needs a peak",
            expected="a finite value above 0",
            actual=str(peak),
            remedy="Give the largest value that the signal may take, 1 for display images.",
        )
    squared = mse(comparison)
    if math.isnan(squared.value):
        return Measurement(math.nan, unit="dB", how=squared.how)

    def decibel(x: float) -> float:
        return math.inf if x <= 0 else 20 * math.log10(peak) - 10 * math.log10(x)

    low = None if squared.high is None else decibel(squared.high)
    high = None if squared.low is None else decibel(squared.low)
    return Measurement(decibel(squared.value), low, high, "dB", f"peak {peak:g}, MSE: {squared.how}")
