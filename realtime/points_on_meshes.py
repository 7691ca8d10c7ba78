"""Points on triangles, evenly by area."""

import numpy as np

from lightmeter.scenes.model import Mesh


def points_on_mesh(mesh: Mesh, x: np.ndarray, y: np.ndarray):
    """Where numbers in 0…1 lie on a mesh: `x` says how far along its area, both where on the triangle.

    Args:
        mesh: in world space.
        x, y: (n,).

    Returns:
        (n,) triangles, two of the points' barycentric weights (n,) each, the mesh's area in m², and its triangles' unit
        normals (T, 3) float64.
    """
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    faces = np.cross(b - a, c - a)
    sizes = np.linalg.norm(faces, axis=1)
    ends = np.cumsum(sizes)
    triangle = np.minimum(np.searchsorted(ends, x * ends[-1], side="right"), len(ends) - 1)
    within = (x * ends[-1] - (ends - sizes)[triangle]) / np.maximum(sizes[triangle], 1e-300)
    root = np.sqrt(np.clip(within, 0, 1))
    normals = faces / np.maximum(sizes, 1e-300)[:, None]
    return triangle, root * (1 - y), root * y, float(ends[-1]) / 2, normals
