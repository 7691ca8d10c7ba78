"""Float64 twins of cook_torrance's GLSL: the parts are those of `scenes/optics`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lightmeter.scenes.optics import anisotropy, fresnel, material, microfacet
from lightmeter.scenes.optics.conductors import rgb_index

from ...effect import Knobs
from ...shared_twins import (
    GRAIN_LOBE_ROUNDINGS,
    MASKING,
    MATERIAL_AND_DIRECTIONS,
    REFLECTED,
    across_normal,
    alpha,
    any_point,
    brdf_signs,
    color,
    cosine,
    near_the_mirror,
    point,
    towards,
    unit,
    unit_length,
)
from ...twin import Argument, Brdf, Twin, logarithmic, uniform
from . import DISTRIBUTIONS, EFFECT, MASKINGS, defines, measured_metal
from .albedo import albedo_table


def f0_of(base_color, metallic, specular):
    """Reflectance at normal incidence, (3, N)."""
    return any_point(base_color=base_color, metallic=metallic, specular=specular).f0


def fresnel_schlick(v_dot_h, base_color, metallic, specular):
    """Schlick's fit."""
    there = any_point(base_color=base_color, metallic=metallic, specular=specular)
    return microfacet.f_schlick(v_dot_h, there.f0, there.f90)


def mixed(metal: Callable[..., np.ndarray]) -> Callable[..., np.ndarray]:
    """A dielectric's exact reflectance mixed with a metal's, `metal` of the cosine and the base colour."""

    def reflectance(v_dot_h, base_color, metallic, specular):
        index = fresnel.index_of(material.DIELECTRIC_F0 * specular)
        dielectric = fresnel.f_dielectric(v_dot_h, index)
        return dielectric + (metal(v_dot_h, base_color) - dielectric) * metallic

    return reflectance


fresnel_dielectric = mixed(lambda cosine, color: fresnel.f_dielectric(cosine, fresnel.index_of(color)))
"""Exact for the real indices of both colours."""


def fresnel_conductor(tint: float) -> Callable[..., np.ndarray]:
    """Exact, for the metal's complex index of that edge tint."""
    return mixed(lambda cosine, color: fresnel.f_conductor(cosine, *fresnel.complex_index_of(color, tint)))


def fresnel_metal(n: np.ndarray, k: np.ndarray) -> Callable[..., np.ndarray]:
    """Exact, for a metal of that index, (3,) each."""
    return mixed(lambda cosine, color: fresnel.f_conductor(cosine, n[:, None], k[:, None]) + 0 * color)


def fresnel_none(_v_dot_h, base_color, metallic, specular):
    """F0 at all angles."""
    return f0_of(base_color, metallic, specular)


def turquin_scale(f0, albedo):
    """1 + F0·(1 − E)/E (Turquin 2019, eq. 16)."""
    return 1 + f0 * (1 - albedo) / albedo


def kulla_conty_lobe(f0, f90, albedo_v, albedo_l, albedo_mean):
    """f_ms (Kulla & Conty 2017; Hill 2018)."""
    f, lost = f0 + (f90 - f0) / 21, np.maximum(1 - albedo_mean, 1e-6)
    return f * f * albedo_mean / (1 - f * lost) * (1 - albedo_v) * (1 - albedo_l) / (np.pi * lost)


def looked_up(table: np.ndarray, cosine: np.ndarray, roughness: np.ndarray) -> np.ndarray:
    """(2, N): E(n·v) and its mean, as the texture unit interpolates the table."""
    x, y = np.sqrt(cosine) * (table.shape[1] - 1), roughness * (table.shape[0] - 1)
    left, top = (np.minimum(np.floor(c).astype(int), s - 2) for c, s in ((x, table.shape[1]), (y, table.shape[0])))
    along, down = (x - left)[:, None], (y - top)[:, None]
    upper = table[top, left] * (1 - along) + table[top, left + 1] * along
    lower = table[top + 1, left] * (1 - along) + table[top + 1, left + 1] * along
    return (upper * (1 - down) + lower * down)[:, :2].T


def compensated(knobs: Knobs) -> Callable[..., np.ndarray]:
    """The lobe with what it lost, of lobe, f0, f90, roughness, n·v and n·l."""
    kind = knobs["compensation"]
    if kind == "none":
        return lambda lobe, *_: lobe
    table = albedo_table(DISTRIBUTIONS[str(knobs["distribution"])], MASKINGS[str(knobs["masking"])])

    def lobe_of(lobe, f0, f90, roughness, n_dot_v, n_dot_l):
        toward_v, mean = looked_up(table, n_dot_v, roughness)
        if kind == "turquin":
            return lobe * turquin_scale(f0, toward_v)
        return lobe + kulla_conty_lobe(f0, f90, toward_v, looked_up(table, n_dot_l, roughness)[0], mean)

    return lobe_of


