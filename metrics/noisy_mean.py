"""Metrics that are not linear, of a reference that is noisy.

The noise of the mean biases such a metric, mostly upwards, and no estimator is free of it. So the value at the mean of
all batches comes with a bound (`low`, `high`) that holds the value without noise at least as often as the comparison's
confidence says; with the extrapolated value (`corrected`); and with the floor, the same metric between two halves of
the reference, about what two equal but noisy images would get. How they come about: `noise_bound`.
"""

import math
from collections.abc import Callable, Hashable
from dataclasses import dataclass

import numpy as np

from .comparison import Comparison
from .measurement import Measurement
from .noise_bound import LEAST_BATCHES, QUARTERS, SPLITS, Ladder

Image = np.ndarray
Part = tuple[int, ...]
"""Which quarters of the batches."""


@dataclass(frozen=True)
class ErrorMap:
    """How two images become a map of their difference. Metrics that read the same map share it.

    Attributes:
        name: all that `function` depends on.
        function: (tested, reference), both (H, W, 3), to (H, W).
        display: put on both sides first; identity when None.
        spatial: its filters read past the mask.
    """

    name: Hashable
    function: Callable[[Image, Image], Image]
    display: Callable[[Image], Image] | None = None
    spatial: bool = False

    def between(self, tested: Image, reference: Image, mask: np.ndarray | None) -> Image:
        """The map of two images."""
        sides = [tested, reference]
        if mask is not None and not self.spatial:
            # Outside the mask may be NaN, which a display transform need not survive.
            sides = [np.where(mask[..., None], image, 0) for image in sides]
        if self.display is not None:
            sides = [self.display(image) for image in sides]
        return np.asarray(self.function(*sides))

    def of(self, comparison: Comparison, part: Part) -> Image:
        """The map at the mean of some quarters of the batches, kept with the comparison."""
        key = self.name, self.display, part
        if key not in comparison.maps:
            sides = comparison.tested_part(part), comparison.reference_part(part)
            comparison.maps[key] = self.between(*sides, comparison.mask)
        return comparison.maps[key]

    def floor(self, comparison: Comparison) -> list[Image]:
        """Maps between two halves of the reference and, where it comes as batches, of the tested side."""
        key = self.name, self.display, "floor"
        if key not in comparison.maps:
            sides = [comparison.reference_part, *([comparison.tested_part] if comparison.paired else [])]
            one, other = SPLITS[0]
            comparison.maps[key] = [self.between(side(one), side(other), comparison.mask) for side in sides]
        return comparison.maps[key]


def mean(values: Image, mask: np.ndarray | None) -> float:
    """Over the pixels of values (H, W) that count: those of the mask (H, W), or all."""
    return float(np.mean(values if mask is None else values[mask], dtype=np.float64))


def measure_map(
    comparison: Comparison,
    error: ErrorMap,
    summary: Callable[[Image, np.ndarray | None], float] = mean,
    *,
    how: str,
    unit: str = "",
    perfect: float = 0.0,
    larger_is_worse: bool = True,
    bound: bool = True,
) -> Measurement:
    """A number of an error map of the mean of the batches, with its bound and its noise floor.

    Args:
        comparison: the two sides.
        error: the map.
        summary: (map, mask) to the number.
        how: the metric in a few words.
        unit: the value's unit.
        perfect: the value where there is no error; nothing is better.
        larger_is_worse: on which side of it the others lie.
        bound: whether to spend the ten more maps that `low`, `high` and `corrected` take.

    Raises:
        InputError: the reference is not finite where the metric reads it.
    """
    if comparison.unusable(error.spatial):
        return comparison.failure(unit)
    comparison.check_reference(None if error.spatial else comparison.mask)
    return measure_parts(
        comparison,
        lambda part: summary(error.of(comparison, part), comparison.mask),
        lambda: [summary(found, comparison.mask) for found in error.floor(comparison)],
        how=how,
        unit=unit,
        perfect=perfect,
        larger_is_worse=larger_is_worse,
        bound=bound,
    )


def measure_parts(
    comparison: Comparison,
    at: Callable[[Part], float],
    floors: Callable[[], list[float]],
    *,
    how: str,
    unit: str = "",
    perfect: float = 0.0,
    larger_is_worse: bool = True,
    bound: bool = True,
) -> Measurement:
    """A number that is biased by noise, from what it is of some quarters of the batches.

    Args:
        comparison: the two sides, checked.
        at: the number from these quarters of the batches.
        floors: the number between two halves of either side that is noisy; the worst is the floor.
        how, unit, perfect, larger_is_worse, bound: as of `measure_map`.
    """
    k = comparison.batches
    value = at(QUARTERS)
    if k == 1:
        return Measurement(value, unit=unit, how=f"{how}, one reference image")
    how = f"{how}, at the mean of {k} batches"
    floor = max(floors(), key=lambda found: abs(found - perfect))
    if not bound or k < LEAST_BATCHES:
        why = "" if not bound else f", no bound under {LEAST_BATCHES} batches"
        return Measurement(value, unit=unit, how=how + why, floor=floor)
    halves = np.array([[at(half) for half in split] for split in SPLITS])
    quarters = np.array([at((quarter,)) for quarter in QUARTERS])
    ladder = Ladder(value, halves, quarters, floor, perfect, larger_is_worse)
    if not all(map(math.isfinite, (value, floor, *halves.ravel(), *quarters))):
        return Measurement(value, unit=unit, how=f"{how}, no bound: it is not finite", floor=floor)
    low, high = ladder.bound(comparison.confidence)
    return Measurement(value, low, high, unit, f"{how}, bound from fewer batches", floor, ladder.extrapolated())
