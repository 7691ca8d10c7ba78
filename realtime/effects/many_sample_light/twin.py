"""Float64 twin of many_sample_light.glsl."""

import numpy as np

from ...shared_twins import towards
from ...twin import Argument, Twin, uniform


def received_from(offset: np.ndarray, normal: np.ndarray, both_sides: np.ndarray):
    """cos θ/d² and the direction to the light."""
    length = np.linalg.norm(offset, axis=0)
    direction = offset / np.where(length > 0, length, 1)
    cosine = -np.sum(direction * normal, axis=0)
    cosine = np.where(both_sides > 0, np.abs(cosine), np.maximum(cosine, 0))
    return np.where(length > 0, cosine / np.where(length > 0, length, 1) ** 2, 0), direction


TWINS = (
    Twin(
        "many_sample_light.glsl",
        "received_from",
        "float",
        (
            Argument("offset", "vec3", uniform(-3, 3, 3), ((0.0, 0.0, 2.0), (0.0, 0.0, 0.0))),
            towards("normal"),
            Argument("both_sides", "bool", lambda rng, n: rng.integers(0, 2, n).astype(np.float64)),
            Argument("direction", "vec3", out=True),
        ),
        received_from,
        roundings=3 + 2 + 1 + 3 + 2.5,
        why="a square (3), inversesqrt (2) and the product; a scalar product (3), the division (2.5)",
        defines={"SAMPLES": 1, "TILE": 1},
    ),
)
