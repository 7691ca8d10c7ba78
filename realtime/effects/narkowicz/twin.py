"""Float64 twin of narkowicz.glsl."""

import numpy as np

from ...effect import Knobs
from ...twin import Argument, Twin, logarithmic, uniform


def narkowicz(radiance: np.ndarray, scale: float | np.ndarray) -> np.ndarray:
    """Display-linear 0…1 from scene-linear radiance, per channel (Narkowicz 2016)."""
    x = np.clip(radiance * scale, 0.0, 1e4)
    return np.clip((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0)


def tone(radiance: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (…, 3) scene-linear to display-linear."""
    return narkowicz(radiance, float(knobs["prescale"]))


TWINS = (
    Twin(
        "narkowicz.glsl",
        "narkowicz",
        "vec3",
        (
            Argument("radiance", "vec3", logarithmic(1e-6, 1e6, 3), ((0.0, -1.0, 1e30), (1.0, 1e4, 0.18))),
            Argument("scale", "float", uniform(0.1, 4.0), (0.0, 0.6, 1.0)),
        ),
        narkowicz,
        guards=("1e4",),
        roundings=1 + 4 + 4 + 2.5,
        why="the scale; numerator and denominator a constant, two products and a sum each; the division (2.5)",
    ),
)
