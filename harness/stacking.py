"""Several sub-pixel samples of one image as one array with a leading axis, so that an oracle sees them in one call."""

from collections.abc import Sequence
from dataclasses import fields

import numpy as np

from lightmeter.scenes.points import SurfacePoints


def stack_points(samples: Sequence[SurfacePoints]) -> SurfacePoints:
    """(n, H, W, …) of n captures of (H, W, …)."""
    parts = {f.name: [getattr(s, f.name) for s in samples] for f in fields(SurfacePoints)}
    return SurfacePoints(**{name: np.stack(arrays) for name, arrays in parts.items() if arrays[0] is not None})


def reshape_points(points: SurfacePoints, lead: tuple[int, ...]) -> SurfacePoints:
    """The same points with other leading axes."""
    old = points.shape.ndim
    return points.each(lambda a: a.reshape(*lead, *a.shape[old:]))


def mean_samples(stacked: np.ndarray) -> np.ndarray:
    """(H, W, 3) float32: the pixel's mean over its n samples, from (n, H, W, 3)."""
    return stacked[0] if len(stacked) == 1 else stacked.mean(axis=0, dtype=np.float64).astype(np.float32)


def at_sample(points: SurfacePoints, sample: int) -> SurfacePoints:
    """(H, W, …): one of the samples of (n, H, W, …)."""
    return points.each(lambda a: a[sample])
