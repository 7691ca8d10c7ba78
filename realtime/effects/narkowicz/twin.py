"""Float64 twin of narkowicz.glsl."""

import numpy as np

from ...effect import Knobs


def narkowicz(radiance: np.ndarray, scale: float | np.ndarray) -> np.ndarray:
    """Display-linear 0…1 from scene-linear radiance, per channel (Narkowicz 2016)."""
    x = np.clip(radiance * scale, 0.0, 1e4)
    return np.clip((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0)


def tone(radiance: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (…, 3) scene-linear to display-linear."""
    return narkowicz(radiance, float(knobs["prescale"]))
