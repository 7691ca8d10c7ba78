"""Float64 twin of phong.glsl."""

from collections.abc import Callable

import numpy as np

from lightmeter.scenes.optics import microfacet

from ...effect import Knobs
from ...shared_twins import MATERIAL_AND_DIRECTIONS, REFLECTED, lit_signs, near_the_mirror, point
from ...twin import Argument, Twin, logarithmic
from . import EFFECT, defines


def lafortune(exponent: np.ndarray) -> np.ndarray:
    """(s + 2)/(2π) (Lafortune & Willems 1994, eq. 6)."""
    return (exponent + 2) / (2 * np.pi)


def unscaled(exponent: np.ndarray) -> np.ndarray:
    """1/π."""
    return 1 / np.pi + 0 * exponent


def model(knobs: Knobs) -> Callable[..., np.ndarray]:
    """The effect under those knobs: f·(n·l), (3, N) in 1/sr, of base_color, metallic, roughness, specular, n, v, l."""
    scale = {"energy": lafortune, "none": unscaled}[str(knobs["normalisation"])]

    def phong(base_color, metallic, roughness, specular, n, v, l):  # noqa: E741 (l: light)
        material = point(base_color, metallic, roughness, specular)
        n_dot_v, n_dot_l = np.sum(n * v, axis=0), np.sum(n * l, axis=0)
        exponent = 0.25 * microfacet.blinn_exponent(material.alpha)
        mirrored = 2 * n_dot_l * n - l
        sin2 = np.sum(np.cross(mirrored, v, axis=0) ** 2, axis=0)
        highlight = scale(exponent) * microfacet.cosine_power(np.sum(mirrored * v, axis=0), sin2, exponent)
        highlight = highlight * n_dot_l if knobs["cosine"] else highlight
        value = material.diffuse / np.pi * n_dot_l + material.f0 * highlight
        return np.where((n_dot_v > 0) & (n_dot_l > 0), value, 0.0)

    return phong


def signs(base_color, metallic, roughness, specular, n, v, l):  # noqa: E741
    """The cosines of light and viewer; and of the mirror direction, where a highlight of exponent 0 ends."""
    n_dot_l = np.sum(n * l, axis=0)
    mirrored = 2 * n_dot_l * n - l
    return [*lit_signs(n, v, l), (np.sum(mirrored * v, axis=0), 4 * np.sum(np.abs(n * v), axis=0) + 1)]


def twin_under(**given) -> Twin:
    """`phong` under those knobs."""
    knobs = EFFECT.settings(given)
    return Twin(
        "phong.glsl",
        "phong",
        "vec3",
        MATERIAL_AND_DIRECTIONS,
        model(knobs),
        roundings=3 + 3 + 2 + 2 * 3 + 3 + 8 + 7 + 6 + 3 + 4,
        why="n·l (3), the mirror direction (3), its cross product with v (2) and the square of it (3, counted twice), "
        "α and the exponent (3 + 2.5 twice), the series (7), exp (3 + its argument in the derivatives), the scale (4), "
        "F0 and the sum",
        arrange=near_the_mirror,
        signs=signs,
        defines=defines(knobs),
        brdf=REFLECTED,
    )


EXPONENT = Argument("exponent", "float", logarithmic(1e-3, 1e6), (0.0,))
TWINS = (
    Twin(
        "phong.glsl",
        "lafortune",
        "float",
        (EXPONENT,),
        lafortune,
        roundings=1 + 1 + 2.5,
        why="the sum, 2π, the division (2.5)",
        defines=defines(EFFECT.settings({})),
    ),
    Twin(
        "phong.glsl",
        "unscaled",
        "float",
        (EXPONENT,),
        unscaled,
        roundings=2.5,
        why="the division",
        defines=defines(EFFECT.settings({})),
    ),
    twin_under(),
    twin_under(normalisation="none", cosine=False),
)
