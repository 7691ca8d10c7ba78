"""Polygons as triangles."""

import numpy as np


def fans(sizes: np.ndarray) -> np.ndarray:
    """(M, 3) int64: each polygon as a fan around its first corner.

    A fan is right for convex polygons; a concave one is covered wrongly.

    Args:
        sizes: (P,) corners of each polygon, at least 3, whose corners follow each other in one list.

    Returns:
        Indices into that list.
    """
    sizes = np.asarray(sizes, dtype=np.int64)
    starts = np.cumsum(sizes) - sizes
    counts = sizes - 2
    first = np.repeat(starts, counts)
    step = np.arange(len(first)) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.stack([first, first + step + 1, first + step + 2], axis=1)


def distinct(triangles: np.ndarray) -> np.ndarray:
    """The triangles (M, 3) whose corners are three different vertices."""
    a, b, c = triangles.T
    return triangles[(a != b) & (b != c) & (c != a)]
