"""Where a light's shadow maps look from: one view, or the six faces of a cube."""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from lightmeter.scenes.emitters import emitter
from lightmeter.scenes.model import AreaLight, DirectionalLight, Light, Scene, SpotLight

WIDEST_SPOT = math.radians(75)
"""Half angle beyond which one plane cannot hold a spot's cone with useful texels; a cube takes over."""

CUBE_FACES = (  # the way each face looks, and its up
    ((1, 0, 0), (0, 1, 0)),
    ((-1, 0, 0), (0, 1, 0)),
    ((0, 1, 0), (0, 0, 1)),
    ((0, -1, 0), (0, 0, 1)),
    ((0, 0, 1), (0, 1, 0)),
    ((0, 0, -1), (0, 1, 0)),
)


@dataclass(frozen=True, eq=False)
class ShadowViews:
    """The views of one light.

    Attributes:
        matrices: (1 or 6, 4, 4) float64, world to clip space.
        position: (4,) the light: position and 1, or the direction towards it and 0.
        texels: per view the world size of a texel: metres, or metres per metre of distance from the light (w = 1).
        depths: least and greatest distance of the scene from the light; for w = 0 along its direction from the origin.
        excluded: a shape that must not shadow itself, the emitter; or None.
    """

    matrices: np.ndarray
    position: np.ndarray
    texels: np.ndarray
    depths: tuple[float, float]
    excluded: int | None = None

    @property
    def planes(self) -> tuple[float, float]:
        """Distances of the near and far plane of perspective views."""
        return _clipping(self.depths)

    @property
    def tiles(self) -> tuple[int, int]:
        """Columns and rows of the map: the views lie beside each other, row by row."""
        columns = math.ceil(math.sqrt(len(self.matrices)))
        return columns, math.ceil(len(self.matrices) / columns)


def shadow_views(scene: Scene, light: Light, resolution: int, border: int) -> ShadowViews:
    """The views that a light's shadow maps are drawn from.

    Args:
        resolution: texels along a side.
        border: texels along each edge that only a filter's neighbours reach. On a cube they repeat what the next
            face shows, so that its edges have no seams.
    """
    used = resolution - 2 * border
    if isinstance(light, DirectionalLight):
        return _parallel(scene, np.array(light.direction, dtype=np.float64), used, border)
    if isinstance(light, SpotLight) and light.outer < WIDEST_SPOT:
        return _cone(scene, light, used, border)
    if isinstance(light, AreaLight):
        return cube_views(scene, emitter(scene, light).centre, used, border, light.shape)
    return cube_views(scene, np.array(light.position, dtype=np.float64), used, border)


def corners_of(scene: Scene) -> np.ndarray:
    """(8, 3) corners of the scene's bounding box."""
    low, high = scene.bounds
    return np.array([[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)])


def _parallel(scene: Scene, direction: np.ndarray, used: int, border: int) -> ShadowViews:
    view = light_axes(direction)
    corners = corners_of(scene) @ view[:3, :3].T
    low, high = corners.min(axis=0), corners.max(axis=0)
    matrix, texel = parallel_view(view, low, high, used, border)
    # Rounding must stay small beside the range, in a scene that is flat to the light as well.
    depth = max(high[2] - low[2], 0.01 * float((high - low).max()))
    return ShadowViews(matrix[None], np.append(-direction, 0.0), np.array([texel]), (-high[2], -high[2] + depth))


def light_axes(direction: np.ndarray) -> np.ndarray:
    """(4, 4) world to axes that look along a direction: −Z; where X and Y lie does not matter."""
    return _look(np.zeros(3), direction, _any_up(direction))


def parallel_view(
    view: np.ndarray, low: np.ndarray, high: np.ndarray, used: int, border: int
) -> tuple[np.ndarray, float]:
    """The view along parallel rays that shows a box, (4, 4) world to clip space, and the size of its texels in metres.

    Args:
        view: what turns the world to the rays' axes.
        low, high: the box's corners along those axes.
        used, border: texels along a side that show it, and on either side around them.
    """
    # A flat scene still gets some depth, and rounding does not push the outermost points outside.
    size = max(float(np.max(high) - np.min(low)), 1e-6)
    margin = np.maximum(high - low, 1e-6 * size) * (border / used) + 1e-5 * size
    low, high = low - margin, high + margin
    extent = high - low
    matrix = np.diag([2 / extent[0], 2 / extent[1], -2 / extent[2], 1.0])
    matrix[:3, 3] = -(high + low) / extent * np.array([1, 1, -1])
    return matrix @ view, float(max(extent[:2])) / (used + 2 * border)


def _cone(scene: Scene, light: SpotLight, used: int, border: int) -> ShadowViews:
    position, direction = np.array(light.position), np.array(light.direction)
    tangent = math.tan(light.outer)
    depths = _distances(scene, position)
    projection = _perspective(tangent * (1 + 2 * border / used), *_clipping(depths))
    matrix = projection @ _look(position, direction, _any_up(direction))
    return ShadowViews(matrix[None], np.append(position, 1.0), np.array([2 * tangent / used]), depths)


def cube_views(scene: Scene, position: np.ndarray, used: int, border: int, excluded: int | None = None) -> ShadowViews:
    """The six faces of a cube about a position; arguments as in `shadow_views`, `excluded` as in `ShadowViews`."""
    depths = _distances(scene, position)
    projection = _perspective(1 + 2 * border / used, *_clipping(depths))
    turns = _cube_turns()
    away = -(turns[:, :3, :3] @ position)
    faces = projection @ np.concatenate([turns[:, :, :3], np.append(away, np.ones((6, 1)), axis=1)[..., None]], axis=2)
    return ShadowViews(faces, np.append(position, 1.0), np.full(6, 2.0 / used), depths, excluded)


def _distances(scene: Scene, position: np.ndarray) -> tuple[float, float]:
    """Least and greatest distance of the scene's bounding box."""
    low, high = scene.bounds
    far = float(np.linalg.norm(corners_of(scene) - position, axis=1).max()) * 1.01 + 1e-9
    return float(np.linalg.norm(np.maximum(np.maximum(low - position, position - high), 0))), far


def _clipping(distances: tuple[float, float]) -> tuple[float, float]:
    """Near and far planes that hold the scene; a depth map of 24 bits still resolves 1e-6 of the far distance."""
    least, far = distances
    return max(least / 2, far * 1e-3), far


def _perspective(tangent: float, near: float, far: float) -> np.ndarray:
    """Clip space of a square view; `tangent` of half its angle."""
    matrix = np.diag([1 / tangent, 1 / tangent, (far + near) / (near - far), 0.0])
    matrix[2, 3], matrix[3, 2] = 2 * far * near / (near - far), -1
    return matrix


@cache
def _cube_turns() -> np.ndarray:
    """(6, 4, 4) world to the axes of each face of a cube about the origin."""
    return np.stack([_look(np.zeros(3), np.array(d, float), np.array(up, float)) for d, up in CUBE_FACES])


def _any_up(direction: np.ndarray) -> np.ndarray:
    """The axis that the direction is most across."""
    return np.eye(3)[np.argmin(np.abs(direction))]


def _look(position: np.ndarray, direction: np.ndarray, up: np.ndarray) -> np.ndarray:
    """World to a view that looks along −Z."""
    back = -direction / np.linalg.norm(direction)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3, :3] = right, np.cross(back, right), back
    matrix[:3, 3] = -matrix[:3, :3] @ position
    return matrix
