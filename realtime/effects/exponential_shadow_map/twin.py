"""Float64 twins of the exponential shadow map's functions."""

import numpy as np

from ...shadows.twin import DEFINES as VIEWS
from ...shared_twins import stack, unit
from ...twin import Argument, Twin, logarithmic, uniform

EXPONENT = 40.0
DEFINES = VIEWS | {"EXPONENT": EXPONENT}


def kept(depth: np.ndarray, _slope: np.ndarray) -> np.ndarray:
    """The exponential that is stored."""
    return stack(np.exp(EXPONENT * (depth - 1)), 0, 0, 0)


def faded(mean: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """The mean over the point's own exponential, at most 1."""
    return np.minimum(mean * np.exp(EXPONENT * (1 - depth)), 1)


TWINS = (
    Twin(
        "kept.glsl",
        "kept",
        "vec4",
        (unit("depth"), Argument("slope", "vec2", uniform(-0.2, 0.2, 2))),
        kept,
        roundings=2 + 3 + 2 * EXPONENT,
        why="the difference and the product; exp (3 + 2|x|, GLSL's specification)",
        defines=DEFINES,
    ),
    Twin(
        "exponential_shadow_map.glsl",
        "faded",
        "float",
        (Argument("mean", "float", logarithmic(1e-17, 1.0)), unit("depth")),
        faded,
        roundings=2 + 3 + 2 * EXPONENT + 1,
        why="the difference and the product; exp (3 + 2|x|, GLSL's specification); the product",
        defines=DEFINES,
    ),
)
