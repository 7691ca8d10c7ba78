"""Float64 twin of the choice of a cascade."""

import numpy as np

from ...shadows.twin import DEFINES
from ...twin import Argument, Twin, uniform


def cascade_of(depth: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """How many ends a depth is beyond."""
    return np.sum(depth > ends, axis=0).astype(np.float64)


TWINS = (
    Twin(
        "cascaded_shadow_map.glsl",
        "cascade_of",
        "int",
        (
            Argument("depth", "float", uniform(0.0, 10.0), (1.0, 2.0)),
            Argument("ends", "vec4", uniform(0.0, 10.0, 4), ((1.0, 2.0, 1e30, 1e30), (0.5, 2.0, 3.0, 1e30))),
        ),
        cascade_of,
        roundings=0,
        why="comparisons of the inputs only",
        defines=DEFINES,
    ),
)
