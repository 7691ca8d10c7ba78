"""Mean absolute error."""

import numpy as np

from .comparison import Comparison
from .measurement import Measurement
from .mse import RADIANCE
from .noisy_mean import ErrorMap, measure_map

_ABSOLUTE = ErrorMap("absolute difference", lambda t, r: np.abs(t - r).mean(axis=2))


def mae(comparison: Comparison, bound: bool = True) -> Measurement:
    """Mean over pixels and channels of |tested − mean reference|, in W/sr/m².

    Biased upwards by the reference's noise where the error is small: reported as `noisy_mean` says. Negative
    radiance is taken as it is.

    Args:
        comparison: the two sides, scene-linear.
        bound: whether to look for the bound, or only for the floor.
    """
    return measure_map(comparison, _ABSOLUTE, how="mean absolute difference", unit=RADIANCE, bound=bound)
