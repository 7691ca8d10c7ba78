"""Whether two squared errors differ, where both are held against the same batches.

Two errors that share their truth share its noise too, and most of that cancels in their difference: settings whose
intervals overlap widely are often told apart all the same.
"""

from dataclasses import dataclass

import numpy as np

from .comparison import Comparison
from .interval import MIN_BATCHES, mean_interval, u_statistic


@dataclass(frozen=True, eq=False)
class SquaredError:
    """An MSE, and what it is with each batch left out.

    Attributes:
        value: as `mse.mse` gives it; NaN where the tested side is not finite.
        left_out: (K,); empty where one image is all of the truth, which then has no noise that is known of.
    """

    value: float
    left_out: np.ndarray

    @classmethod
    def of(cls, comparison: Comparison) -> "SquaredError":
        """Of a comparison with one batch, or `interval.MIN_BATCHES` at least."""
        if comparison.unusable():
            return cls(np.nan, np.empty(0))
        gram = comparison.moments.gram
        if len(gram) == 1:
            return cls(float(gram[0, 0]), np.empty(0))
        assert len(gram) >= MIN_BATCHES, "fewer batches have no interval"
        return cls(*u_statistic(gram))


def told_apart(one: SquaredError, other: SquaredError, confidence: float = 0.95) -> bool:
    """Whether the interval of their difference, by jackknife over the batches, leaves out 0.

    What is not finite is told apart from everything; where the truth has no noise, every difference counts.
    """
    difference = one.value - other.value
    if not np.isfinite(difference) or not len(one.left_out):
        return difference != 0
    low, high = mean_interval(difference, one.left_out - other.left_out, confidence)
    return not low <= 0 <= high
