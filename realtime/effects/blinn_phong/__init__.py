"""Blinn-Phong: a power of the half vector's cosine over a Lambert base."""

from ... import punctual
from ...effect import Effect, Knob, Knobs

SCALES = {"exact": "giesen", "usual": "hoffman", "none": "unscaled"}


def defines(knobs: Knobs) -> dict[str, object]:
    """The highlight's scale, and whether it takes the cosine."""
    return {"SCALE": SCALES[str(knobs["normalisation"])], "HIGHLIGHT_WITHOUT_COSINE": not knobs["cosine"]}


EFFECT = Effect(
    name="blinn_phong",
    terms=("direct",),
    summary="A power of the half vector's cosine, coloured by F0 at all angles, over a Lambert base.",
    citation="Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures; Giesen 2009, Phong and "
    "Blinn-Phong Normalization Factors (exact); Akenine-Möller, Haines & Hoffman 2008, Real-Time Rendering, section "
    "7.6 (usual); exponent 2/α² − 2 (Walter et al. 2007, section 5.2)",
    knobs=(
        Knob(
            "normalisation",
            "exact",
            "The highlight's scale: so that light from above is returned whole, (s + 2)(s + 4)/(8π(2^(−s/2) + s)); the "
            "usual short form (s + 8)/(8π); or 1/π whatever its width.",
            choices=tuple(SCALES),
            sweep=tuple(SCALES),
        ),
        Knob(
            "cosine",
            True,
            "Whether the highlight takes the cosine to the light, as a BRDF does; fixed-function pipelines' does not.",
            sweep=(True, False),
        ),
    ),
    rank=1,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    lights=punctual.punctual,
    uniforms=punctual.uniforms,
    defines=defines,
)
