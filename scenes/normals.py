"""Directions that a file gives, made unit vectors."""

import numpy as np

UNIT_ROUNDING = 2.0**-23
"""How far from 1 the length of a unit vector in float32 may lie: each component c is off by at most 2⁻²⁴·|c|, so the
length by Σ c²·2⁻²⁴ = 2⁻²⁴ and terms of second order."""


def unit_vectors(vectors: np.ndarray) -> np.ndarray:
    """(N, 3) float64: `vectors` (N, 3), none of them zero, at length 1.

    One that is a unit vector in float32 already stays as it is: rounding it twice could change its last bit, and a
    file would not give back what was written to it.
    """
    vectors = vectors.astype(np.float64)
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(np.abs(length - 1) <= UNIT_ROUNDING, vectors, vectors / length)


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
        normals[np.linalg.norm(normals, axis=1) == 0] = 0.0, 1.0, 0.0
    return unit_vectors(normals), int(lost.sum())
