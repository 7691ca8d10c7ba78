"""Sequential verdicts: batches are added until an interval leaves the limit.

Looks. A reference is looked at when it has 8 batches, then at numbers that grow by half, then at its budget's end. At
look j the metric's interval [low, high] gives PASS when all of it keeps within the limit, FAIL when all of it is
beyond, and else more batches.

Error. Looking again and again until chance obliges is the oldest mistake in testing (Armitage, McPherson and Rowe
1969), so the error allowed, α = 1 − confidence, is divided over the looks that are planned, and over the limits that
are judged together. With α_j for each look, the chance of any wrong verdict is at most Σ α_j = α whatever the looks
have to do with each other (Boole). Group-sequential tests get more from the looks' correlation: Pocock (1977) and
O'Brien and Fleming (1979) with fixed numbers of looks, Lan and DeMets (1983) by spending α as a function of time.
They need the looks' joint distribution to be that of a normal walk, which a jackknife with Student's t at 8 batches
has not, and at α this small they gain little: for ten looks at α = 0.001 Pocock's bound is z = 3.65 against 3.72
here, 4 % of the batches.

One side. A limit that holds can only be misjudged by a FAIL, that is by the lower end of an interval exceeding the
truth; one that does not hold only by a PASS, by the upper end falling short of it. Whatever the truth is, one end
alone can do harm, so each may miss with probability α_j: the interval asked for is two-sided at 1 − 2 α_j. A metric
judged by its magnitude can be misjudged at either end, so it is asked for at 1 − α_j.

Tails. An interval from the spread of what was seen is right while many samples carry that spread. `effective_count`
says how many do: n alike ones count as n, whatever else there is. Below `LEAST_COUNT` there is no verdict, since an
estimate whose spread a few fireflies carry is nothing to fail a build with: a sum of so few is as skewed as a Poisson
count, whose skewness is 1/√n, and the expansion that lengthens the interval for skewness (`interval.mean_interval`)
has its next terms of the order of 1/n. It is the idea of looking at the largest weights before trusting a Monte Carlo
mean (Koopman, Shephard and Creal 2009; Vehtari, Simpson, Gelman, Yao and Gabry 2024), with a count in place of a tail
index. Rare samples that have not been drawn yet cannot be detected by anyone: against them there is only a minimum of
samples.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from .measurement import Measurement

FIRST_LOOK = 8
"""Batches at the first look: fewer leave Student's t too few degrees of freedom to say anything at a small α."""

GROWTH = 1.5
MOST_GROUPS = 64
"""Images that are held at most; beyond, neighbours are merged. An interval from 33 to 64 groups is as good."""

LEAST_COUNT = 40.0
"""Effective number of samples that must carry the spread. With 16, of 1,000 gates on a scene with fireflies 16 were
wrong, all with counts between 16 and 23 (docs/verdicts.md); a fair reference of 64² pixels has 40 after 8 batches."""

Side = Literal["within", "beyond", "open"]


def group_size(batches: int) -> int:
    """How many batches are merged into one group, so that at most `MOST_GROUPS` are held: a power of two."""
    return 1 << max(0, math.ceil(math.log2(max(1, batches) / MOST_GROUPS)))


def plan_looks(most: int, first: int = FIRST_LOOK) -> tuple[int, ...]:
    """The numbers of batches at which to look, the last one at most `most`; whole groups each time.

    Raises:
        ValueError: `most` is below `first`.
    """
    if most < first:
        raise ValueError(f"a first look needs {first} batches, got a budget of {most}")
    last = most - most % group_size(most)
    looks, wanted = [], float(first)
    while wanted < last / math.sqrt(GROWTH):
        at = math.ceil(wanted)
        looks.append(at + -at % group_size(at))
        wanted *= GROWTH
    return (*dict.fromkeys(look for look in looks if look < last), last)


def error_per_look(confidence: float, limits: int, looks: int) -> float:
    """α_j: what each of the looks at each of the limits may spend."""
    return (1.0 - confidence) / (limits * looks)


class Groups:
    """Batches as they come, merged in pairs whenever there are too many of them.

    Attributes:
        images: the groups' means, of one shape.
        size: batches in each group, and what the next image must be worth: larger batches then come at once, so
            that fewer calls and files are needed.
        drawn: how many images were added, of whatever worth: a number that no two of them share.
    """

    def __init__(self) -> None:
        self.images: list[np.ndarray] = []
        self.size, self.drawn = 1, 0

    @property
    def batches(self) -> int:
        """How many batches were added, merged ones included."""
        return len(self.images) * self.size

    def make_room(self) -> None:
        """Merge neighbours where the next image would be one too many."""
        if len(self.images) >= MOST_GROUPS:
            pairs = zip(self.images[::2], self.images[1::2], strict=True)
            self.images = [(a + b) * np.float32(0.5) for a, b in pairs]
            self.size *= 2

    def add(self, image: np.ndarray) -> None:
        """Add the mean of `size` batches that nothing else depends on."""
        self.images.append(image)
        self.drawn += 1


