"""Float64 twin of hemisphere_ambient.glsl."""

import numpy as np

from ...shared_twins import color, towards
from ...twin import Argument, Twin, uniform, whole


def basis(index: np.ndarray, d: np.ndarray) -> np.ndarray:
    """The cosine above or below the horizon, over π."""
    return np.maximum(np.where(index == 0, d[1], -d[1]), 0) / np.pi


TWINS = (
    Twin(
        "basis.glsl",
        "basis",
        "float",
        (Argument("index", "int", whole(0, 1)), towards("d")),
        basis,
        roundings=2,
        why="1/π and the product",
    ),
    Twin(
        "hemisphere_ambient.glsl",
        "between",
        "vec3",
        (color("sky"), color("ground"), Argument("up", "float", uniform(-1.0, 1.0), (-1.0, 0.0, 1.0))),
        lambda sky, ground, up: ground + (sky - ground) * (0.5 + 0.5 * up),
        roundings=2 + 3,
        why="the weight (2); mix: 1 − t, a product and the sum",
        cancels=1.0,
    ),
)
