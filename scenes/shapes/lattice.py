"""Rows and columns of vertices: the topology that every shape here is made of."""

import numpy as np

from lightmeter.scenes.model import Mesh


def lattice(columns: int, rows: int) -> tuple[np.ndarray, np.ndarray]:
    """Texture coordinates and triangles of a sheet of `columns` × `rows` cells.

    Returns:
        texcoords ((rows+1)·(columns+1), 2) float64, u to the right and v downwards, row by row; and triangles
        (2·rows·columns, 3) int64, anticlockwise where u points right and v down. The first half are the cells'
        lower left triangles (top left, bottom left, bottom right), the second their upper right ones, each
        row by row.
    """
    u, v = np.meshgrid(np.arange(columns + 1) / columns, np.arange(rows + 1) / rows)
    texcoords = np.stack([u.ravel(), v.ravel()], axis=1)
    index = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    top_left, top_right = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
    bottom_left, bottom_right = index[1:, :-1].ravel(), index[1:, 1:].ravel()
    lower = np.stack([top_left, bottom_left, bottom_right], axis=1)
    upper = np.stack([top_left, bottom_right, top_right], axis=1)
    return texcoords, np.concatenate([lower, upper])


def turn(steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Sine and cosine of a whole turn in `steps` steps, (steps+1,) each; the last equals the first bit by bit.

    So the two sides of a seam meet exactly.
    """
    angle = 2 * np.pi * (np.arange(steps + 1) % steps) / steps
    return np.sin(angle), np.cos(angle)


def joined(*meshes: Mesh) -> Mesh:
    """One mesh of several that all have normals and one set of texture coordinates."""
    starts = np.cumsum([0] + [len(mesh.positions) for mesh in meshes[:-1]])
    return Mesh(
        positions=np.concatenate([mesh.positions for mesh in meshes]),
        triangles=np.concatenate(
            [mesh.triangles + np.uint32(start) for mesh, start in zip(meshes, starts, strict=True)]
        ),
        normals=np.concatenate([mesh.normals for mesh in meshes if mesh.normals is not None]),
        texcoords=(np.concatenate([mesh.texcoords[0] for mesh in meshes]),),
    )
