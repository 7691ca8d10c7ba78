"""Hemisphere ambient light: one colour from the sky, one from the ground."""

from ...effect import Effect
from ...environments.needed import same_everywhere

EFFECT = Effect(
    name="hemisphere_ambient",
    terms=("environment",),
    summary="The environment's irradiance from above and from below, mixed by how far a direction points up; the "
    "specular lobe gets that of the mirror direction.",
    citation="Taylor 2003, Hemisphere Lighting with Radiosity Maps; Karis 2014, Physically "
    "Based Shading on Mobile (environment BRDF)",
    rank=3,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    unneeded=same_everywhere,
)