def fresnel_of(knobs: Knobs) -> Callable[..., np.ndarray]:
    """The reflectance that the knobs choose."""
    if measured_metal(knobs):
        return fresnel_metal(*rgb_index(str(knobs["metal"])))
    if knobs["fresnel"] == "conductor":
        return fresnel_conductor(float(knobs["edge_tint"]))
    return {"schlick": fresnel_schlick, "dielectric": fresnel_dielectric, "none": fresnel_none}[str(knobs["fresnel"])]


def model(knobs: Knobs) -> Callable[..., np.ndarray]:
    """The effect under those knobs: f·(n·l), (3, N) in 1/sr, of base_color, metallic, roughness, specular, n, v, l."""
    distribution = getattr(microfacet, DISTRIBUTIONS[str(knobs["distribution"])])
    masking = getattr(microfacet, MASKINGS[str(knobs["masking"])])
    reflectance, compensate = fresnel_of(knobs), compensated(knobs)

    def reflected(base_color, metallic, roughness, specular, n, v, l):  # noqa: E741 (l: light)
        there = point(base_color, metallic, roughness, specular)
        n_dot_v, n_dot_l = np.sum(n * v, axis=0), np.sum(n * l, axis=0)
        to_v, to_l = np.maximum(n_dot_v, 1e-7), np.maximum(n_dot_l, 1e-7)
        n_dot_h, sin2_h, v_dot_h = microfacet.half_cosines(n, v, l)
        f = reflectance(v_dot_h, base_color, metallic, specular)
        above = reflectance(v_dot_h, base_color, 0 * metallic, specular)
        lobe = f * distribution(n_dot_h, sin2_h, there.alpha) * masking(to_v, to_l, there.alpha)
        lobe = compensate(lobe, there.f0, there.f90, roughness, to_v, to_l)
        value = ((1 - above) * there.diffuse / np.pi + lobe) * n_dot_l
        return np.where((n_dot_v > 0) & (n_dot_l > 0), value, 0.0)

    return reflected


def brushed(base_color, metallic, roughness, specular, strength, grain, n, v, l):  # noqa: E741 (l: light)
    """The material with a grain, under the effect's own knobs."""
    there = replace(point(base_color, metallic, roughness, specular), grain=anisotropy.Grain(strength, grain))
    return material.evaluate(there, n, v, l)


def weighed(gloss, v_dot_h, base_color, metallic, _roughness, specular, _n_dot_v, n_dot_l):
    """A gloss over the base, under the effect's own knobs."""
    there = any_point(base_color=base_color, metallic=metallic, specular=specular)
    above = fresnel_schlick(v_dot_h, base_color, 0 * metallic, specular)
    lobe = fresnel_schlick(v_dot_h, base_color, metallic, specular) * gloss
    return ((1 - above) * there.diffuse / np.pi + lobe) * n_dot_l


