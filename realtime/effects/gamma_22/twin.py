"""Float64 twin of gamma_22.glsl."""

import numpy as np

from ...effect import Knobs
from ...twin import Argument, Twin, logarithmic, uniform


def gamma_encode(linear: np.ndarray, exponent: float | np.ndarray) -> np.ndarray:
    """Code values 0…1 from display-linear light, clipped."""
    return np.clip(linear, 0.0, 1.0) ** (1.0 / exponent)


def encode(linear: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (…, 3) display-linear to code values."""
    return gamma_encode(linear, float(knobs["gamma"]))


TWINS = (
    Twin(
        "gamma_22.glsl",
        "gamma_encode",
        "vec3",
        (
            Argument("linear", "vec3", logarithmic(1e-4, 2.0, 3), ((0.0, -1.0, 1.0), (0.5, 1e30, 2.0))),
            Argument("exponent", "float", uniform(1.0, 4.0), (1.0, 2.2, 4.0)),
        ),
        gamma_encode,
        roundings=17 + 30 + 5 + 2.5,
        why="pow above 1e-4 by GLSL's specification (4.7.1, in ulp), exponent 1: log2 3 ulp of 13.3 (24 eps) times "
        "ln 2, exp2 3 + 2·13.3, the product between (8·ln 2/2…); 1/γ (2.5). llvmpipe (Mesa 22.3) errs by about 10",
    ),
)
