"""NumPy's numbers as Dr.Jit reads them."""

import numpy as np

ALIGNMENT = 64
"""Bytes: the longest vector of any processor, AVX-512's."""


def aligned(values) -> np.ndarray:
    """The values in float32, each row at an address that is a multiple of `ALIGNMENT`.

    Dr.Jit reads a float32 array of NumPy's in place, and its kernel says whether the address is one of a whole vector.
    NumPy gives small arrays any multiple of 16, so that a kernel would be compiled anew by chance.
    """
    values = np.atleast_1d(np.asarray(values, np.float32))
    step = ALIGNMENT // values.itemsize
    columns = -(-values.shape[-1] // step) * step
    rows = values.size // values.shape[-1]
    room = np.empty(rows * columns + step, np.float32)
    start = -room.ctypes.data % ALIGNMENT // values.itemsize
    found = room[start : start + rows * columns].reshape(*values.shape[:-1], columns)[..., : values.shape[-1]]
    found[...] = values
    return found
