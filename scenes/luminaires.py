"""Emissive shapes that are a rectangle, a disk or a sphere, recognised from their triangles."""

from dataclasses import dataclass

import numpy as np

from .facets import ROUNDINGS, facets, is_closed
from .model import Mesh

ROUND = 1e-4
"""How far a corner may lie from a circle or a sphere, as a share of the radius."""

FEWEST_RIM_CORNERS = 12
"""A regular polygon with fewer corners is one, and no disk: of an octagon's circumscribed circle a tenth is missing."""

SMALLEST_SPHERE = 0.8
"""A polyhedron that holds less of its circumscribed sphere's volume is no sphere (an icosahedron holds 0.61)."""


@dataclass(frozen=True, eq=False)
class Rectangle:
    """A flat rectangle that emits from its front.

    Attributes:
        centre: (3,) float64, world space, metres.
        axes: (3, 3) float64, the unit vectors along its sides and its normal, right-handed; by rows.
        extent: (2,) float64, half its sides, metres.
    """

    centre: np.ndarray
    axes: np.ndarray
    extent: np.ndarray


@dataclass(frozen=True, eq=False)
class Disk:
    """A flat disk that emits from its front; the radius is that of the same area.

    Attributes:
        centre: (3,) float64, world space, metres.
        axes: (3, 3) float64, two unit vectors across its normal, and the normal, right-handed; by rows.
        radius: metres.
    """

    centre: np.ndarray
    axes: np.ndarray
    radius: float


@dataclass(frozen=True, eq=False)
class Sphere:
    """A sphere that emits outwards; the radius is that of the same area.

    Attributes:
        centre: (3,) float64, world space, metres.
        radius: metres.
    """

    centre: np.ndarray
    radius: float


Luminaire = Rectangle | Disk | Sphere


def recognise(mesh: Mesh) -> Luminaire | None:
    """What a mesh in world space is; None where it is none of these.

    A rim of at least twelve corners on a circle is a disk. A closed mesh with its vertices on a sphere, that fills most
    of it, is a sphere.
    """
    positions, corners = np.unique(mesh.positions[mesh.triangles.ravel()], axis=0, return_inverse=True)
    if len(positions) < 3:
        return None
    spread = np.linalg.svd(positions - positions.mean(axis=0, dtype=np.float64), compute_uv=False)
    if spread[-1] > ROUNDINGS * np.abs(positions).max() * len(positions) ** 0.5:
        return _sphere(positions.astype(np.float64), corners.reshape(-1, 3)) if is_closed(mesh) else None
    polygons = facets(mesh)
    return _rectangle(polygons[0]) or _disk(polygons[0]) if len(polygons) == 1 else None


def _rectangle(corners: np.ndarray) -> Rectangle | None:
    if len(corners) != 4:
        return None
    across, up = corners[1] - corners[0], corners[3] - corners[0]
    size = np.linalg.norm(across), np.linalg.norm(up)
    skew = abs(across @ up) / (size[0] * size[1])
    if skew > ROUND or np.linalg.norm(corners[2] - corners[1] - up) > ROUND * max(size):
        return None
    u, v = across / size[0], up / size[1]
    return Rectangle(corners.mean(axis=0), np.stack([u, v, np.cross(u, v)]), np.array(size) / 2)


def _disk(corners: np.ndarray) -> Disk | None:
    if len(corners) < FEWEST_RIM_CORNERS:
        return None
    centre = corners.mean(axis=0)
    spokes = corners - centre
    lengths = np.linalg.norm(spokes, axis=1)
    if np.ptp(lengths) > ROUND * lengths.max():
        return None
    double_area = np.cross(spokes, np.roll(spokes, -1, axis=0)).sum(axis=0)
    size = np.linalg.norm(double_area)
    normal, u = double_area / size, spokes[0] / lengths[0]
    return Disk(centre, np.stack([u, np.cross(normal, u), normal]), float(np.sqrt(size / 2 / np.pi)))


def _sphere(positions: np.ndarray, triangles: np.ndarray) -> Sphere | None:
    # |p|² = 2·c·p + (r² − |c|²) for every vertex p, by least squares.
    middle = positions.mean(axis=0)
    local = positions - middle
    solution = np.linalg.lstsq(np.column_stack([2 * local, np.ones(len(local))]), np.sum(local**2, axis=1), rcond=None)
    centre = solution[0][:3]
    spokes = local - centre
    lengths = np.linalg.norm(spokes, axis=1)
    if np.ptp(lengths) > ROUND * lengths.max():
        return None
    a, b, c = (spokes[triangles[:, i]] for i in range(3))
    faces = np.cross(b - a, c - a)
    # The divergence theorem; a mesh that faces inwards has a negative volume.
    if np.sum(faces * a) / 6 < SMALLEST_SPHERE * 4 / 3 * np.pi * lengths.max() ** 3:
        return None
    area = np.linalg.norm(faces, axis=1).sum() / 2
    return Sphere(middle + centre, float(np.sqrt(area / (4 * np.pi))))
