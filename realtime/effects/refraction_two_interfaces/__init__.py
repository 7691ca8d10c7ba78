"""Refraction at a solid's front and at its back."""

from ...effect import Effect
from ...glass.around import AROUND_KNOBS, around_uniforms, nothing_around

EFFECT = Effect(
    name="refraction_two_interfaces",
    terms=("transmission",),
    summary="The refracted ray goes on as far as the solid is thick along the view, and is refracted by the normal "
    "of the back that the screen has there; where it would be mirrored inside, it leaves along the back.",
    citation="Wyman 2005, An Approximate Image-Space Approach for Interactive Refraction",
    rank=1,
    channels=("position", "normal", "absorption", "ior"),
    unneeded=nothing_around,
    uniforms=around_uniforms,
    knobs=AROUND_KNOBS,
)
