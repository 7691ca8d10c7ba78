"""The box."""

import numpy as np

from lightmeter.scenes.model import Mesh
from lightmeter.scenes.shapes.lattice import joined
from lightmeter.scenes.shapes.limits import check_length
from lightmeter.scenes.shapes.plane import rectangle

# Each side's frame: where its image's right, its up and its outward normal point.
_X, _Y, _Z = np.eye(3)
_SIDES = ((-_Z, _Y, _X), (_Z, _Y, -_X), (_X, -_Z, _Y), (_X, _Z, -_Y), (_X, _Y, _Z), (-_X, _Y, -_Z))


def box(width: float = 1.0, height: float = 1.0, depth: float = 1.0, segments: int = 1) -> Mesh:
    """A box around the origin, with sharp edges.

    Args:
        width, height, depth: along X, Y and Z, metres.
        segments: cells along each edge, 1…1024.

    Returns:
        Sides in the order +X, −X, +Y, −Y, +Z, −Z; each has the whole texture, upright seen from outside (the
        top's lower edge is at +Z).

    Raises:
        SceneError: a parameter is out of range.
    """
    size = np.array([check_length(n, v) for n, v in (("width", width), ("height", height), ("depth", depth))])
    unit = rectangle(1.0, 1.0, segments)
    sides = []
    for right, up, out in _SIDES:
        frame = np.stack([right, up, out], axis=1)
        positions = (unit.positions @ frame.T + out / 2) * size
        normals = np.tile(out, (len(positions), 1))
        sides.append(Mesh(positions, unit.triangles, normals, unit.texcoords))
    return joined(*sides)
