"""`coverage`: the box filter over the pixel.

Its truth is no image of its own: the G-buffer is made again with sub-pixel offsets drawn at random, so that each
batch's mean is an unbiased estimate of the integral over the pixel. A fixed grid leaves a residue (0.47 % of the mean
at 4 × 4 in a prototype). One offset serves a whole G-buffer; pixels share it, batches do not.
"""

from typing import Literal

import numpy as np

TERM = "coverage"

_STREAM = 0xC0
_ROOT = (
    1.32471795724474602596  # of x³ = x + 1 (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences")
)


def evaluate(
    batches: int, samples: int, *, seed: int = 0, first: int = 0, pattern: Literal["independent", "r2"] = "r2"
) -> np.ndarray:
    """Sub-pixel offsets.

    Args:
        batches: K.
        samples: n, G-buffers per batch.
        first: number of the first batch; batch b gets the same offsets whatever `batches` and `first` are.
        pattern: "independent": uniform, each by itself; "r2": the R₂ sequence with a random shift per batch, whose
            points spread evenly. Each offset is uniform and batches are independent either way.

    Returns:
        (K, n, 2) float64 in [0, 1): x to the right and y down from the pixel's top left corner; 0.5 is its centre.
    """
    if batches < 1 or samples < 1:
        raise ValueError(f"expected at least one batch and one sample, got {batches} and {samples}")
    streams = [np.random.default_rng([seed & 0xFFFFFFFF, first + b, _STREAM]) for b in range(batches)]
    if pattern == "independent":
        return np.stack([stream.random((samples, 2)) for stream in streams])
    steps = np.arange(samples)[:, None] * np.array([1 / _ROOT, 1 / _ROOT**2])
    return np.stack([(stream.random(2) + steps) % 1 for stream in streams])
