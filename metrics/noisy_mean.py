"""Metrics that are not linear, of a reference that is noisy.

The noise of the mean biases such a metric, mostly upwards, and no estimator is free of it. So three numbers are
reported: the value at the full mean; that value corrected by a delete-a-group jackknife (Quenouille 1956; unequal
groups: Busing, Meijer and van der Leeden 1999), which takes off the part of the bias that falls as 1/K, and only
about half of the part that falls as 1/√K, as near zero error; and the floor, the same metric between two halves of
the reference, about what two equal but noisy images would get. No interval is claimed.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np

from .comparison import Comparison
from .measurement import Measurement

Image = np.ndarray


def measure_noisy_mean(
    comparison: Comparison,
    metric: Callable[[Image, Image], Image | float],
    *,
    how: str,
    unit: str = "",
    display: Callable[[Image], Image] | None = None,
    groups: int = 4,
    spatial: bool = False,
) -> Measurement:
    """A non-linear metric at the mean of the batches, corrected, and its noise floor.

    Args:
        comparison: the two sides.
        metric: (tested, reference), both (H, W, 3), to a map (H, W) whose mean over the mask is taken.
        how: the metric in a few words.
        unit: the value's unit.
        display: put on both sides first; identity when None.
        groups: jackknife replicates, at most the number of batches; below 2 there is no `corrected`.
        spatial: the metric's filters read past the mask.

    Returns:
        value, corrected (None below 2 batches or groups), floor (None below 2 batches); no interval.

    Raises:
        InputError: the reference is not finite where the metric reads it.
    """
    if comparison.unusable(spatial):
        return comparison.failure(unit)
    comparison.check_reference(None if spatial else comparison.mask)
    mask = comparison.mask

    def shown(image: Image) -> Image:
        if mask is not None and not spatial:
            # Outside the mask may be NaN, which a display transform need not survive.
            image = np.where(mask[..., None], image, 0)
        return image if display is None else display(image)

    def evaluate(tested: Image, reference: Image) -> float:
        error = np.asarray(metric(shown(tested), shown(reference)))
        return float(np.mean(error if mask is None else error[mask], dtype=np.float64))

    k = comparison.batches
    value = evaluate(comparison.mean_tested, comparison.mean_reference)
    if k == 1:
        return Measurement(value, unit=unit, how=f"{how}, one reference image")

    def without(group: Sequence[int]) -> float:
        kept = [i for i in range(k) if i not in group]
        return evaluate(comparison.tested_mean_of(kept), comparison.mean_of(kept))

    corrected = None
    groups = min(groups, k)
    if groups >= 2:
        parts = [range(g, k, groups) for g in range(groups)]
        corrected = groups * value - math.fsum((1 - len(part) / k) * without(part) for part in parts)
    floor = evaluate(comparison.mean_of(range(0, k, 2)), comparison.mean_of(range(1, k, 2)))
    return Measurement(value, unit=unit, how=f"{how}, at the mean of {k} batches", floor=floor, corrected=corrected)
