"""Cook-Torrance for punctual lights: GGX, height-correlated Smith, Schlick and a Lambert base; every part a knob."""

from typing import Any

import numpy as np

from lightmeter.scenes.layers import COAT, GRAIN, SHEEN
from lightmeter.scenes.model import Light, Scene
from lightmeter.scenes.optics.conductors import METALS

from ... import punctual
from ...effect import Effect, Knob, Knobs

DISTRIBUTIONS = {"ggx": "d_ggx", "beckmann": "d_beckmann", "blinn": "d_blinn"}
MASKINGS = {
    "smith_correlated": "v_smith_ggx_correlated",
    "smith_separable": "v_smith_ggx_separable",
    "schlick_half": "v_schlick_half",
    "schlick_remapped": "v_schlick_remapped",
    "smith_fast": "v_smith_ggx_fast",
    "implicit": "v_implicit",
}
COMPENSATIONS = {"none": "uncompensated", "turquin": "turquin", "kulla_conty": "kulla_conty"}
BASE_COLOR = "base_color"


def measured_metal(knobs: Knobs) -> bool:
    """Whether the conductor's index is a metal's own."""
    return knobs["fresnel"] == "conductor" and knobs["metal"] != BASE_COLOR


def defines(knobs: Knobs) -> dict[str, object]:
    """The GLSL functions that stand for the parts; a grain stretches none but the material's own lobe."""
    return {
        "DISTRIBUTION": DISTRIBUTIONS[str(knobs["distribution"])],
        "MASKING": MASKINGS[str(knobs["masking"])],
        "FRESNEL": f"fresnel_{'metal' if measured_metal(knobs) else knobs['fresnel']}",
        "COMPENSATION": COMPENSATIONS[str(knobs["compensation"])],
        "TAKES_GRAIN": (knobs["distribution"], knobs["masking"]) == ("ggx", "smith_correlated"),
    }


def tables(knobs: Knobs) -> dict[str, np.ndarray]:
    """The albedo of single scattering, where something is to be compensated."""
    if knobs["compensation"] == "none":
        return {}
    from .albedo import albedo_table

    parts = DISTRIBUTIONS[str(knobs["distribution"])], MASKINGS[str(knobs["masking"])]
    return {"albedo_table": albedo_table(*parts)}


def uniforms(scene: Scene, knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """The light, and a measured metal's index."""
    values = punctual.uniforms(scene, knobs, light)
    if measured_metal(knobs):
        from lightmeter.scenes.optics.conductors import rgb_index

        n, k = rgb_index(str(knobs["metal"]))
        values |= {"metal_n": n, "metal_k": k}
    return values


EFFECT = Effect(
    name="cook_torrance",
    terms=("direct",),
    summary="GGX microfacets with height-correlated Smith and Schlick's Fresnel over a Lambert base.",
    citation="Cook & Torrance 1982, A Reflectance Model for Computer Graphics; Walter et al. 2007, eq. 33; "
    "Heitz 2014, eq. 99; Schlick 1994, eq. 15; glTF 2.0, Appendix B",
    knobs=(
        Knob(
            "distribution",
            "ggx",
            "Distribution of normals (Walter et al. 2007, eq. 33, 25, 30); Blinn's exponent is 2/α² − 2.",
            choices=tuple(DISTRIBUTIONS),
            sweep=tuple(DISTRIBUTIONS),
        ),
        Knob(
            "masking",
            "smith_correlated",
            "Masking and shadowing: GGX's Smith with correlated heights (Heitz 2014, eq. 99) or as a product (Walter "
            "et al. 2007, eq. 34); Schlick's with k = α/2 or (roughness + 1)²/8 (Karis 2013); without roots (Hammon "
            "2017, Filament's fast V); or G = n·v·n·l.",
            choices=tuple(MASKINGS),
            sweep=tuple(MASKINGS),
        ),
        Knob(
            "fresnel",
            "schlick",
            "Reflectance over the angle: Schlick's fit, exact for the real indices that the reflectances at normal "
            "incidence stand for, exact with a complex index for the metal, or the same at all angles.",
            choices=("schlick", "dielectric", "conductor", "none"),
            sweep=("schlick", "dielectric", "conductor", "none"),
        ),
        Knob(
            "metal",
            BASE_COLOR,
            "For fresnel=conductor: the complex index that the base colour stands for (Gulbrandsen 2014), or a metal's "
            "measured one, turned to RGB; a metal by name is that metal whatever the base colour.",
            choices=(BASE_COLOR, *METALS),
        ),
        Knob(
            "edge_tint",
            0.9,
            "For metal=base_color: which of the indices of that colour, from the largest n (0) to the smallest (1). "
            "Iron is near 0.6, silver near 1; 0.9 errs least on the worst of six metals.",
            low=0.0,
            high=1.0,
            sweep=(0.0, 0.25, 0.5, 0.75, 1.0),
        ),
        Knob(
            "compensation",
            "none",
            "What is lost between microfacets is given back: the lobe scaled (Turquin 2019, eq. 16), or a lobe added "
            "(Kulla & Conty 2017), by a table of the albedo of the distribution and masking chosen.",
            choices=tuple(COMPENSATIONS),
            sweep=tuple(COMPENSATIONS),
        ),
    ),
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular", *COAT, *GRAIN, *SHEEN),
    lights=punctual.punctual,
    uniforms=uniforms,
    defines=defines,
    tables=tables,
)
