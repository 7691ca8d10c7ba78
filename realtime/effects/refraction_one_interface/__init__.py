"""Refraction at a solid's front alone."""

from ...effect import Effect
from ...glass.around import AROUND_KNOBS, around_uniforms, nothing_around

EFFECT = Effect(
    name="refraction_one_interface",
    terms=("transmission",),
    summary="What is around along the mirrored direction, and along the one refracted at the front, as if the solid "
    "never ended.",
    citation="Lindholm et al. 2001, A User-Programmable Vertex Engine; Fresnel's equations in full",
    rank=2,
    channels=("position", "normal", "absorption", "ior"),
    unneeded=nothing_around,
    uniforms=around_uniforms,
    knobs=AROUND_KNOBS,
)
