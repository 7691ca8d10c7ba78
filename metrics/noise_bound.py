"""A bound for a metric that noise biases, from its values at means of fewer batches.

Let v(m) be the metric at the mean of m batches, v(∞) what is sought, and D₁ = v(K/2) − v(K), D₂ = v(K/4) − v(K/2). If
the bias falls by a ratio r whenever the batches double, what remains of it, v(K) − v(∞), is D₁ r / (1 − r). The order
of the bias says what r is: 1/2 where it is of second order in the noise (1/m), 0.707 where the metric is a norm near
zero (1/√m), and 2^-0.35 = 0.785 for FLIP near zero, whose colour part is a distance to the power of 0.7. So the
remaining bias lies between 0 and D₁ r / (1 − r), with r = max(0.785, D₁/D₂ as far as it is significant). The bound is
the hull of the confidence intervals about both ends. Where r reaches 1, noise saturates the metric, and the bound
reaches to the perfect value on that side.

An error that is not beyond the noise floor, the metric between two halves of the reference, cannot be told from none:
a distance obeys |d(tested, mean) − d(tested, truth)| ≤ d(mean, truth), and the floor is no less than that for any norm
(halves differ by twice the noise of the mean). There the bound reaches to the perfect value too. FLIP and SSIM are no
norms; for them this was held against experiment (docs/coverage.md).

The spread comes from three orthogonal ways to halve the batches (balanced half-samples, McCarthy 1969), and from the
four quarters; the larger of the two is taken, with Student's t for 3 degrees of freedom. Half-samples also show how
much D₁ itself fluctuates.
"""

import math
from dataclasses import dataclass

import numpy as np

from .interval import student_t

QUARTERS = (0, 1, 2, 3)
SPLITS = (((0, 2), (1, 3)), ((0, 1), (2, 3)), ((0, 3), (1, 2)))
"""The three ways to halve four quarters; the differences between halves are orthogonal."""
LEAST_BATCHES = 8
"""A quarter of fewer is a single batch."""
SLOWEST = 2**-0.35
FASTEST = 0.5


@dataclass(frozen=True)
class Ladder:
    """A metric at means of fewer and fewer batches.

    Attributes:
        full: of all K.
        halves: (3, 2), of both halves of each of SPLITS.
        quarters: (4,).
        floor: between two halves of the reference.
        perfect: its value where there is no error.
        larger_is_worse: on which side of it the others lie.
    """

    full: float
    halves: np.ndarray
    quarters: np.ndarray
    floor: float
    perfect: float = 0.0
    larger_is_worse: bool = True

    @property
    def beyond_floor(self) -> bool:
        """Whether the error is larger than what noise alone would show."""
        return abs(self.full - self.perfect) > abs(self.floor - self.perfect)

    @property
    def steps(self) -> tuple[float, float]:
        """(D₁, D₂)."""
        half = float(self.halves.mean())
        return half - self.full, float(self.quarters.mean()) - half

    def extrapolated(self) -> float:
        """v(∞), as the measured steps have it; not past the perfect value."""
        first, second = self.steps
        ratio = min(max(first / second if second else FASTEST, FASTEST), SLOWEST)
        return self._no_better(self.full - first * ratio / (1 - ratio))

    def bound(self, confidence: float) -> tuple[float, float]:
        """(low, high), which holds v(∞) at least as often as `confidence` says."""
        t = student_t(len(QUARTERS), confidence)
        halving = float(np.mean((self.halves[:, 0] - self.halves[:, 1]) ** 2)) / 4
        error = math.sqrt(max(halving, float(self.quarters.var(ddof=1)) / len(QUARTERS)))
        first, second = self.steps
        doubt = float(self.halves.mean(axis=1).std(ddof=1)) / math.sqrt(len(SPLITS))
        significant = abs(first) - t * doubt, abs(second) + t * doubt
        ratio = max(SLOWEST, significant[0] / significant[1] if significant[1] else 0.0)

        ends = [self.full - t * error, self.full + t * error]
        if ratio < 1:
            left = ratio / (1 - ratio)
            half = t * math.hypot(error, left * doubt)
            ends += [self.full - left * first - half, self.full - left * first + half]
        if ratio >= 1 or not self.beyond_floor:
            ends.append(self.perfect)
        return self._no_better(min(ends)), self._no_better(max(ends))

    def _no_better(self, value: float) -> float:
        """Not past the perfect value."""
        return max(value, self.perfect) if self.larger_is_worse else min(value, self.perfect)


def signed_bound(full: float, halves: np.ndarray, confidence: float) -> tuple[float, float]:
    """(low, high) of a signed combination of metrics that noise biases, such as a share: it has no perfect value.

    The remaining bias lies between 0 and what the slowest order leaves of D₁; the bound is the hull of the confidence
    intervals about both ends, as in `Ladder.bound` where noise does not saturate the metric.

    Args:
        full: from all batches.
        halves: (3, 2), from both halves of each of SPLITS.
    """
    t, left = student_t(len(QUARTERS), confidence), SLOWEST / (1 - SLOWEST)
    error = math.sqrt(float(np.mean((halves[:, 0] - halves[:, 1]) ** 2)) / 4)
    first = float(halves.mean()) - full
    doubt = float(halves.mean(axis=1).std(ddof=1)) / math.sqrt(len(SPLITS))
    ends = (full, t * error), (full - left * first, t * math.hypot(error, left * doubt))
    return min(value - half for value, half in ends), max(value + half for value, half in ends)
