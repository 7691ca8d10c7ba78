"""Repairs normals that a file gives."""

import numpy as np


def repaired_normals(normals: np.ndarray, positions: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, int]:
    """Unit normals; where one has no length, the area-weighted mean of its triangles' takes its place.

    Args:
        normals: (N, 3), finite.
        positions: (N, 3), metres.
        triangles: (M, 3) indices.

    Returns:
        (N, 3) float64, and how many were replaced. A vertex whose triangles have no area gets +Y.
    """
    normals = normals.astype(np.float64)
    length = np.linalg.norm(normals, axis=1)
    lost = length < 1e-12
    if lost.any():
        a, b, c = (positions[triangles[:, i]].astype(np.float64) for i in range(3))
        across = np.cross(b - a, c - a)
        sums = np.zeros_like(normals)
        for corner in range(3):
            np.add.at(sums, triangles[:, corner], across)
        normals[lost] = sums[lost]
        length = np.linalg.norm(normals, axis=1)
        empty = length == 0
        normals[empty], length[empty] = (0.0, 1.0, 0.0), 1.0
    return normals / length[:, None], int(lost.sum())
