"""An emissive surface as a point light of the same power at its centre, cut off at its horizon."""

import math
from typing import Any

import numpy as np

from lightmeter.scenes.emitters import emitter
from lightmeter.scenes.model import AreaLight, Light, Scene

from ...effect import Effect, Knob, Knobs
from ...emissive import emissive


def uniforms(scene: Scene, knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """Where the point is, what it sends along its normal and how that falls off with the angle."""
    if not isinstance(light, AreaLight):
        raise TypeError("area_as_point takes emissive surfaces only")
    facts = emitter(scene, light)
    cosine = knobs["profile"] == "cosine" and facts.flat
    # Power Φ spread evenly over the solid angle that it leaves into, or Φ/π·cos θ: both hold Φ = ∫ I dω.
    solid_angle = (math.pi if cosine else 2 * math.pi) * (1 if facts.flat and not facts.double_sided else 2)
    return {
        "light_position": facts.centre,
        "light_normal": facts.normal if facts.flat else np.zeros(3),
        "light_intensity": facts.power / solid_angle,
        "two_sided": facts.double_sided,
        "cosine_profile": cosine,
    }


EFFECT = Effect(
    name="area_as_point",
    terms=("direct",),
    summary="An emissive surface is lit with as a point light of the same power at its centre, cut at its horizon.",
    citation="Shirley, Wang & Zimmerman 1996, Monte Carlo Techniques for Direct Lighting Calculations, section 3 "
    "(a luminaire far away is a point)",
    knobs=(
        Knob(
            "profile",
            "uniform",
            "How the power leaves: evenly over the hemisphere, or with the cosine that a flat luminaire really has.",
            choices=("uniform", "cosine"),
            sweep=("uniform", "cosine"),
        ),
    ),
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    lights=emissive,
    uniforms=uniforms,
)
