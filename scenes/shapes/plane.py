"""Flat sheets: `plane` lies, `rectangle` stands."""

import numpy as np

from lightmeter.scenes.model import Mesh
from lightmeter.scenes.shapes.lattice import lattice
from lightmeter.scenes.shapes.limits import ALONG, check_length, check_steps


def plane(width: float = 1.0, depth: float = 1.0, segments: int = 1) -> Mesh:
    """A sheet in y = 0 around the origin, facing +Y.

    Args:
        width: along X, metres.
        depth: along Z, metres.
        segments: cells along each side, 1…1024.

    Returns:
        u grows along +X and v along +Z.

    Raises:
        SceneError: a parameter is out of range.
    """
    sheet = rectangle(width, depth, segments)
    x, y, z = sheet.positions.T
    flat = np.stack([x, z, -y], axis=1)
    return Mesh(flat, sheet.triangles, np.tile((0.0, 1.0, 0.0), (len(flat), 1)), sheet.texcoords)


def rectangle(width: float = 1.0, height: float = 1.0, segments: int = 1) -> Mesh:
    """A sheet in z = 0 around the origin, facing +Z.

    Args:
        width: along X, metres.
        height: along Y, metres.
        segments: cells along each side, 1…1024.

    Returns:
        An image on it stands upright: u grows along +X and v along −Y.

    Raises:
        SceneError: a parameter is out of range.
    """
    width, height = check_length("width", width), check_length("height", height)
    steps = check_steps("segments", segments, ALONG)
    texcoords, triangles = lattice(steps, steps)
    x, y = (texcoords[:, 0] - 0.5) * width, (0.5 - texcoords[:, 1]) * height
    positions = np.stack([x, y, np.zeros_like(x)], axis=1)
    return Mesh(positions, triangles, np.tile((0.0, 0.0, 1.0), (len(x), 1)), (texcoords,))
