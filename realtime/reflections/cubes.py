"""What stands around a point, in the six faces of a cube."""

from collections.abc import Collection
from typing import Any

import numpy as np

from lightmeter.scenes.model import Scene

from ..lit_views import LitViews
from ..shadows.views import cube_views
from ..stage import Stage
from .mirrors import box_of

BORDER = 1
"""Texels of each face that repeat its neighbours', so that interpolation has no seams."""


class LitCube:
    """The lit scene as it is seen from a point.

    Args:
        size: side of each face in texels.
        ambient: see `LitViews`.
    """

    def __init__(self, stage: Stage, centre: np.ndarray, size: int, ambient: float) -> None:
        self._views = cube_views(stage.scene, centre, size - 2 * BORDER, BORDER).matrices
        self._lit = LitViews(stage, len(self._views), (size, size), np.append(centre, 1.0), ambient)
        self._centre = centre

    def draw(self, excluded: Collection[int]) -> None:
        """Fill the faces, some shapes left out."""
        self._lit.draw(list(self._views), excluded)

    @property
    def image(self) -> Any:
        """The texture with all faces."""
        return self._lit.texture

    @property
    def places(self) -> Any:
        """The texture of where what is seen lies; w = 0 where there is no surface."""
        return self._lit.position

    @property
    def uniforms(self) -> dict[str, Any]:
        """What `cube_maps.glsl` is told of one cube."""
        return {"cube_views": self._views, "cube_centres": self._centre[None]}


def around(scene: Scene, point: np.ndarray) -> tuple[int, ...]:
    """The shapes that would hide everything from a point: those around it that are solid enough to have an inside."""
    hiding = []
    for index, shape in enumerate(scene.shapes):
        if not len(shape.mesh.triangles):
            continue
        low, high = box_of(shape)
        if np.all(low < point) and np.all(point < high) and _is_convex_about(shape, point):
            hiding.append(index)
    return tuple(hiding)


def _is_convex_about(shape, point: np.ndarray) -> bool:
    """Whether every face shows its back to the point."""
    mesh = shape.world
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    return bool(np.all(np.sum(np.cross(b - a, c - a) * (point - a), axis=1) <= 0))


def middle(scene: Scene) -> np.ndarray:
    """(3,) the middle of the scene's box."""
    low, high = scene.bounds
    return (low + high) / 2


def proxy(scene: Scene, scale: float = 1.0) -> dict[str, np.ndarray]:
    """The uniforms `box_low` and `box_high`: the scene's box, larger or smaller about its middle."""
    centre = middle(scene)
    low, high = (centre + scale * (corner - centre) for corner in scene.bounds)
    return {"box_low": low, "box_high": high}
