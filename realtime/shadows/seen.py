"""Which part of a light's view the camera's picture looks up: what it sees of the scene, as the light sees it.

What the camera sees lies within a convex solid: its pyramid, cut with the scene's bounding box. A light's view of that
is the convex outline of its edges, cut with the view's square. The corners of a cut of two convex figures are those of
the one that lie in the other, and where their sides cross: so the solid's edges, each cut with the view, and the view's
corners that look at the solid, span it.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from lightmeter.scenes.model import Scene

from ..light_bounds import Rectangle
from ..projection import projection_matrix, view_matrix
from .views import ShadowViews

THICKNESS = 1e-3
"""Of the scene's size: what a flat one gets on all sides, and others too."""
ROUNDING = 2.0**-20
"""Of the largest coordinate: sixteen times what float32 rounds it by, in a point's place and in where a view has it."""


@dataclass(frozen=True, eq=False)
class SeenSolid:
    """What the camera sees.

    Attributes:
        spaces: (n, 4) half spaces h·(x, y, z, 1) ≥ 0, of normals of length 1.
        edges: (m, 2, 3) both ends of each; none where nothing is seen.
    """

    spaces: np.ndarray
    edges: np.ndarray


def seen_solid(scene: Scene, size: tuple[int, int]) -> SeenSolid:
    """The camera's pyramid, a pixel wider on all sides, since the scene is sampled anywhere within pixels; and the box.

    Args:
        size: the picture's width and height in pixels.
    """
    clip = projection_matrix(scene.camera, size) @ view_matrix(scene.camera)
    wider = [1 + 2 / pixels for pixels in size] + [1.0]
    pyramid = [wide * clip[3] + sign * clip[axis] for axis, wide in enumerate(wider) for sign in (1, -1)]
    low, high = scene.bounds
    box = [np.append(sign * np.eye(3)[k], -sign * end[k]) for sign, end in ((1, low), (-1, high)) for k in range(3)]
    spaces = np.stack([*pyramid, *box])
    spaces /= np.linalg.norm(spaces[:, :3], axis=1, keepdims=True)
    reach = np.abs(np.stack([low, high, scene.camera.position])).max()
    margin = THICKNESS * (high - low).max() + ROUNDING * reach
    spaces[:, 3] += margin
    return SeenSolid(spaces, _edges(spaces, 1e-6 * margin))


def looked_up(solid: SeenSolid, views: ShadowViews, resolution: int, around: int) -> list[Rectangle | None]:
    """For each view, in its own texels, the smallest rectangle with all that is looked up; None where nothing is.

    Args:
        resolution: texels along a side of a view.
        around: texels around a point that are read as well.
    """
    matrices = views.matrices
    ends = np.concatenate([solid.edges, np.ones((*solid.edges.shape[:2], 1))], axis=2)
    one, other = (np.einsum("vij,ej->vei", matrices, ends[:, end]) for end in (0, 1))
    start, stop = _within(_sides(one), _sides(other) - _sides(one), 0.0, 1.0)
    none = start > stop
    cut = np.stack([one + np.where(none, np.nan, t)[..., None] * (other - one) for t in (start, stop)], axis=2)
    # An edge that goes through the light itself ends there in no direction; the views' corners then look at the solid.
    places = cut[..., :2] / np.maximum(cut[..., 3:], 1e-300)
    corners = np.array([(x, y) for x in (-1.0, 1.0) for y in (-1.0, 1.0)])
    shown = np.where(_corners_look_at(solid, views, corners)[..., None], corners, np.nan)
    every = np.concatenate([places.reshape(len(matrices), -1, 2), shown], axis=1)
    return [_rectangle(found[~np.isnan(found).any(axis=1)], resolution, around) for found in every]


def _edges(spaces: np.ndarray, on: float) -> np.ndarray:
    """(m, 2, 3): what the half spaces leave of the line in which two of their planes cross.

    Args:
        on: how far outside of a half space a point still counts as in it: rounding of float64.
    """
    pairs = np.array(list(combinations(range(len(spaces)), 2)))
    (a, b), ((u, g), (v, h)) = pairs.T, ((spaces[k, :3], spaces[k, 3:]) for k in pairs.T)
    along = np.cross(u, v)
    square = np.sum(along**2, axis=1, keepdims=True)
    cross = square[:, 0] > 1e-12  # others are parallel
    a, b, u, g, v, h, along, square = (x[cross] for x in (a, b, u, g, v, h, along, square))
    start = -(g * np.cross(v, along) + h * np.cross(along, u)) / square
    distance, change = start @ spaces[:, :3].T + spaces[:, 3], along @ spaces[:, :3].T
    for own in (a, b):
        distance[np.arange(len(start)), own] = change[np.arange(len(start)), own] = 0.0
    first, last = _within(distance + on, change, -np.inf, np.inf)
    there = first < last
    return start[there, None] + np.stack([first, last], axis=1)[there, :, None] * along[there, None]


def _sides(clip: np.ndarray) -> np.ndarray:
    """(…, 4) that are 0 or more where (…, 4) in clip space lies in a view's square."""
    x, y, w = clip[..., 0], clip[..., 1], clip[..., 3]
    return np.stack([w - x, w + x, w - y, w + y], axis=-1)


def _within(at_start: np.ndarray, change: np.ndarray, first, last) -> tuple[np.ndarray, np.ndarray]:
    """Where along lines values that are `at_start` at 0, and change so from there to 1, are all 0 or more.

    Args:
        at_start, change: (…, n).
        first, last: what part of the lines is meant.

    Returns:
        The ends; first > last where there is no such part.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        zero = -at_start / change
    never = ((change == 0) & (at_start < 0)).any(axis=-1)
    low = np.where(change > 0, zero, -np.inf).max(axis=-1, initial=-np.inf)
    high = np.where(change < 0, zero, np.inf).min(axis=-1, initial=np.inf)
    low, high = np.maximum(low, first), np.minimum(high, last)
    return np.where(never, np.inf, low), np.where(never, -np.inf, high)


def _corners_look_at(solid: SeenSolid, views: ShadowViews, corners: np.ndarray) -> np.ndarray:
    """(views, corners): whether the ray of light to a view's corner meets the solid."""
    inverse = np.linalg.inv(views.matrices)
    near, far = (
        np.einsum("vij,cj->vci", inverse, np.column_stack([corners, np.full((len(corners), 2), (z, 1.0))]))
        for z in (-1.0, 1.0)
    )
    near, far = near[..., :3] / near[..., 3:], far[..., :3] / far[..., 3:]
    from_light = views.position[3] > 0
    start = np.broadcast_to(views.position[:3], near.shape) if from_light else near
    along = far - near
    distance = start @ solid.spaces[:, :3].T + solid.spaces[:, 3]
    first, last = _within(distance, along @ solid.spaces[:, :3].T, 0.0 if from_light else -np.inf, np.inf)
    return first <= last


def _rectangle(places: np.ndarray, resolution: int, around: int) -> Rectangle | None:
    """That of points in −1…1, and the texels around them."""
    if not len(places):
        return None
    texels = (np.clip(places, -1, 1) + 1) / 2 * resolution
    low = np.maximum(np.floor(texels.min(axis=0)).astype(int) - around, 0)
    high = np.minimum(np.ceil(texels.max(axis=0)).astype(int) + around, resolution)
    (left, bottom), (width, height) = low.tolist(), (high - low).tolist()
    return left, bottom, width, height
