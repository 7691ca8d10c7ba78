"""The places in the hemisphere and the pattern that turns them."""

import numpy as np


def kernel(samples: int) -> np.ndarray:
    """(n, 3) places in the unit hemisphere around +z: random ones, nearer to the centre the earlier they come.

    As in de Vries 2015: directions from a cube, lengths even, times 0.1 + 0.9·(i/n)².
    """
    rng = np.random.default_rng(2007)
    places = rng.uniform((-1, -1, 0), (1, 1, 1), (samples, 3))
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    lengths = rng.uniform(0, 1, samples) * (0.1 + 0.9 * (np.arange(samples) / samples) ** 2)
    return places * lengths[:, None]


def rotations() -> np.ndarray:
    """(16, 2) directions in the plane of the screen, one for each pixel of a 4 × 4 pattern."""
    turns = np.random.default_rng(2011).permutation(16) / 16 * 2 * np.pi
    return np.stack([np.cos(turns), np.sin(turns)], axis=1)
