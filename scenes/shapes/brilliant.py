"""A round brilliant, the usual cut of a diamond: 57 facets and a girdle."""

import numpy as np

from lightmeter.scenes.model import Mesh

CROWN, STAR, UPPER = np.radians((34.5, 21.0, 40.5))
PAVILION, LOWER = np.radians((40.75, 42.1))
"""Angles of the facets with the girdle's plane (Tolkowsky 1919, for mains and crown; halves and stars as usual)."""
TABLE = 0.53
"""The table's width, of the girdle's."""
GIRDLE = 0.03
"""Its height, of the diameter."""
SIDES = 32
"""Of the girdle."""


def brilliant(radius: float = 0.5) -> Mesh:
    """The stone with its table up (+Y), the middle of its girdle at the origin; flat facets, closed, facing outwards.

    Args:
        radius: of the girdle, metres.
    """
    from scipy.spatial import ConvexHull, HalfspaceIntersection

    planes = _planes()
    corners = HalfspaceIntersection(np.column_stack([planes[:, :3], -planes[:, 3]]), np.zeros(3)).intersections
    # Corners that several facets share are found several times.
    corners = np.unique(np.round(corners, 9), axis=0)
    hull = ConvexHull(corners)
    triangles = hull.simplices.copy()
    a, b, c = (corners[triangles[:, i]] for i in range(3))
    inwards = np.sum(np.cross(b - a, c - a) * hull.equations[:, :3], axis=1) < 0
    triangles[inwards] = triangles[inwards][:, ::-1]
    return Mesh((corners * radius).astype(np.float32), triangles.astype(np.uint32))


def _planes() -> np.ndarray:
    """(n, 4): outward unit normals, and distances from the middle of a girdle of radius 1."""
    rim = GIRDLE  # half its height, of a radius of 1
    eighths, sixteenths = np.arange(8) * np.pi / 4, (np.arange(16) + 0.5) * np.pi / 8
    top = rim + (1 - TABLE) * np.tan(CROWN)

    def facets(angles: np.ndarray, slope: float, through: tuple[float, float], up: bool, turn: float = 0.0):
        """Facets about the axis, each through a point (radius, height) of its own azimuth, turned by `turn`."""
        sign = 1.0 if up else -1.0
        across, along = np.sin(slope), np.full_like(angles, sign * np.cos(slope))
        normals = np.stack([across * np.cos(angles), along, across * np.sin(angles)], axis=1)
        point = through[0] * np.cos(turn) * np.sin(slope) + sign * through[1] * np.cos(slope)
        return np.column_stack([normals, np.full(len(angles), point)])

    table = np.array([[0.0, 1.0, 0.0, top]])
    between = eighths + np.pi / 8
    sides = np.arange(SIDES) * 2 * np.pi / SIDES
    walls = np.column_stack([np.cos(sides), 0 * sides, np.sin(sides), np.full(SIDES, np.cos(np.pi / SIDES))])
    return np.concatenate(
        [
            table,
            facets(eighths, CROWN, (1.0, rim), True),
            facets(between, STAR, (TABLE, top), True, np.pi / 8),
            facets(sixteenths, UPPER, (1.0, rim), True, np.pi / 16),
            walls,
            facets(sixteenths, LOWER, (1.0, -rim), False, np.pi / 16),
            facets(eighths, PAVILION, (1.0, -rim), False),
        ]
    )
