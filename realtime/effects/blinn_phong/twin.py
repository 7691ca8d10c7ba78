"""Float64 twin of blinn_phong.glsl."""

from collections.abc import Callable

import numpy as np

from lightmeter.scenes.optics import microfacet

from ...effect import Knobs
from ...shared_twins import MATERIAL_AND_DIRECTIONS, REFLECTED, brdf_signs, near_the_mirror, point
from ...twin import Argument, Twin, logarithmic
from . import EFFECT, defines


def giesen(exponent: np.ndarray) -> np.ndarray:
    """(s + 2)(s + 4)/(8π(2^(−s/2) + s)) (Giesen 2009)."""
    return (exponent + 2) * (exponent + 4) / (8 * np.pi * (2 ** (-exponent / 2) + exponent))


def hoffman(exponent: np.ndarray) -> np.ndarray:
    """(s + 8)/(8π) (Akenine-Möller, Haines & Hoffman 2008, section 7.6)."""
    return (exponent + 8) / (8 * np.pi)


def unscaled(exponent: np.ndarray) -> np.ndarray:
    """1/π."""
    return 1 / np.pi + 0 * exponent


def model(knobs: Knobs) -> Callable[..., np.ndarray]:
    """The effect under those knobs: f·(n·l), (3, N) in 1/sr, of base_color, metallic, roughness, specular, n, v, l."""
    scale = {"exact": giesen, "usual": hoffman, "none": unscaled}[str(knobs["normalisation"])]

    def blinn_phong(base_color, metallic, roughness, specular, n, v, l):  # noqa: E741 (l: light)
        material = point(base_color, metallic, roughness, specular)
        n_dot_v, n_dot_l = np.sum(n * v, axis=0), np.sum(n * l, axis=0)
        exponent = microfacet.blinn_exponent(material.alpha)
        n_dot_h, sin2_h, _ = microfacet.half_cosines(n, v, l)
        highlight = scale(exponent) * microfacet.cosine_power(n_dot_h, sin2_h, exponent)
        highlight = highlight * n_dot_l if knobs["cosine"] else highlight
        value = material.diffuse / np.pi * n_dot_l + material.f0 * highlight
        return np.where((n_dot_v > 0) & (n_dot_l > 0), value, 0.0)

    return blinn_phong


def twin_under(**given) -> Twin:
    """`blinn_phong` under those knobs."""
    knobs = EFFECT.settings(given)
    return Twin(
        "blinn_phong.glsl",
        "blinn_phong",
        "vec3",
        MATERIAL_AND_DIRECTIONS,
        model(knobs),
        roundings=7 + 2 + 3 + 8 + 7 + 6 + 9 + 4,
        why="h (7), its cross product with n (2) and the square (3), α and the exponent (3 + 2.5 twice), the series "
        "(7), exp (3 + its argument in the derivatives), the scale (9), F0 and the sum",
        arrange=near_the_mirror,
        signs=brdf_signs,
        defines=defines(knobs),
        brdf=REFLECTED,
    )


EXPONENT = Argument("exponent", "float", logarithmic(1e-3, 1e6), (0.0, 1.0))
TWINS = (
    Twin(
        "blinn_phong.glsl",
        "giesen",
        "float",
        (EXPONENT,),
        giesen,
        roundings=3 + 1 + 3 + 1 + 1 + 2.5,
        why="two sums and their product; exp2 (3), the sum, 8π and its product, the division (2.5)",
        defines=defines(EFFECT.settings({})),
    ),
    Twin(
        "blinn_phong.glsl",
        "hoffman",
        "float",
        (EXPONENT,),
        hoffman,
        roundings=1 + 1 + 2.5,
        why="the sum, 8π, the division (2.5)",
        defines=defines(EFFECT.settings({})),
    ),
    Twin(
        "blinn_phong.glsl",
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
