"""Float64 twin of minnaert.glsl."""

from collections.abc import Callable

import numpy as np

from ...effect import Knobs
from ...shared_twins import REFLECTED, above, color, towards
from ...twin import Argument, Twin, uniform


def minnaert(base_color: np.ndarray, k: np.ndarray, n: np.ndarray, v: np.ndarray, l: np.ndarray):  # noqa: E741
    """f·(n·l), (3, N) in 1/sr (Minnaert 1941)."""
    n_dot_v, n_dot_l = np.sum(n * v, axis=0), np.sum(n * l, axis=0)
    power = (np.maximum(n_dot_v, 1e-7) * np.maximum(n_dot_l, 1e-7)) ** (k - 1)
    return np.where((n_dot_v > 0) & (n_dot_l > 0), base_color / np.pi * power * n_dot_l, 0.0)


def model(knobs: Knobs) -> Callable[..., np.ndarray]:
    """The effect under those knobs: f·(n·l), (3, N) in 1/sr, of base_color, metallic, roughness, specular, n, v, l."""
    k = float(knobs["exponent"])
    return lambda base_color, _metallic, _roughness, _specular, n, v, light: minnaert(base_color, k, n, v, light)


TWINS = (
    Twin(
        "minnaert.glsl",
        "minnaert",
        "vec3",
        (
            color("base_color"),
            Argument("k", "float", uniform(0.0, 4.0), (0.0, 1.0, 4.0)),
            towards("n"),
            towards("v"),
            towards("l"),
        ),
        minnaert,
        roundings=1 + 2 + 3 + 1 + 3 * 24 + 3 + 2,
        why="1/π and two products; n·v, n·l (3) and theirs (1); pow is exp2(y·log2 x): log2 of a product of cosines is "
        "up to 46 in size, of 3 ulp each, exp2 3 ulp and the size of its argument in the derivatives; two products",
        arrange=above,
        brdf=REFLECTED,
    ),
)
