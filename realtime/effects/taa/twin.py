"""Twin of the pass."""

import numpy as np

from lightmeter.scenes.model import Camera
from lightmeter.scenes.points import SurfacePoints

from ...effect import Knobs

YCOCG = np.array([[0.25, 0.5, 0.25], [0.5, 0.0, -0.5], [-0.25, 0.5, -0.25]])
"""Luma, orange against blue, green against the others (Malvar & Sullivan 2003)."""


def share(before: int, blend: float) -> float:
    """Of a new frame in what is shown, after so many: as much as each of them has, and `blend` at least."""
    return max(1.0 / (1 + before), blend)


def gathered(samples: np.ndarray, _points: SurfacePoints, camera: Camera, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (n, H, W, 3) frames one after another to what is shown, (H, W, 3)."""
    shown = samples[0].astype(np.float64)
    for before, fresh in enumerate(samples[1:].astype(np.float64), 1):
        new = share(before, float(knobs["blend"]))
        old = _clamped(shown, fresh) if knobs["clamp"] and new < 1 else shown
        weights = np.broadcast_to(np.array([1 - new, new]).reshape(2, 1, 1, 1), (2, *shown.shape[:2], 1))
        if knobs["weigh"]:
            luma = np.stack([(image @ YCOCG[0])[..., None] for image in (old, fresh)])
            weights = weights / (1 + float(camera.exposure_scale()) * np.maximum(luma, 0))
            weights = weights / weights.sum(axis=0)
        shown = weights[0] * old + weights[1] * fresh
    return shown.astype(np.float32)


def _clamped(old: np.ndarray, fresh: np.ndarray) -> np.ndarray:
    """The history within the box of the new colours around each pixel."""
    height, width = fresh.shape[:2]
    padded = np.pad(fresh @ YCOCG.T, ((1, 1), (1, 1), (0, 0)), mode="edge")
    near = np.stack([padded[y : y + height, x : x + width] for y in range(3) for x in range(3)])
    return np.clip(old @ YCOCG.T, near.min(axis=0), near.max(axis=0)) @ np.linalg.inv(YCOCG).T


TWINS = ()
