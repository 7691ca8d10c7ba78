"""Tangents of a mesh that brings none.

After Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), section on tangent space, and his
`mikktspace.c`: each triangle's direction of growing u, projected into the plane of the vertex normal and
weighted by the triangle's angle there, averaged over the corners that agree in position, normal, texture
coordinate and handedness. Where corners of both handednesses share a vertex (a mirrored texture), the
vertex is doubled. What `mikktspace.c` does beyond that and this does not: it separates groups of triangles
that touch in a vertex alone.
"""

from dataclasses import replace

import numpy as np

from lightmeter.scenes.model import Mesh


def with_tangents(mesh: Mesh, texcoord: int = 0) -> Mesh:
    """`mesh` with tangents that follow a set of texture coordinates (untransformed).

    The tangent points along growing u, the bitangent `w · cross(normal, tangent)` along falling v, since a
    normal texture's green points up the image. Where a vertex has no gradient of u (no triangle, or only ones
    that are degenerate in space or in the image), the tangent is the first axis of Duff et al.'s frame around
    its normal ("Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017), with w = 1.

    Args:
        mesh: with normals, and the set of texture coordinates.
        texcoord: which set.

    Returns:
        The mesh with (N, 4) tangents; N grows by the vertices that are doubled at mirrored seams, the triangles
        stay in their order.

    Raises:
        ValueError: the mesh has no normals, or not that set.
    """
    if mesh.normals is None or texcoord >= len(mesh.texcoords):
        raise ValueError(f"tangents need normals and texture coordinates {texcoord}")
    mirrored = _mirrored(mesh, texcoord)
    mesh, mirrored_vertex = _split(mesh, mirrored)
    normals = np.asarray(mesh.normals, dtype=np.float64)
    sums = _corner_sums(mesh, texcoord, mirrored)
    shared = _same_surface(mesh, texcoord, mirrored_vertex)
    total = np.zeros((shared.max(initial=-1) + 1, 3))
    np.add.at(total, shared[mesh.triangles].ravel(), sums.reshape(-1, 3))
    directions = total[shared]
    directions -= normals * np.einsum("ij,ij->i", normals, directions)[:, None]
    length = np.linalg.norm(directions, axis=1)
    found = length > 1e-12
    directions[found] /= length[found, None]
    directions[~found] = duff_tangent(normals[~found])
    sign = np.where(mirrored_vertex & found, -1.0, 1.0)
    return replace(mesh, tangents=np.concatenate([directions, sign[:, None]], axis=1))


def duff_tangent(normals: np.ndarray) -> np.ndarray:
    """(N, 3) float64: the first axis of Duff et al.'s frame around each unit normal (N, 3)."""
    x, y, z = normals.astype(np.float64).T
    sign = np.where(z >= 0, 1.0, -1.0)
    a = -1 / (sign + z)
    return np.stack([1 + sign * x * x * a, sign * x * y * a, -sign * x], axis=1)


def unwelded(mesh: Mesh) -> Mesh:
    """`mesh` with three vertices of its own for each triangle, and the triangle's normal at each of them."""
    corners = mesh.triangles.ravel()
    positions = mesh.positions[corners]
    a, b, c = np.moveaxis(positions.astype(np.float64).reshape(-1, 3, 3), 1, 0)
    across = np.cross(b - a, c - a)
    length = np.linalg.norm(across, axis=1, keepdims=True)
    faces = np.where(length > 0, across / np.where(length > 0, length, 1), (0.0, 0.0, 1.0))
    return Mesh(
        positions=positions,
        triangles=np.arange(len(corners)).reshape(-1, 3),
        normals=np.repeat(faces, 3, axis=0),
        texcoords=tuple(uv[corners] for uv in mesh.texcoords),
        colors=None if mesh.colors is None else mesh.colors[corners],
    )


def _steps(values: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """From each triangle's first corner to its second, and to its third."""
    a, b, c = (values[triangles[:, i]].astype(np.float64) for i in range(3))
    return b - a, c - a


def _mirrored(mesh: Mesh, texcoord: int) -> np.ndarray:
    """(M,) bool: triangles whose image is mirrored, seen from the front (v points down)."""
    first, second = _steps(mesh.texcoords[texcoord], mesh.triangles)
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] > 0


def _split(mesh: Mesh, mirrored: np.ndarray) -> tuple[Mesh, np.ndarray]:
    """Doubles the vertices that mirrored and unmirrored triangles share; (N,) bool says which are mirrored."""
    count = len(mesh.positions)
    in_mirrored, in_plain = np.zeros(count, bool), np.zeros(count, bool)
    in_mirrored[mesh.triangles[mirrored]] = True
    in_plain[mesh.triangles[~mirrored]] = True
    both = np.flatnonzero(in_mirrored & in_plain)
    if not len(both):
        return mesh, in_mirrored
    twin = np.arange(count)
    twin[both] = count + np.arange(len(both))
    triangles = mesh.triangles.astype(np.int64)
    triangles[mirrored] = twin[triangles[mirrored]]
    rows = np.concatenate([np.arange(count), both])
    split = Mesh(
        positions=mesh.positions[rows],
        triangles=triangles,
        normals=None if mesh.normals is None else mesh.normals[rows],
        texcoords=tuple(uv[rows] for uv in mesh.texcoords),
        colors=None if mesh.colors is None else mesh.colors[rows],
    )
    in_mirrored[both] = False
    return split, np.concatenate([in_mirrored, np.ones(len(both), bool)])


def _corner_sums(mesh: Mesh, texcoord: int, mirrored: np.ndarray) -> np.ndarray:
    """(M, 3, 3): what each corner adds to its vertex: the unit direction of growing u, times the angle."""
    e1, e2 = _steps(mesh.positions, mesh.triangles)
    t1, t2 = _steps(mesh.texcoords[texcoord], mesh.triangles)
    growing_u = e1 * t2[:, 1:] - e2 * t1[:, 1:]
    growing_u *= np.where(mirrored, 1.0, -1.0)[:, None]  # the sign of the image's area
    flat = t1[:, 0] * t2[:, 1] == t1[:, 1] * t2[:, 0]
    growing_u[flat] = 0
    normals = np.asarray(mesh.normals, dtype=np.float64)[mesh.triangles]
    directions = _unit(_in_plane(growing_u[:, None, :], normals))
    corners = mesh.positions.astype(np.float64)[mesh.triangles]
    ahead = _unit(_in_plane(np.roll(corners, -1, axis=1) - corners, normals))
    behind = _unit(_in_plane(np.roll(corners, 1, axis=1) - corners, normals))
    angles = np.arccos(np.clip(np.einsum("mki,mki->mk", ahead, behind), -1, 1))
    return directions * angles[:, :, None]


def _in_plane(vectors: np.ndarray, normals: np.ndarray) -> np.ndarray:
    return vectors - normals * np.sum(vectors * normals, axis=-1, keepdims=True)


def _unit(vectors: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


def _same_surface(mesh: Mesh, texcoord: int, mirrored_vertex: np.ndarray) -> np.ndarray:
    """(N,) int64: vertices with equal position, normal, texture coordinate and handedness get equal numbers."""
    key = np.concatenate(
        [mesh.positions, np.asarray(mesh.normals), mesh.texcoords[texcoord], mirrored_vertex[:, None]],
        axis=1,
        dtype=np.float32,
    )
    rows = np.ascontiguousarray(key + 0.0).view(np.dtype((np.void, key.shape[1] * 4))).ravel()  # −0 is 0
    return np.unique(rows, return_inverse=True)[1].reshape(-1)
