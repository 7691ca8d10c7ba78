"""The disk."""

import numpy as np

from lightmeter.scenes.model import Mesh
from lightmeter.scenes.shapes.lattice import turn
from lightmeter.scenes.shapes.limits import AROUND, check_length, check_steps


def disk(radius: float = 1.0, segments: int = 48) -> Mesh:
    """A disk in y = 0 around the origin, facing +Y: a fan around its centre.

    Args:
        radius: metres.
        segments: corners, 3…1024.

    Returns:
        The texture is laid flat on it: u grows along +X and v along +Z, as on a plane.

    Raises:
        SceneError: a parameter is out of range.
    """
    radius = check_length("radius", radius)
    segments = check_steps("segments", segments, AROUND)
    sin_turn, cos_turn = turn(segments)
    rim = np.stack([-sin_turn, np.zeros_like(sin_turn), -cos_turn], axis=1)[:-1]
    unit = np.concatenate([[(0.0, 0.0, 0.0)], rim])
    here = np.arange(segments)
    triangles = np.stack([np.zeros_like(here), here + 1, (here + 1) % segments + 1], axis=1)
    texcoords = 0.5 + 0.5 * unit[:, [0, 2]]
    return Mesh(radius * unit, triangles, np.tile((0.0, 1.0, 0.0), (len(unit), 1)), (texcoords,))
