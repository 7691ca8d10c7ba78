"""Percentage-closer filtering: what `shadow_filter.glsl` is compiled with and told."""

import math
from functools import cache
from typing import Any

import numpy as np

from ..effect import Knobs

RADII = {"hard": 0, "pcf3": 1, "pcf5": 2, "pcf7": 3, "pcf9": 4}
"""Texels around the point's own that a square filter compares."""
TURNS = 16
CANDIDATES = 32


def reach(knobs: Knobs) -> int:
    """Texels around a point that the filter reads."""
    return math.ceil(float(knobs["radius"])) if knobs["filter"] == "poisson" else RADII[str(knobs["filter"])]


def defines(knobs: Knobs) -> dict[str, object]:
    """What the filter is compiled with."""
    if knobs["filter"] == "poisson":
        return {"DISK": int(knobs["samples"]), "TURNS": TURNS}
    return {"FILTER_RADIUS": RADII[str(knobs["filter"])]}


def uniforms(knobs: Knobs) -> dict[str, Any]:
    """What the filter is told."""
    if knobs["filter"] != "poisson":
        return {}
    angles = 2 * np.pi * np.arange(TURNS) / TURNS
    return {"disk": disk(int(knobs["samples"])), "turns": np.stack([np.cos(angles), np.sin(angles)], axis=1)}


@cache
def disk(count: int) -> np.ndarray:
    """(count, 2) points in the disk of radius 1, no two of them close (Mitchell 1991, the best of some candidates)."""
    rng = np.random.default_rng(0)
    points = np.zeros((1, 2))
    while len(points) < count:
        radius, angle = np.sqrt(rng.random(CANDIDATES * len(points))), 2 * np.pi * rng.random(CANDIDATES * len(points))
        tried = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
        distance = np.linalg.norm(tried[:, None] - points, axis=2).min(axis=1)
        points = np.concatenate([points, tried[distance.argmax()][None]])
    return points
