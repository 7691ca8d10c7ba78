"""A shape's place and a light's direction, from numbers in degrees."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # the library's Python scenes want `unit` alone, and the entries' models take a fifth of a second
    from lightmeter.scenes.toml.entries import Placed


def about(axis: tuple[float, float, float], degrees: float) -> np.ndarray:
    """(3, 3) rotation about `axis`, anticlockwise seen against it (Rodrigues)."""
    x, y, z = np.asarray(axis, dtype=np.float64) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)


def placement(entry: "Placed") -> np.ndarray:
    """(4, 4) local-to-world matrix: translation · rotation · scale, or the matrix that was given."""
    if entry.matrix is not None:
        return np.array(entry.matrix, dtype=np.float64)
    if entry.axis is not None:
        rotation = about(entry.axis, entry.angle)
    else:
        x, y, z = entry.rotate
        rotation = about((0, 0, 1), z) @ about((0, 1, 0), y) @ about((1, 0, 0), x)
    out = np.eye(4)
    out[:3, :3] = rotation * np.array(entry.scale)
    out[:3, 3] = entry.translate
    return out


def unit(vector: np.ndarray | tuple[float, ...]) -> tuple[float, float, float]:
    """`vector` at length 1."""
    x, y, z = np.asarray(vector, dtype=np.float64) / np.linalg.norm(vector)
    return float(x), float(y), float(z)
