"""Percentage-closer filtering: maps of depths that `shadow_filter.glsl` compares."""

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ..effect import Knobs
from ..stage import Stage
from .passes import ShadowPasses

RADII = {"hard": 0, "pcf3": 1, "pcf5": 2, "pcf7": 3, "pcf9": 4}
"""Texels around the point's own that a square filter compares."""
TURNS = 16
CANDIDATES = 32


def reach(knobs: Knobs) -> int:
    """Texels around a point that the filter reads."""
    return math.ceil(float(knobs["radius"])) if knobs["filter"] == "poisson" else RADII[str(knobs["filter"])]


class ComparedPasses(ShadowPasses):
    """Maps of depths, compared."""

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        # A point that is moved along its normal may lie as far aside.
        super().__init__(stage, knobs, folder, reach(knobs) + math.ceil(float(knobs["normal_offset"])))

    def defines(self, light: int) -> dict[str, object]:
        """What the comparison is compiled with."""
        filtering = str(self.knobs["filter"])
        disk = filtering == "poisson"
        own = {"DISK": int(self.knobs["samples"]), "TURNS": TURNS} if disk else {"FILTER_RADIUS": RADII[filtering]}
        return super().defines(light) | own

    def uniforms(self, light: int) -> dict[str, Any]:
        """What the comparison is told."""
        angles = 2 * np.pi * np.arange(TURNS) / TURNS
        turns = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        return super().uniforms(light) | {"disk": disk(int(self.knobs["samples"])), "turns": turns}


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
