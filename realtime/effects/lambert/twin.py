"""Float64 twin of lambert.glsl."""

from collections.abc import Callable

import numpy as np

from ...effect import Knobs
from ...shared_twins import color, towards
from ...twin import Brdf, Twin


def lambert(base_color: np.ndarray, n: np.ndarray, l: np.ndarray) -> np.ndarray:  # noqa: E741 (l: light)
    """f·(n·l), (3, N) in 1/sr."""
    return base_color / np.pi * np.maximum(np.sum(n * l, axis=0), 0.0)


def model(_knobs: Knobs) -> Callable[..., np.ndarray]:
    """The effect: f·(n·l), (3, N) in 1/sr, of base_color, metallic, roughness, specular, n, v, l."""
    return lambda base_color, _metallic, _roughness, _specular, n, _v, light: lambert(base_color, n, light)


TWINS = (
    Twin(
        "lambert.glsl",
        "lambert",
        "vec3",
        (color("base_color"), towards("n"), towards("l")),
        lambert,
        roundings=1 + 1 + 3 + 1,
        why="1/π and its product; the scalar product (3) and its own",
        brdf=Brdf(view=None),
    ),
)
