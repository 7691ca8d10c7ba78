"""What must hold of every scene, wherever it came from."""

from collections.abc import Sequence

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Mesh, Shape

FARTHEST = 1e9
"""Metres from the origin; beyond, float32 squares of distances lose their meaning or overflow."""

MOST_SHAPES = 20_000
MOST_VERTICES = 30_000_000
"""Of all shapes together, each counted as often as it is placed."""


class Budget:
    """Keeps a small file from asking for a scene that fills the memory."""

    def __init__(self, where: str):
        self._where = where
        self._shapes = self._vertices = 0

    def spend(self, mesh: Mesh) -> None:
        """Counts a placed mesh.

        Raises:
            SceneError: the scene has become too large.
        """
        self._shapes += 1
        self._vertices += len(mesh.positions)
        if self._shapes > MOST_SHAPES or self._vertices > MOST_VERTICES:
            raise SceneError(
                "the scene is too large",
                where=self._where,
                expected=f"at most {MOST_SHAPES} shapes and {MOST_VERTICES} vertices, instances counted",
            )


def check_shapes(shapes: Sequence[Shape], where: str) -> None:
    """Checks that the shapes can be drawn.

    Raises:
        SceneError: there is no triangle, or one whose corners are not finite or too far away in world space.
    """
    if not any(len(shape.mesh.triangles) for shape in shapes):
        raise SceneError("the scene has no triangles", where=where, remedy="add a shape")
    for shape in shapes:
        with np.errstate(all="ignore"):
            positions = shape.world.positions
        if not np.isfinite(positions).all() or np.abs(positions).max(initial=0) > FARTHEST:
            raise SceneError(
                f"the shape {shape.name[:80]!r} is not finite, or too far away",
                where=where,
                expected=f"world positions within {FARTHEST:g} metres",
                remedy="check its positions and its place",
            )
