"""Float64 twin of area_as_point.glsl."""

import numpy as np

from ...twin import Argument, Twin, uniform


def emitted(cos_light: np.ndarray, flat_light: np.ndarray, both_sides: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """The share of the intensity along the normal that leaves at an angle; nothing below the horizon."""
    c = np.where(both_sides > 0, np.abs(cos_light), cos_light)
    above = np.where(cosine > 0, np.maximum(c, 0.0), np.where(c > 0, 1.0, 0.0))
    return np.where(flat_light > 0, above, 1.0)


def flag(name: str) -> Argument:
    """True or false."""
    return Argument(name, "bool", lambda rng, n: rng.integers(0, 2, n).astype(np.float64))


TWINS = (
    Twin(
        "area_as_point.glsl",
        "emitted",
        "float",
        (
            Argument("cos_light", "float", uniform(-1, 1), (-1.0, -0.0, 0.0, 1.0)),
            flag("flat_light"),
            flag("both_sides"),
            flag("cosine"),
        ),
        emitted,
        roundings=0,
        why="nothing is computed, only chosen",
    ),
)
