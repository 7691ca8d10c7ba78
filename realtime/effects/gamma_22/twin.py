"""Float64 twin of gamma_22.glsl."""

import numpy as np

from ...effect import Knobs


def gamma_encode(linear: np.ndarray, exponent: float | np.ndarray) -> np.ndarray:
    """Code values 0…1 from display-linear light, clipped."""
    return np.clip(linear, 0.0, 1.0) ** (1.0 / exponent)


def encode(linear: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (…, 3) display-linear to code values."""
    return gamma_encode(linear, float(knobs["gamma"]))
