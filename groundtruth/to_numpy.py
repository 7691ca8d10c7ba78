"""Dr.Jit's numbers in NumPy."""

import numpy as np


def rows(vector) -> np.ndarray:
    """(C, N): a Dr.Jit vector's components; those of one number hold for all lanes.

    Dr.Jit's own `vector.numpy()` interleaves them in a kernel that has N as a constant: other points, another kernel.
    """
    return np.stack(np.broadcast_arrays(*(component.numpy() for component in vector)))
