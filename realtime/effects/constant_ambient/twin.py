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


def specular_albedo(base_color, metallic, roughness, specular, n_dot_v) -> np.ndarray:
    """What the specular lobe returns of light from all over it, (3, n)."""
    material = point(base_color, metallic, roughness, specular)
    scale, bias = environment_brdf(roughness, n_dot_v)
    return material.f0 * scale + material.f90 * bias


def diffuse_albedo(base_color, metallic, roughness, specular, n_dot_v) -> np.ndarray:
    """What the base returns of light from everywhere, (3, n)."""
    scale, bias = environment_brdf(roughness, n_dot_v)
    return (1 - specular * (0.04 * scale + bias)) * point(base_color, metallic, roughness, specular).diffuse


def ambient_albedo(base_color, metallic, roughness, specular, n_dot_v) -> np.ndarray:
    """The share of light from everywhere that is reflected, (3, n)."""
    given = base_color, metallic, roughness, specular, n_dot_v
    return specular_albedo(*given) + diffuse_albedo(*given)


MATERIAL_AND_COSINE = (color("base_color"), unit("metallic"), unit("roughness"), unit("specular"), cosine("n_dot_v"))
"""What an albedo takes."""
BRDF_ROUNDINGS = 2 + 1 + 3 + 6 + 2 + 2
"""r (2), its square (1), the exponent and exp2 (3; llvmpipe: 4.4·2⁻²⁴), both on numbers up to 9.28·n·v (6), a004 (2),
the result (2)."""

TWINS = (
    Twin(
        "environment_brdf.glsl",
        "environment_brdf",
        "vec2",
        (unit("roughness"), cosine("n_dot_v")),
        environment_brdf,
        roundings=BRDF_ROUNDINGS,
        why="see BRDF_ROUNDINGS",
        cancels=1.04,
    ),
    Twin(
        "ambient_albedo.glsl",
        "specular_albedo",
        "vec3",
        MATERIAL_AND_COSINE,
        specular_albedo,
        roundings=5 + BRDF_ROUNDINGS + 3,
        why="F0 (5), scale and bias, two products and their sum",
        cancels=1.04,
    ),
    Twin(
        "ambient_albedo.glsl",
        "diffuse_albedo",
        "vec3",
        MATERIAL_AND_COSINE,
        diffuse_albedo,
        roundings=BRDF_ROUNDINGS + 3 + 2 + 2,
        why="scale and bias, above (3), c_diff (2), 1 − above and the product",
        cancels=1.04,
    ),
    Twin(
        "constant_ambient.glsl",
        "ambient_albedo",
        "vec3",
        MATERIAL_AND_COSINE,
        ambient_albedo,
        roundings=5 + BRDF_ROUNDINGS + 3 + 2 + 3,
        why="F0 (5), scale and bias, mirrored (3), c_diff (2), 1 − mirrored, the product and the sum",
        cancels=1.04,
    ),
)
