"""Float64 twin of hill.glsl."""

import numpy as np

from ...effect import Knobs
from ...twin import Argument, Twin, logarithmic, uniform

INTO = np.array([[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]])
BACK = np.array([[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]])


def hill(radiance: np.ndarray, scale: float | np.ndarray) -> np.ndarray:
    """Display-linear 0…1 from scene-linear radiance, (3, …) (Hill 2016)."""
    v = np.tensordot(INTO, np.clip(radiance * scale, 0.0, 1e6), axes=1)
    curve = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081)
    return np.clip(np.tensordot(BACK, curve, axes=1), 0.0, 1.0)


def tone(radiance: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (…, 3) scene-linear to display-linear."""
    return np.moveaxis(hill(np.moveaxis(radiance, -1, 0), float(knobs["prescale"])), 0, -1)


TWINS = (
    Twin(
        "hill.glsl",
        "hill",
        "vec3",
        (
            Argument("radiance", "vec3", logarithmic(1e-6, 1e6, 3), ((0.0, -1.0, 1e30), (1.0, 1e4, 0.18))),
            Argument("scale", "float", uniform(0.1, 4.0), (0.0, 1.0, 1.67)),
        ),
        hill,
        guards=("1e6",),
        cancels=0.000090537 / 0.238081,
        roundings=1 + 4 + 4 + 4 + 2.5 + 4,
        why="the scale; a matrix, products, sums and constants (4); numerator and denominator four each; the division "
        "(2.5); the other matrix (4)",
    ),
)
