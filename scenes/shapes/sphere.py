"""The sphere."""

import numpy as np

from lightmeter.scenes.model import Mesh
from lightmeter.scenes.shapes.lattice import lattice, turn
from lightmeter.scenes.shapes.limits import AROUND, RINGS, check_length, check_steps


def sphere(radius: float = 1.0, segments: int = 48, rings: int | None = None) -> Mesh:
    """A sphere around the origin, its vertices on the true sphere, with the true normals.

    Args:
        radius: metres.
        segments: steps around the Y axis, 3…1024.
        rings: steps from pole to pole, 2…1024; half the segments unless said.

    Returns:
        An equirectangular image on it stands upright: its middle faces +Z and u grows to the right, seen from
        outside. Each pole is a vertex per segment, so that no triangle is degenerate.

    Raises:
        SceneError: a parameter is out of range.
    """
    radius = check_length("radius", radius)
    segments = check_steps("segments", segments, AROUND)
    rings = check_steps("rings", max(2, segments // 2) if rings is None else rings, RINGS)
    texcoords, triangles = lattice(segments, rings)
    polar = np.pi * np.arange(rings + 1) / rings
    sin_polar = np.where(np.arange(rings + 1) % rings == 0, 0.0, np.sin(polar))  # sin π is not 0 in floats
    sin_turn, cos_turn = turn(segments)
    normals = np.stack(
        [
            -np.outer(sin_polar, sin_turn),
            np.outer(np.cos(polar), np.ones(segments + 1)),
            -np.outer(sin_polar, cos_turn),
        ],
        axis=-1,
    ).reshape(-1, 3)
    return Mesh(radius * normals, _without_slivers(triangles, segments), normals, (_polar_u(texcoords, segments),))


def _without_slivers(triangles: np.ndarray, segments: int) -> np.ndarray:
    """Leaves out the triangles that have two corners on one pole."""
    half = len(triangles) // 2
    lower, upper = triangles[:half], triangles[half:]
    return np.concatenate([lower[:-segments], upper[segments:]])


def _polar_u(texcoords: np.ndarray, segments: int) -> np.ndarray:
    """Puts each pole vertex at the middle of the segment whose triangle it closes."""
    out = texcoords.copy()
    out[: segments + 1, 0] += 0.5 / segments  # the top left corner of its cell
    out[-(segments + 1) :, 0] -= 0.5 / segments  # the bottom right corner
    return out
