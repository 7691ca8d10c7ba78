"""Twins of the passes, and of the choice of a bin."""

import numpy as np

from lightmeter.scenes.metering import Metering
from lightmeter.scenes.optics.color import LUMINANCE

from ...effect import Knobs
from ...twin import Argument, Twin, uniform, whole


def bin_of(stops: np.ndarray, low: float | np.ndarray, high: float | np.ndarray, bins: int | np.ndarray) -> np.ndarray:
    """The bin that a number of stops falls in; the first and the last hold what lies beyond."""
    return np.clip(np.floor((stops - low) / (high - low) * bins), 0, bins - 1)


def exposure(image: np.ndarray, knobs: Knobs, metering: Metering) -> float:
    """The log₂ of the average luminance of an (H, W, 3) picture."""
    low, high, bins, stride = float(knobs["low"]), float(knobs["high"]), int(knobs["bins"]), int(knobs["stride"])
    stops = np.log2(np.maximum(image[::-1][::stride, ::stride] @ LUMINANCE, metering.floor))
    counts = np.bincount(bin_of(stops, low, high, bins).astype(int).ravel(), minlength=bins)
    edges = np.clip(np.append(0, np.cumsum(counts)) / counts.sum(), metering.darkest, 1 - metering.brightest)
    return float(np.average(low + (np.arange(bins) + 0.5) * (high - low) / bins, weights=np.diff(edges)))


def _edge(stops, low, high, bins):
    """How far from the edge of a bin: float32 cannot tell on which side."""
    place = ((stops - low) / (high - low) * bins)[0]
    return [(place - np.round(place), np.abs(place) + np.abs(low / (high - low) * bins)[0])]


TWINS = (
    Twin(
        "bin_of.glsl",
        "bin_of",
        "int",
        (
            Argument("stops", "float", uniform(-20.0, 20.0), (-100.0, 0.1, 100.0)),
            Argument("low", "float", uniform(-16.0, -4.0), (-12.0,)),
            Argument("high", "float", uniform(4.0, 16.0), (12.0,)),
            Argument("bins", "int", whole(2, 256)),
        ),
        bin_of,
        signs=_edge,
        roundings=0,
        why="a whole number: right, or where its fraction is within rounding of an edge, either side's",
    ),
)
