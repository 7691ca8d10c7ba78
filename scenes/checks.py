"""What must hold of every scene, wherever it came from."""

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Scene

FARTHEST = 1e9
"""Metres from the origin; beyond, float32 squares of distances lose their meaning or overflow."""


def checked(scene: Scene, where: str) -> Scene:
    """`scene`, if it can be drawn.

    Raises:
        SceneError: it has no triangle, or one whose corners are not finite or too far away in world space.
    """
    if not any(len(shape.mesh.triangles) for shape in scene.shapes):
        raise SceneError("the scene has no triangles", where=where, remedy="add a shape")
    for shape in scene.shapes:
        with np.errstate(all="ignore"):
            positions = shape.world.positions
        if not np.isfinite(positions).all() or np.abs(positions).max(initial=0) > FARTHEST:
            raise SceneError(
                f"the shape {shape.name!r} is not finite, or too far away",
                where=where,
                expected=f"world positions within {FARTHEST:g} metres",
                remedy="check its positions and its place",
            )
    return scene
