"""How GLSL's `texture` looks a picture up, in NumPy."""

import numpy as np


def bilinear(image: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A picture between its pixels' centres, and beyond its edge as at it.

    Args:
        image: (H, W, C).
        u, v: coordinates in 0…1 along a row and from row to row; of any shape.

    Returns:
        u's shape and C.
    """
    height, width = image.shape[:2]
    x, y = u * width - 0.5, v * height - 0.5
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - left)[..., None], (y - top)[..., None]

    def at(column: np.ndarray, row: np.ndarray) -> np.ndarray:
        return image[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]

    near = at(left, top) * (1 - fx) + at(left + 1, top) * fx
    far = at(left, top + 1) * (1 - fx) + at(left + 1, top + 1) * fx
    return near * (1 - fy) + far * fy


def centres(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """(rows, columns) coordinates u and v of a picture's pixels."""
    u, v = np.meshgrid((np.arange(columns) + 0.5) / columns, (np.arange(rows) + 0.5) / rows)
    return u, v
