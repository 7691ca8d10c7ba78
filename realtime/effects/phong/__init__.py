"""Phong: a power of the cosine about the mirror direction over a Lambert base."""

from ... import punctual
from ...effect import Effect, Knob, Knobs

SCALES = {"energy": "lafortune", "none": "unscaled"}


def defines(knobs: Knobs) -> dict[str, object]:
    """The highlight's scale, and whether it takes the cosine."""
    return {"SCALE": SCALES[str(knobs["normalisation"])], "HIGHLIGHT_WITHOUT_COSINE": not knobs["cosine"]}


EFFECT = Effect(
    name="phong",
    terms=("direct",),
    summary="A power of the cosine about the mirror direction, coloured by F0 at all angles, over a Lambert base.",
    citation="Phong 1975, Illumination for Computer Generated Pictures; Lafortune & Willems 1994, Using the Modified "
    "Phong Reflectance Model for Physically Based Rendering (energy); exponent (2/α² − 2)/4: Blinn-Phong's of the same "
    "width (Fisher & Woo 1994, R·E versus N·H Specular Highlights)",
    knobs=(
        Knob(
            "normalisation",
            "energy",
            "The highlight's scale: so that it returns no more than it gets, (s + 2)/(2π), or 1/π whatever its width.",
            choices=tuple(SCALES),
            sweep=tuple(SCALES),
        ),
        Knob(
            "cosine",
            True,
            "Whether the highlight takes the cosine to the light, as a BRDF does; Phong's own of 1975 does not.",
            sweep=(True, False),
        ),
    ),
    rank=1,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    lights=punctual.punctual,
    uniforms=punctual.uniforms,
    defines=defines,
)
