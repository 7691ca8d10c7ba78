"""Float64 twin of constant_ambient.glsl."""

import numpy as np

from ...shared_twins import color, cosine, point, unit
from ...twin import Twin


def environment_brdf(roughness: np.ndarray, n_dot_v: np.ndarray) -> np.ndarray:
    """Scale and bias of F0 in GGX's directional albedo, (2, n) (Karis 2014)."""
    x, y = 1 - roughness, 0.0425 - 0.0275 * roughness
    z, w = 1.04 - 0.572 * roughness, 0.022 * roughness - 0.04
    a004 = np.minimum(x * x, 2.0 ** (-9.28 * n_dot_v)) * x + y
    return np.stack([z - 1.04 * a004, w + 1.04 * a004])


def ambient_albedo(
    base_color: np.ndarray, metallic: np.ndarray, roughness: np.ndarray, specular: np.ndarray, n_dot_v: np.ndarray
) -> np.ndarray:
    """The share of light from everywhere that is reflected, (3, n)."""
    material = point(base_color, metallic, roughness, specular)
    scale, bias = environment_brdf(roughness, n_dot_v)
    mirrored = material.f0 * scale + material.f90 * bias
    return mirrored + (1 - specular * (0.04 * scale + bias)) * material.diffuse


BRDF_ROUNDINGS = 2 + 1 + 3 + 6 + 2 + 2
"""r (2), its square (1), the exponent and exp2 (3; llvmpipe: 4.4·2⁻²⁴), both on numbers up to 9.28·n·v (6), a004 (2),
the result (2)."""

TWINS = (
    Twin(
        "constant_ambient.glsl",
        "environment_brdf",
        "vec2",
        (unit("roughness"), cosine("n_dot_v")),
        environment_brdf,
        roundings=BRDF_ROUNDINGS,
        why="see BRDF_ROUNDINGS",
        cancels=1.04,
    ),
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
