"""Where a sun's cascades look: one view for each slice of what the camera sees."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from lightmeter.scenes.model import DirectionalLight, Scene

from ...projection import projection_matrix, view_matrix
from ...shadows.views import ShadowViews, corners_of, light_axes, parallel_view

MOST = 4
"""Cascades: the shader holds their ends in one vector."""
NEVER = 1e30
"""Metres that no scene reaches."""


@dataclass(frozen=True, eq=False)
class Cascades:
    """The views and the depths that each is for.

    Attributes:
        ends: (4,) how far from the camera each cascade reaches, metres; `NEVER` the last one and what is left over.
        depth: (4,) a point's distance along the camera's axis, as a product with (x, y, z, 1).
    """

    views: ShadowViews
    ends: np.ndarray
    depth: np.ndarray


def split_depths(near: float, far: float, count: int, logarithmic: float) -> np.ndarray:
    """(count + 1,) depths that part near to far, by the practical split scheme (Zhang et al. 2006, eq. 6).

    Args:
        logarithmic: how much of a logarithmic division, where all cascades are equally fine on the screen, is mixed
            with an even one: 0…1.
    """
    part = np.arange(count + 1) / count
    return logarithmic * near * (far / near) ** part + (1 - logarithmic) * (near + (far - near) * part)


def cascades(
    scene: Scene,
    light: DirectionalLight,
    size: tuple[int, int],
    resolution: int,
    border: int,
    count: int,
    logarithmic: float,
) -> Cascades:
    """Views that are fitted, each, to what its slice of the camera's field can show of the scene's bounding box.

    Towards the light they reach as far as the scene does: what stands between the light and the slice casts into it.

    Args:
        size: the frame's, in pixels.
        resolution, border: texels along a side of a view, and around it for the filter.
        count, logarithmic: see `split_depths`.
    """
    camera = scene.camera
    clip = projection_matrix(camera, size) @ view_matrix(camera)
    depth = -view_matrix(camera)[2]
    # A pixel more on all sides: the scene is sampled anywhere within pixels.
    sides = [(1 + 2 / pixels) * clip[3] + sign * clip[axis] for axis, pixels in enumerate(size) for sign in (1, -1)]
    low, high = scene.bounds
    box = [np.append(sign * np.eye(3)[k], -sign * end[k]) for sign, end in ((1, low), (-1, high)) for k in range(3)]
    seen = np.stack([*sides, *box])
    nearest, farthest = _extent(_slice(seen, depth, camera.near, camera.far), depth) or (camera.near, camera.far)
    ends = split_depths(nearest, max(farthest, nearest * (1 + 1e-6)), count, logarithmic)
    direction = np.array(light.direction, dtype=np.float64)
    axes = light_axes(direction)
    whole = corners_of(scene) @ axes[:3, :3].T
    found = []
    for start, end in pairwise(ends):
        part = _slice(seen, depth, start * (1 - 1e-6), end * (1 + 1e-6))
        box_low, box_high = whole.min(axis=0), whole.max(axis=0)
        for axis in (0, 1):
            if extent := _extent(part, np.append(axes[axis, :3], 0.0)):
                box_low[axis], box_high[axis] = extent
        found.append(parallel_view(axes, box_low, box_high, resolution - 2 * border, border))
    matrices, texels = (np.array(values) for values in zip(*found, strict=True))
    away = -whole[:, 2]
    views = ShadowViews(matrices, np.append(-direction, 0.0), texels, (float(away.min()), float(away.max())))
    return Cascades(views, np.append(ends[1:-1], np.full(MOST + 1 - count, NEVER)), depth)


def _slice(seen: np.ndarray, depth: np.ndarray, start: float, end: float) -> np.ndarray:
    """(n, 4) half spaces h·(x, y, z, 1) ≥ 0: what is seen between two depths."""
    unit = np.array([0.0, 0.0, 0.0, 1.0])
    return np.stack([*seen, depth - start * unit, end * unit - depth])


def _extent(spaces: np.ndarray, along: np.ndarray) -> tuple[float, float] | None:
    """The least and greatest along·(x, y, z, 1) within half spaces; None where they have nothing in common."""
    from scipy.optimize import linprog

    ends = []
    for sign in (1, -1):
        found = linprog(sign * along[:3], A_ub=-spaces[:, :3], b_ub=spaces[:, 3], bounds=(None, None))
        if not found.success:
            return None
        ends.append(sign * found.fun + along[3])
    return ends[0], ends[1]
