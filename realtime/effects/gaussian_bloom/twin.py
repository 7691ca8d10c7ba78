"""Twin of the passes."""

import numpy as np

from ...effect import Knobs
from ...pictures.blocks import bright_blocks, with_blocks
from .blur import blur_radius, blur_sigma


def glare(image: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (H, W, 3) scene-linear, without glare to with it."""
    from scipy.ndimage import correlate1d

    divisor, sigma = int(knobs["divisor"]), blur_sigma(knobs, image.shape[0])
    device_rows = image[::-1]
    offsets = np.arange(-blur_radius(sigma), blur_radius(sigma) + 1)
    weights = np.exp(-0.5 * (offsets / sigma) ** 2)
    blocks = bright_blocks(device_rows, float(knobs["threshold"]), divisor)
    for axis in (1, 0):
        blocks = correlate1d(blocks, weights / weights.sum(), axis=axis, mode="constant")
    return with_blocks(device_rows, blocks, float(knobs["strength"]), divisor)[::-1]


TWINS = ()
