"""Triangles divided into smaller ones, so that there are vertices enough to bake into."""

import math

import numpy as np

from lightmeter.scenes.model import Mesh

from ...effect import EffectError
from ...geometry import vertex_arrays

MOST_TRIANGLES = 4_000_000


def baked_arrays(mesh: Mesh, spacing: float, texcoords: bool) -> tuple[dict[str, np.ndarray], np.ndarray | None]:
    """Attribute arrays (N, C) float32 and indices, as `vertex_arrays` has them, with vertices at most `spacing` apart.

    All triangles of a mesh are divided alike, so that their edges meet.

    Args:
        spacing: metres; 0 leaves the mesh as it is.

    Raises:
        EffectError: that would be too many triangles.
    """
    arrays, indices = vertex_arrays(mesh, tangents=False, texcoords=texcoords)
    parts = _parts(mesh, spacing)
    if parts == 1:
        return arrays, indices
    corners = np.arange(len(arrays["position"])) if indices is None else indices.ravel()
    weights, pieces = division(parts)
    divided = {
        name: np.einsum("kc,tcd->tkd", weights, array[corners].reshape(-1, 3, array.shape[1]))
        .reshape(-1, array.shape[1])
        .astype(np.float32)
        for name, array in arrays.items()
    }
    return divided, (pieces + len(weights) * np.arange(len(mesh.triangles))[:, None, None]).reshape(-1, 3)


def _parts(mesh: Mesh, spacing: float) -> int:
    """Into how many parts every edge is divided."""
    if spacing == 0:
        return 1
    corners = mesh.positions[mesh.triangles].astype(np.float64)
    longest = float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max())
    parts = max(1, math.ceil(longest / spacing - 1e-6))
    if len(mesh.triangles) * parts**2 > MOST_TRIANGLES:
        least = longest / math.floor(math.sqrt(MOST_TRIANGLES / len(mesh.triangles)))
        raise EffectError(
            f"baked_occlusion.spacing: {spacing:g} m makes {len(mesh.triangles) * parts**2:,} triangles of a shape, "
            f"expected {MOST_TRIANGLES:,} at most; take {least:.2g} m or more"
        )
    return parts


def division(parts: int) -> tuple[np.ndarray, np.ndarray]:
    """A triangle's equal parts: (n, 3) barycentric weights of their corners, and (parts², 3) indices into these."""
    row, column = np.array([(i, j) for i in range(parts + 1) for j in range(parts + 1 - i)]).T
    number = np.full((parts + 2, parts + 2), -1)
    number[row, column] = np.arange(len(row))
    here, below, right = number[row, column], number[row + 1, column], number[row, column + 1]
    upright = np.stack([here, below, right], axis=1)[row + column < parts]
    turned = np.stack([below, number[row + 1, column + 1], right], axis=1)[row + column < parts - 1]
    weights = np.stack([parts - row - column, row, column], axis=1) / parts
    return weights, np.concatenate([upright, turned])
