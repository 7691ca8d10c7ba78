"""Float64 twin of constant_ambient.glsl."""

import numpy as np

from ...ambient.twin import BRDF_ROUNDINGS, environment_brdf, mirrored_share, scattered_share
from ...shared_twins import color, cosine, unit
from ...twin import Twin


def ambient_albedo(
    base_color: np.ndarray, metallic: np.ndarray, roughness: np.ndarray, specular: np.ndarray, n_dot_v: np.ndarray
) -> np.ndarray:
    """The share of light from everywhere that is reflected, (3, n)."""
    brdf = environment_brdf(roughness, n_dot_v)
    return mirrored_share(brdf, base_color, metallic, specular) + scattered_share(brdf, base_color, metallic, specular)


TWINS = (
    Twin(
        "constant_ambient.glsl",
        "ambient_albedo",
        "vec3",
        (color("base_color"), unit("metallic"), unit("roughness"), unit("specular"), cosine("n_dot_v")),
        ambient_albedo,
        roundings=5 + BRDF_ROUNDINGS + 3 + 2 + 3,
        why="F0 (5), scale and bias, mirrored (3), c_diff (2), 1 − mirrored, the product and the sum",
        cancels=1.04,
    ),
)
