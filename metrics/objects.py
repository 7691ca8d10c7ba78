"""Which object holds the error: every object's own pixels, and its share of the frame's squared error.

An object is a comparison of its own pixels, so that everything said of the metrics of a frame holds for it. Pixels
are sorted by object once; the rest is a walk over the objects, not over the pixels.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .bias import bias
from .comparison import Comparison
from .input_error import InputError
from .interval import MIN_BATCHES, mean_interval, u_statistic
from .measurement import Measurement
from .moments import Moments
from .mse import mse, rmse

MOST_BATCHES = 16
"""More are averaged in groups: an object's interval costs the cube of their number, and a scene has thousands."""


@dataclass(frozen=True)
class ObjectPart:
    """What one object has to do with the frame's error.

    Attributes:
        pixels: how many show it.
        metrics: "mse", "rmse" and "bias" over those pixels, and "flip" where a map of it was given.
        share: of the frame's squared error. Shares of all objects add up to 1; noise may make one negative. NaN where
            the frame has no error to share out.
    """

    pixels: int
    metrics: Mapping[str, Measurement]
    share: Measurement


def by_object(comparison: Comparison, ids: np.ndarray, flip_map: np.ndarray | None = None) -> dict[int, ObjectPart]:
    """The error of every object that an image of ids shows, in the order of the ids.

    Args:
        comparison: the two sides, scene-linear. Pixels outside its mask belong to no object.
        ids: (H, W) integers, which object a pixel shows; -1 for none, which is listed as an object of that id.
        flip_map: (H, W) FLIP per pixel, whose mean over the object is given (NaN pixels make it NaN); no interval.

    Raises:
        InputError: the ids or the map do not fit the images, or the reference is not finite.
    """
    _check(comparison, ids, flip_map)
    counted = np.arange(ids.size) if comparison.mask is None else np.flatnonzero(comparison.mask)
    order = counted[np.argsort(ids.ravel()[counted], kind="stable")]
    found, starts = np.unique(ids.ravel()[order], return_index=True)
    pixels = dict(zip(found.tolist(), np.split(order, starts[1:]), strict=True))

    tested, reference = _few(comparison.tested_batches), _few(comparison.reference)
    parts = {
        number: Comparison(_at(tested, which), _at(reference, which), confidence=comparison.confidence)
        for number, which in pixels.items()
    }
    shares = _shares(parts, comparison.confidence)
    return {
        number: ObjectPart(
            len(pixels[number]),
            {"mse": mse(part), "rmse": rmse(part), "bias": bias(part)} | _flip(flip_map, pixels[number]),
            shares[number],
        )
        for number, part in parts.items()
    }


def _few(batches: list[np.ndarray]) -> list[np.ndarray]:
    """(H·W, 1, 3) each: the batches, or at most MOST_BATCHES means of as many each; what is left over is left out."""
    size = math.ceil(len(batches) / MOST_BATCHES)
    groups = [batches[first : first + size] for first in range(0, len(batches) - size + 1, size)]
    means = [group[0] if size == 1 else np.mean(group, axis=0, dtype=np.float64) for group in groups]
    return [mean.reshape(-1, 1, 3) for mean in means]


def _at(images: list[np.ndarray], pixels: np.ndarray) -> list[np.ndarray]:
    return [image[pixels] for image in images]


def _shares(parts: Mapping[int, Comparison], confidence: float) -> dict[int, Measurement]:
    """Each object's sum of squared errors over that of all, both unbiased; the interval is the ratio's jackknife."""
    if any(part.unusable() for part in parts.values()):
        return dict.fromkeys(parts, Measurement(math.nan, how="undefined: the tested image is not finite everywhere"))
    sums = {number: _sum_of_squares(part.moments) for number, part in parts.items()}
    total = math.fsum(value for value, _ in sums.values())
    left_out = np.sum([left for _, left in sums.values()], axis=0)
    if not total > 0:
        return dict.fromkeys(parts, Measurement(math.nan, how="undefined: the frame's error is within its noise"))
    batches = next(iter(parts.values())).batches
    how = f"sum of squared errors over the frame's, {batches} batches"
    if batches < MIN_BATCHES or not left_out.min() > 0:
        why = f"under {MIN_BATCHES} batches" if batches < MIN_BATCHES else "the frame's error is within its noise"
        return {n: Measurement(value / total, how=f"{how}, no interval: {why}") for n, (value, _) in sums.items()}
    return {
        number: Measurement(
            value / total,
            *mean_interval(value / total, left / left_out, confidence),
            how=f"{how}, jackknife, Student t",
        )
        for number, (value, left) in sums.items()
    }


def _sum_of_squares(moments: Moments) -> tuple[float, np.ndarray]:
    """Over the pixels, unbiased where there are batches, and with each left out; nothing to leave out of one."""
    if moments.batches == 1:
        return float(moments.gram[0, 0]) * moments.values, np.empty(0)
    value, left_out = u_statistic(moments.gram)
    return value * moments.values, left_out * moments.values


def _flip(flip_map: np.ndarray | None, pixels: np.ndarray) -> dict[str, Measurement]:
    if flip_map is None:
        return {}
    return {"flip": Measurement(float(flip_map.ravel()[pixels].mean(dtype=np.float64)), how="mean of the map")}


def _check(comparison: Comparison, ids: np.ndarray, flip_map: np.ndarray | None) -> None:
    size = comparison.height, comparison.width
    if ids.shape != size or not np.issubdtype(ids.dtype, np.integer):
        raise InputError(
            "the object ids do not fit the images",
            expected=f"integers of shape {size}",
            actual=f"{ids.dtype} of shape {ids.shape}",
            remedy="Give one id a pixel, -1 where there is no object.",
        )
    if flip_map is not None and flip_map.shape != size:
        raise InputError(
            "the FLIP map does not fit the images",
            expected=f"shape {size}",
            actual=str(flip_map.shape),
            remedy="Make it from the same two images.",
        )
