"""The torus."""

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Mesh
from lightmeter.scenes.shapes.lattice import lattice, turn
from lightmeter.scenes.shapes.limits import AROUND, check_length, check_steps


def torus(major: float = 1.0, minor: float = 0.4, segments: int = 64, rings: int = 32) -> Mesh:
    """A torus around the Y axis, its vertices on the true torus, with the true normals.

    Args:
        major: from the axis to the middle of the tube, metres.
        minor: the tube's radius, metres, below `major`.
        segments: steps around the axis, 3…1024.
        rings: steps around the tube, 3…1024.

    Returns:
        u runs around the axis, v around the tube, from its innermost circle over the top.

    Raises:
        SceneError: a parameter is out of range.
    """
    major, minor = check_length("major", major), check_length("minor", minor)
    if minor >= major:
        raise SceneError("the tube meets itself", expected=f"minor below major ({major:g})", actual=f"{minor:g}")
    segments, rings = check_steps("segments", segments, AROUND), check_steps("rings", rings, AROUND)
    texcoords, triangles = lattice(segments, rings)
    sin_turn, cos_turn = turn(segments)
    sin_tube, cos_tube = turn(rings)
    around = np.stack([-sin_turn, np.zeros_like(sin_turn), -cos_turn], axis=1)
    normals = -cos_tube[:, None, None] * around + sin_tube[:, None, None] * np.array([0.0, 1.0, 0.0])
    positions = (major * around + minor * normals).reshape(-1, 3)
    return Mesh(positions, triangles, normals.reshape(-1, 3), (texcoords,))
