"""Float64 twin of constant_ambient.glsl."""

import numpy as np

from ...shared_twins import any_point, color, unit
from ...twin import Twin


def ambient_albedo(base_color: np.ndarray, metallic: np.ndarray, specular: np.ndarray) -> np.ndarray:
    """The share of light from everywhere that is reflected: the Lambert base under Fresnel at normal incidence."""
    point = any_point(base_color=base_color, metallic=metallic, specular=specular)
    return point.f0 + (1 - point.f0) * point.diffuse


TWINS = (
    Twin(
        "constant_ambient.glsl",
        "ambient_albedo",
        "vec3",
        (color("base_color"), unit("metallic"), unit("specular")),
        ambient_albedo,
        roundings=5 + 2 + 3,
        why="F0 (5), c_diff (2), 1 − F0, the product and the sum",
    ),
)
