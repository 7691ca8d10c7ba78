"""Mean absolute error."""

import numpy as np

from .comparison import Comparison
from .measurement import Measurement
from .mse import RADIANCE
from .noisy_mean import measure_noisy_mean


def mae(comparison: Comparison, groups: int | None = None) -> Measurement:
    """Mean over pixels and channels of |tested − mean reference|, in W/sr/m².

    Biased upwards by the reference's noise where the error is small: reported as `noisy_mean` says. Negative
    radiance is taken as it is.

    Args:
        comparison: the two sides, scene-linear.
        groups: jackknife replicates; one a batch when None, 0 for none.
    """
    return measure_noisy_mean(
        comparison,
        lambda t, r: np.abs(t - r).mean(axis=2),
        how="mean absolute difference",
        unit=RADIANCE,
        groups=comparison.batches if groups is None else groups,
    )