@dataclass(frozen=True)
class Bound:
    """How far a number may go.

    Attributes:
        safe: PASS where the interval goes no further.
        lost: FAIL where all of the interval is beyond; the same as `safe` but for a bound that is itself uncertain.
        is_max: whether the number must be at most the bound, or at least.
        magnitude: whether the number's magnitude is judged.
    """

    safe: float
    lost: float
    is_max: bool = True
    magnitude: bool = False

    def side(self, low: float, high: float) -> Side:
        """On which side of the bound the interval lies."""
        if math.isnan(low) or math.isnan(high):
            return "open"
        if self.magnitude:
            nearest = 0.0 if low <= 0 <= high else min(abs(low), abs(high))
            low, high = nearest, max(abs(low), abs(high))
        if self.is_max:
            return "within" if high <= self.safe else "beyond" if low > self.lost else "open"
        return "within" if low >= self.safe else "beyond" if high < self.lost else "open"


@dataclass(frozen=True)
class Look:
    """What one look found.

    Attributes:
        side: "open" where the verdict has to wait.
        measurement: with the interval that was judged.
        heavy: whether the interval had left the bound, but too few samples carry its spread to trust it.
    """

    side: Side
    measurement: Measurement
    heavy: bool = False


def look(bound: Bound, alpha: float, measure: Callable[[float], Measurement], count: Callable[[], float]) -> Look:
    """Judge once.

    Args:
        alpha: what this look may spend, α_j.
        measure: gives the number with its two-sided interval at a confidence.
        count: gives `effective_count` of the samples behind it; called only where there is something to decide.
    """
    found = measure(1.0 - (1.0 if bound.magnitude else 2.0) * alpha)
    if found.low is None or found.high is None:
        return Look("open", found)
    side = bound.side(found.low, found.high)
    if side != "open" and count() < LEAST_COUNT:
        return Look("open", found, heavy=True)
    return Look(side, found)


def effective_count(contributions: np.ndarray) -> float:
    """(Σc²)² / Σc⁴ of centred contributions of any shape: n for n alike ones, a third of their number for normal ones.

    Infinite where nothing spreads.
    """
    largest = float(np.abs(contributions).max())
    if largest == 0:
        return math.inf
    squares = np.square(contributions / largest)  # a firefly's fourth power may exceed what a float holds
    return float(squares.sum(dtype=np.float64)) ** 2 / float(np.square(squares).sum(dtype=np.float64))


def squared_contributions(differences: Sequence[np.ndarray]) -> np.ndarray:
    """(K, N): what every pixel of every batch gives to the squared error's spread.

    Of the U-statistic Σ_{i≠j} ⟨d_i, d_j⟩ batch i and pixel p carry d_ip (Σ_j d_jp − d_ip), summed over the channels:
    the Hájek projection, from which a batch's own square is left out.

    Args:
        differences: K arrays (N, 3), tested minus reference.
    """
    total = np.sum(differences, axis=0)
    return _centred(np.stack([np.einsum("nc,nc->n", d, total - d) for d in differences]))


def linear_contributions(differences: Sequence[np.ndarray]) -> np.ndarray:
    """(K, N): what every pixel of every batch gives to the mean's spread, from K arrays (N, 3)."""
    return _centred(np.stack([d.sum(axis=1) for d in differences]))


def _centred(values: np.ndarray) -> np.ndarray:
    return values - values.mean(axis=0, dtype=np.float64)


def median_interval(values: Sequence[float], confidence: float) -> Measurement:
    """The median with its distribution-free interval from order statistics.

    Each of n independent values lies below their median with probability ½, so the k-th smallest lies above it with
    that of fewer than k heads in n throws (Thompson 1936; Conover, "Practical Nonparametric Statistics", 3.2). Without
    an interval where n is too small for the confidence: 2^−n must be below (1 − confidence)/2.
    """
    from scipy.stats import binom

    ordered = np.sort(np.asarray(values, np.float64))
    n = len(ordered)
    value = float(np.median(ordered))
    how = f"median of {n} rounds, order statistics"
    allowed = (1.0 - confidence) / 2
    k = int(binom.ppf(allowed, n, 0.5))  # P(X ≤ k) ≥ allowed, so that P(X < k) < allowed
    if k < 1:
        return Measurement(value, how=how)
    return Measurement(value, float(ordered[k - 1]), float(ordered[n - k]), how=how)