def with_grain(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Directions as `near_the_mirror`, the grain across the normal."""
    *parameters, strength, grain, n, v, light = inputs
    *parameters, n, v, light = near_the_mirror(rng, [*parameters, n, v, light])
    return [*parameters, strength, across_normal(grain, n), n, v, light]


def whole(roundings: float, **given) -> Twin:
    """`reflected` under those knobs; `roundings` are what its parts differ by from the material's own."""
    knobs = EFFECT.settings(given)
    values = {"edge_tint": knobs["edge_tint"]}
    if measured_metal(knobs):
        values |= dict(zip(("metal_n", "metal_k"), rgb_index(str(knobs["metal"])), strict=True))
    return Twin(
        "cook_torrance.glsl",
        "reflected",
        "vec3",
        MATERIAL_AND_DIRECTIONS,
        model(knobs),
        roundings=1 + 3 + 3 + 2 + 3 + 16 + 12.5 + 7 + 5 + 6 + roundings,
        why="as gltf_brdf (shared_twins.py), and what the other parts take more",
        arrange=near_the_mirror,
        signs=brdf_signs,
        cancels=1.0 if knobs["fresnel"] in ("dielectric", "conductor") else 0.0,
        defines=defines(knobs),
        uniforms=values,
        brdf=REFLECTED,
    )


SIN2 = Argument("sin2_h", "float", logarithmic(1e-12, 1.0), (0.0, 1.0))
ANGLE = Argument("v_dot_h", "float", uniform(0.0, 1.0), (0.0, 1.0, 1.02, -0.05, 1e-3))
MATERIAL = (ANGLE, color("base_color"), unit("metallic"), unit("specular"))
F0 = Argument("f0", "vec3", uniform(0.0, 1.0, 3), ((0.0, 0.0, 0.0), (0.04, 0.02, 0.98)))
INDEX_ROUNDINGS = 3 + 2 + 2.5
"""√ (inversesqrt 2 and a product), 1 ± √f0, the division."""
DIELECTRIC_ROUNDINGS = 4 + 3 + 2 + 2.5 + 4 + 2.5 + 4
"""g (4 under the root, 3 for it), (g − c)/(g + c), the other ratio, the products."""
CONDUCTOR_ROUNDINGS = 5 + 4 + 3 + 1 + 1 + 2.5 + 3 + 2 * (4 + 2.5) + 2
"""The difference (5), the larger square (4 under the root, 3 for it, the sum), the smaller one (a product and a
division), a's root (3), each ratio (4 and a division), the products."""


def within_the_lobe(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """No further out than e⁻⁸⁰: beyond, float32 has nothing left of the exponential."""
    n_dot_h, sin2_h, a = unit_length(rng, inputs)
    tan2 = np.minimum(sin2_h / n_dot_h**2, 80 * a**2)
    return [1 / np.sqrt(1 + tan2), tan2 / (1 + tan2), a]


def masking(name: str, roundings: float, why: str, scale: str = "alpha") -> Twin:
    """The twin of a masking."""
    arguments = cosine("n_dot_v"), cosine("n_dot_l"), alpha(scale)
    return Twin("microfacets.glsl", name, "float", arguments, getattr(microfacet, name), roundings, why, brdf=MASKING)


TWINS = (
    Twin(
        "microfacets.glsl",
        "d_beckmann",
        "float",
        (cosine("n_dot_h"), SIN2, alpha("alpha")),
        microfacet.d_beckmann,
        roundings=3 + 1 + 1 + 2.5 + 3 + 4 + 2.5,
        why="α², cos², their product and the division, whose |x·∂f/∂x| is the exponent itself; exp (3), three products "
        "and the division",
        arrange=within_the_lobe,
        guards=("1e-14",),
    ),
    Twin(
        "microfacets.glsl",
        "d_blinn",
        "float",
        (cosine("n_dot_h"), SIN2, alpha("alpha")),
        microfacet.d_blinn,
        roundings=4.5 + 1 + 2 + 2.5 + 1 + 15,
        why="the exponent (4.5) and 2 more, 2π and the division, the power (15: cosine_power) and its product",
        arrange=unit_length,
        cancels=2.0,
    ),
    masking("v_smith_ggx_separable", 5 + 3 + 1 + 1 + 2.5, "as the correlated one, with a product of two sums"),
    masking("v_schlick", 1 + 2 + 1 + 1 + 2.5, "1 − k, its product and the sum, the product, the division", "k"),
    masking("v_schlick_half", 1 + 1 + 2 + 1 + 1 + 2.5, "α/2 is exact; as v_schlick, and one for a driver's order"),
    masking("v_schlick_remapped", 3 + 1 + 2 + 5 + 2.5, "√α (3), the sum, the square twice over; as v_schlick"),
    masking("v_smith_ggx_fast", 2 + 1 + 3 + 1 + 2.5, "two sums, mix (3), the division"),
    Twin(
        "microfacets.glsl",
        "v_implicit",
        "float",
        (cosine("n_dot_v"), cosine("n_dot_l"), alpha("alpha")),
        microfacet.v_implicit,
        roundings=0,
        why="nothing is computed",
        brdf=MASKING,
    ),
    Twin(
        "fresnel.glsl",
        "f_dielectric",
        "vec3",
        (ANGLE, Argument("index", "vec3", uniform(1.0, 4.0, 3), ((1.0, 1.5, 2.5), (100.0, 1.33, 1.0)))),
        fresnel.f_dielectric,
        roundings=DIELECTRIC_ROUNDINGS,
        why="see DIELECTRIC_ROUNDINGS",
        cancels=1.0,
    ),
    Twin(
        "fresnel.glsl",
        "f_conductor",
        "vec3",
        (
            ANGLE,
            Argument("n", "vec3", logarithmic(0.02, 10.0, 3), ((1.0, 0.05, 3.0),)),
            Argument("k", "vec3", logarithmic(0.02, 10.0, 3), ((0.0, 4.0, 8.0),)),
        ),
        fresnel.f_conductor,
        roundings=CONDUCTOR_ROUNDINGS,
        why="see CONDUCTOR_ROUNDINGS",
        cancels=1.0,
    ),
    Twin(
        "fresnel.glsl",
        "index_of",
        "vec3",
        (F0,),
        fresnel.index_of,
        roundings=INDEX_ROUNDINGS,
        why="see INDEX_ROUNDINGS",
        guards=("0.9999",),
    ),
    Twin(
        "fresnel.glsl",
        "complex_index_of",
        "vec3",
        (F0, unit("tint"), Argument("k", "vec3", out=True)),
        fresnel.complex_index_of,
        roundings=2 * INDEX_ROUNDINGS + 8 + 3,
        why="the two ends (INDEX_ROUNDINGS each), mix (3), the products and sums of k² and its division; the root",
        guards=("0.9999",),
    ),
    Twin(
        "fresnel.glsl",
        "fresnel_schlick",
        "vec3",
        MATERIAL,
        fresnel_schlick,
        roundings=7 + 5,
        why="f_schlick (7), F0 (5)",
    ),
    Twin(
        "fresnel.glsl",
        "fresnel_dielectric",
        "vec3",
        MATERIAL,
        fresnel_dielectric,
        roundings=2 + INDEX_ROUNDINGS + DIELECTRIC_ROUNDINGS + 3,
        why="F0 (2), its index, Fresnel's equations, mix (3)",
        cancels=1.0,
    ),
    Twin(
        "fresnel.glsl",
        "fresnel_conductor",
        "vec3",
        MATERIAL,
        fresnel_conductor(0.3),
        roundings=2 * INDEX_ROUNDINGS + 11 + CONDUCTOR_ROUNDINGS + 3,
        why="the complex index, Fresnel's equations, mix (3)",
        cancels=1.0,
        uniforms={"edge_tint": 0.3},
    ),
    Twin(
        "fresnel.glsl",
        "fresnel_metal",
        "vec3",
        MATERIAL,
        fresnel_metal(np.array([0.2, 0.9, 1.3]), np.array([3.4, 2.6, 1.9])),
        roundings=2 + INDEX_ROUNDINGS + DIELECTRIC_ROUNDINGS + CONDUCTOR_ROUNDINGS + 3,
        why="the dielectric's F0 (2) and index, Fresnel's equations twice, mix (3)",
        cancels=1.0,
        uniforms={"metal_n": (0.2, 0.9, 1.3), "metal_k": (3.4, 2.6, 1.9)},
    ),
    Twin(
        "fresnel.glsl",
        "fresnel_none",
        "vec3",
        MATERIAL,
        fresnel_none,
        roundings=5,
        why="F0 (5)",
    ),
    Twin(
        "compensation.glsl",
        "turquin_scale",
        "vec3",
        (color("f0"), Argument("albedo", "float", uniform(0.2, 1.0), (1.0,))),
        turquin_scale,
        roundings=1 + 1 + 2.5 + 1,
        why="1 − E, the product, the division, the sum",
    ),
    Twin(
        "compensation.glsl",
        "kulla_conty_lobe",
        "vec3",
        (
            color("f0"),
            color("f90"),
            *(Argument(f"albedo_{name}", "float", uniform(0.2, 1.0), (1.0,)) for name in ("v", "l")),
            Argument("albedo_mean", "float", uniform(0.4, 0.99), (0.999,)),
        ),
        kulla_conty_lobe,
        roundings=1 + 4 + 2 + 3 + 2.5 + 3 + 2.5 + 2,
        why="F̄ (1 + 3), squared, 1 − Ē, 1 − F̄(1 − Ē), the division; the others' products and division",
        cancels=1.0,
        guards=("1e-6",),
        brdf=Brdf("albedo_v", "albedo_l", normal=None, cosine=False, whole=False),
    ),
    Twin(
        "cook_torrance.glsl",
        "weighed",
        "vec3",
        (
            Argument("gloss", "float", logarithmic(1e-4, 1e4)),
            Argument("v_dot_h", "float", uniform(0.0, 1.0), (0.0, 1.0)),
            color("base_color"),
            *(unit(name) for name in ("metallic", "roughness", "specular")),
            *(Argument(name, "float", uniform(0.0, 1.0), (1e-7, 1.0)) for name in ("n_dot_v", "n_dot_l")),
        ),
        weighed,
        roundings=7 + 5 + 6,
        why="F (7) with F0 (5); 1 − F, c_diff, 1/π, its product with D·V, the sum, n·l",
        defines=defines(EFFECT.settings({})),
        brdf=Brdf("n_dot_v", "n_dot_l", normal=None, whole=False),
    ),
    Twin(
        "cook_torrance.glsl",
        "brushed",
        "vec3",
        (*MATERIAL_AND_DIRECTIONS[:4], unit("strength"), towards("grain"), *MATERIAL_AND_DIRECTIONS[4:]),
        brushed,
        roundings=GRAIN_LOBE_ROUNDINGS + 7 + 5 + 6,
        why="the lobe, F (7) with F0 (5), and in the sum six more, as gltf_brdf",
        arrange=with_grain,
        signs=lambda *inputs: brdf_signs(*inputs[:4], *inputs[6:]),
        defines=defines(EFFECT.settings({})) | {"LAYER_GRAIN": True},
        brdf=Brdf(grain="grain"),
    ),
    whole(0),
    whole(15, distribution="blinn", masking="implicit", fresnel="none"),
    whole(CONDUCTOR_ROUNDINGS + 30, masking="schlick_remapped", fresnel="conductor"),
)
