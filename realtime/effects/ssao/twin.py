"""Float64 twins of hemisphere.glsl's arithmetic; what it reads from the screen is tested on scenes."""

import numpy as np

from ...shared_twins import towards
from ...twin import Argument, Twin, logarithmic, uniform

DEFINES = {"SAMPLES": 1, "SCALE": 1}


def around_normal(place: np.ndarray, along: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """The place in an orthonormal frame (Gram & Schmidt)."""
    tangent = along - normal * np.sum(along * normal, axis=0)
    tangent = tangent / np.maximum(np.linalg.norm(tangent, axis=0), 1e-6)
    return place[0] * tangent + place[1] * np.cross(normal, tangent, axis=0) + place[2] * normal


def range_check(depth_difference: np.ndarray, reach: np.ndarray) -> np.ndarray:
    """A smooth step of the reach over the distance."""
    x = np.clip(reach / np.maximum(np.abs(depth_difference), 1e-9), 0, 1)
    return x**2 * (3 - 2 * x)


TWINS = (
    Twin(
        "hemisphere.glsl",
        "around_normal",
        "vec3",
        (
            Argument("place", "vec3", uniform(-1.0, 1.0, 3), ((0.0, 0.0, 1.0), (0.0, 0.0, 0.0))),
            towards("along"),
            towards("normal"),
        ),
        around_normal,
        roundings=3 + 2 + 3 + 2 + 1 + 2 + 3,
        why="a scalar product (3), its product and the difference; a square (3), inversesqrt (2) and the product; the "
        "cross product (2), three products and two sums (3)",
        cancels=1.0,
        guards=("1e-12",),
        defines=DEFINES,
    ),
    Twin(
        "hemisphere.glsl",
        "range_check",
        "float",
        (
            Argument("depth_difference", "float", uniform(-3.0, 3.0), (0.0,)),
            Argument("reach", "float", logarithmic(1e-2, 4.0)),
        ),
        range_check,
        roundings=2.5 + 4,
        why="the division (2.5), the square, 3 − 2x and two products",
        cancels=1.0,
        defines=DEFINES,
    ),
)
