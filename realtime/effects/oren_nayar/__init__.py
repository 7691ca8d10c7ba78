"""Oren-Nayar: rough matt surfaces, brighter towards the light than Lambert's."""

from ... import punctual
from ...effect import Effect, Knob, Knobs

FORMS = ("full", "qualitative", "fujii", "eon")


def defines(knobs: Knobs) -> dict[str, object]:
    """The GLSL function of the form."""
    return {"FORM": f"oren_nayar_{knobs['form']}"}


EFFECT = Effect(
    name="oren_nayar",
    terms=("direct",),
    summary="The whole base colour, a metal's too, scattered by grooves with matt sides; there is no highlight.",
    citation="Oren & Nayar 1994, Generalization of Lambert's Reflectance Model, eq. 30–32; Fujii 2012, A Tiny "
    "Improvement of Oren-Nayar Reflectance Model; Portsmouth, Kutz & Hill 2024, EON: A Practical Energy-Preserving "
    "Rough Diffuse BRDF",
    knobs=(
        Knob(
            "form",
            "eon",
            "The model of 1994 in full or in its short form without interreflections, Fujii's, or EON, which keeps the "
            "energy.",
            choices=FORMS,
            sweep=FORMS,
        ),
        Knob(
            "spread",
            1.0,
            "The spread of the grooves' angles (Fujii's and EON's roughness) for a material of roughness 1.",
            unit="rad",
            low=0.0,
            high=1.0,
            sweep=(0.0, 0.25, 0.5, 1.0),
        ),
    ),
    rank=1,
    channels=("position", "normal", "roughness", "base_color"),
    lights=punctual.punctual,
    uniforms=punctual.uniforms,
    defines=defines,
)
