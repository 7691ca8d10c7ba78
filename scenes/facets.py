"""The flat pieces of a mesh: neighbouring triangles in one plane, as the convex polygons that bound them."""

from itertools import pairwise

import numpy as np

from .model import Mesh

ROUNDINGS = 4 * 2.0**-23
"""How far positions may be off, as a share of the largest; short sides leave an angle less certain than long ones."""


def facets(mesh: Mesh) -> tuple[np.ndarray, ...]:
    """(n, 3) float64 corners of each flat piece, anticlockwise seen from its front; corners on straight edges go.

    A piece that is not convex, or has a hole, comes as its triangles. Triangles without area are left out.
    """
    positions, corners = np.unique(mesh.positions[mesh.triangles.ravel()], axis=0, return_inverse=True)
    positions, triangles = positions.astype(np.float64), corners.reshape(-1, 3)
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    there = areas > 0
    triangles, normals = triangles[there], normals[there] / areas[there, None]
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    step = ROUNDINGS * np.abs(positions).max(initial=0.0)
    longest = np.linalg.norm(positions[edges[:, 1]] - positions[edges[:, 0]], axis=1).reshape(-1, 3).max(axis=1)
    piece, outer = _pieces(edges, normals, step * longest / areas[there])
    order = np.argsort(piece[outer // 3], kind="stable")
    starts = np.searchsorted(piece[outer // 3][order], np.arange(piece.max(initial=-1) + 2))
    polygons: list[np.ndarray] = []
    for number, (start, end) in enumerate(pairwise(starts)):
        loop = _loop(edges[outer[order[start:end]]])
        polygon = None if loop is None else _corners(positions[loop], normals[outer[order[start]] // 3], step)
        polygons += [positions[corners] for corners in triangles[piece == number]] if polygon is None else [polygon]
    return tuple(polygons)


def is_closed(mesh: Mesh) -> bool:
    """Whether every edge is there both ways round: the mesh bounds a solid."""
    corners = np.unique(mesh.positions[mesh.triangles.ravel()], axis=0, return_inverse=True)[1]
    edges = corners.reshape(-1, 3)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    size = edges.max(initial=0) + 1
    return bool(len(edges)) and np.array_equal(np.sort(edges @ (size, 1)), np.sort(edges @ (1, size)))


def _pieces(edges: np.ndarray, normals: np.ndarray, tilts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The piece each triangle belongs to, and which edges (rows) have no neighbour in their own piece.

    Args:
        tilts: how far rounding may tilt each normal.
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    count = len(normals)
    if count == 0:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    code, reverse = edges @ (edges.max() + 1, 1), edges @ (1, edges.max() + 1)
    order = np.argsort(code, kind="stable")
    found = np.minimum(np.searchsorted(code[order], reverse), len(code) - 1)
    here, there = np.arange(len(edges)) // 3, order[found] // 3
    met = code[order[found]] == reverse
    level = met & (np.linalg.norm(normals[here] - normals[there], axis=1) < tilts[here] + tilts[there])
    graph = coo_matrix((np.ones(level.sum()), (here[level], there[level])), (count, count))
    piece = connected_components(graph, directed=False)[1]
    return piece, np.flatnonzero(~met | (piece[here] != piece[there]))


def _loop(border: np.ndarray) -> list[int] | None:
    """The corners of the one loop that these edges (n, 2) make; None where they make another figure."""
    after = dict(border.tolist())
    if len(after) < len(border):
        return None
    loop = [min(after)]
    while (following := after.get(loop[-1])) is not None and following != loop[0] and len(loop) < len(after):
        loop.append(following)
    return loop if len(loop) == len(after) and after.get(loop[-1]) == loop[0] else None


def _corners(loop: np.ndarray, normal: np.ndarray, step: float) -> np.ndarray | None:
    """A loop's corners without those on straight edges; None where one bends inwards."""
    before, after = loop - np.roll(loop, 1, axis=0), np.roll(loop, -1, axis=0) - loop
    turn = np.cross(before, after) @ normal
    straight = np.abs(turn) <= step * (np.linalg.norm(before, axis=1) + np.linalg.norm(after, axis=1))
    return None if np.any((turn < 0) & ~straight) else loop[~straight]
