"""Float64 twins of the shaders that ambient visibility techniques share."""

import numpy as np

from ..shared_twins import alpha, color, cosine, towards, unit
from ..twin import Argument, Twin, logarithmic, uniform

DEFINES = {"SPECULAR_OCCLUSION": "specular_lagarde", "SCALE": 1}


def lagarde(visibility, n_dot_v, a, _bent) -> np.ndarray:
    """Lagarde & de Rousiers 2014, listing 26."""
    return np.clip(np.maximum(n_dot_v + visibility, 1e-6) ** (0.5 * 2.0 ** (-16 * a)) - 1 + visibility, 0, 1)


def cap_overlap(first, second, between) -> np.ndarray:
    """1 − cos of the smaller cap where it lies within the other, falling by a smooth step to 0 where both are apart."""
    difference = np.abs(first - second)
    apart = np.clip((between - difference) / np.maximum(first + second - difference, 1e-4), 0, 1)
    return (1 + apart**2 * (2 * apart - 3)) * (1 - np.cos(np.minimum(first, second)))


def cone(visibility, _n_dot_v, a, bent) -> np.ndarray:
    """The share of the lobe's cone that the visible one covers."""
    visible, lobe = np.arcsin(np.sqrt(np.clip(visibility, 0, 1))), np.arccos(10.0 ** -(a**2))
    shared = cap_overlap(visible, lobe, np.arccos(np.clip(bent, -1, 1)))
    return np.clip(shared / np.maximum(1 - 10.0 ** -(a**2), 1e-6), 0, 1)


def remaining(scattered, mirrored, of_scattered, of_mirrored) -> np.ndarray:
    """A mean of the two visibilities, weighted with the parts; of nothing, the first."""
    weights = scattered + 1e-5, mirrored
    return (weights[0] * of_scattered + weights[1] * of_mirrored) / (weights[0] + weights[1])


def surface_likeness(offset, normal, other, thickness) -> np.ndarray:
    """1 within the plane and for the same normal; 0 off it or for normals a right angle apart."""
    from_plane = np.abs(np.sum(offset * normal, axis=0))
    return np.maximum(1 - from_plane / thickness, 0) * np.maximum(np.sum(normal * other, axis=0), 0) ** 4


OCCLUSION = (unit("visibility"), cosine("n_dot_v"), alpha("alpha"))
BENT = Argument("bent_dot_mirrored", "float", uniform(-1.0, 1.0), (-1.0, 0.0, 1.0))

TWINS = (
    Twin(
        "specular_occlusion.glsl",
        "specular_as_diffuse",
        "float",
        (*OCCLUSION, BENT),
        lambda visibility, *_: visibility,
        roundings=0.5,
        why="nothing is computed",
    ),
    Twin(
        "specular_occlusion.glsl",
        "specular_unoccluded",
        "float",
        (*OCCLUSION, BENT),
        lambda visibility, *_: np.ones_like(visibility),
        roundings=0.5,
        why="nothing is computed",
    ),
    Twin(
        "specular_occlusion.glsl",
        "specular_lagarde",
        "float",
        (*OCCLUSION, BENT),
        lagarde,
        roundings=3 + 16 + 2 + 4,
        why="the exponent and exp2 (3; its argument is up to 17: 16), the sum, log and exp of pow (4), two sums",
        cancels=2.0,
        guards=("1e-6",),
    ),
    Twin(
        "specular_occlusion.glsl",
        "cap_overlap",
        "float",
        (
            Argument("first", "float", uniform(0.0, 1.5), (0.0,)),
            Argument("second", "float", uniform(0.0, 1.5), (0.0,)),
            Argument("between", "float", uniform(0.0, 3.14), (0.0,)),
        ),
        cap_overlap,
        roundings=3 + 2.5 + 2 + 4 + 5,
        why="two sums and a difference, the division (2.5), 1 − x; x²·(3 − 2x) (4); the squared sine (5)",
        cancels=2.0,
        guards=("1e-4",),
    ),
    Twin(
        "specular_occlusion.glsl",
        "one_minus_exp",
        "float",
        (Argument("x", "float", logarithmic(1e-12, 10.0), (0.0, 0.0999, 0.1001)),),
        lambda x: -np.expm1(-x),
        roundings=6 + 2,
        why="three products and differences, the last product; or exp (3) and a difference that takes a digit",
        cancels=0.1,
        guards=("0.1", "0.041666667"),
    ),
    Twin(
        "specular_occlusion.glsl",
        "angle_from_versine",
        "float",
        (Argument("x", "float", logarithmic(1e-12, 2.0), (0.0, 1.0, 2.0)),),
        lambda x: 2 * np.arctan2(np.sqrt(x), np.sqrt(2 - x)),
        roundings=4096 / 2 + 4,
        why="atan of two arguments may err by 4096 ulp (GLSL 4.60, 4.7.1), of two roots (4)",
    ),
    Twin(
        "specular_occlusion.glsl",
        "specular_cone",
        "float",
        (unit("visibility"), cosine("n_dot_v"), alpha("alpha"), BENT),
        cone,
        roundings=4096 + 64,
        why="atan may err by 4096 ulp (GLSL 4.60, 4.7.1); and a cap's area over another's",
        cancels=2.0,
        guards=("1e-6", "1.0"),
    ),
    Twin(
        "occluded_ambient.glsl",
        "remaining",
        "vec3",
        (color("scattered"), color("mirrored"), color("of_scattered"), unit("of_mirrored")),
        remaining,
        roundings=1 + 1 + 1 + 2.5,
        why="the first part, a product, the sum, the division (2.5)",
        defines=DEFINES,
        guards=("1e-5",),
    ),
    Twin(
        "surface_likeness.glsl",
        "surface_likeness",
        "float",
        (
            Argument("offset", "vec3", uniform(-0.1, 0.1, 3), ((0.0, 0.0, 0.0),)),
            towards("normal"),
            towards("other"),
            Argument("thickness", "float", logarithmic(0.01, 1.0)),
        ),
        surface_likeness,
        roundings=3 + 2.5 + 1 + 4 * 3 + 3,
        why="a scalar product (3), the division (2.5), 1 − x; a fourth power (12), three products",
        cancels=1.0,
    ),
)
