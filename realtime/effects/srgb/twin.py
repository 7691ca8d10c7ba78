"""Float64 twin of srgb.glsl."""

import numpy as np

from lightmeter.scenes.optics import color

from ...effect import Knobs


def srgb_encode(linear: np.ndarray) -> np.ndarray:
    """Code values 0…1 from display-linear light, clipped (IEC 61966-2-1)."""
    return color.srgb_encode(np.clip(linear, 0.0, 1.0))


def encode(linear: np.ndarray, _knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (…, 3) display-linear to code values."""
    return srgb_encode(linear)
