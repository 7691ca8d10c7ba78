"""Constant ambient light: the environment, and what other surfaces scatter, as one colour from everywhere."""

from typing import Any

import numpy as np

from lightmeter.scenes.emitters import enclosure, flux, surface_area
from lightmeter.scenes.layers import COAT, SHEEN
from lightmeter.scenes.model import Light, Scene

from ...effect import Effect, Knob, Knobs


def uniforms(scene: Scene, knobs: Knobs, _light: Light | None) -> dict[str, Any]:
    """The environment's radiance, and the radiance that stands for light from other surfaces."""
    environment = scene.environment.mean if scene.environment else (0.0, 0.0, 0.0)
    total = sum((flux(scene, light) for light in scene.all_lights), np.zeros(3))
    mean_irradiance = total / max(surface_area(scene), 1e-300)
    return {
        "environment_radiance": np.array(environment),
        # What an enclosure sends back; in the open most of the flux never meets another surface.
        "indirect_radiance": float(knobs["indirect"]) * enclosure(scene) * mean_irradiance / np.pi,
    }


EFFECT = Effect(
    name="constant_ambient",
    terms=("environment", "indirect"),
    summary="The environment's radiance, and a share of the lights' flux, arrive alike from every direction.",
    citation="Phong 1975, Illumination for Computer Generated Pictures (ambient term); Cohen et al. 1988, "
    "A Progressive Refinement Approach to Fast Radiosity Image Generation, section 4 (ambient from flux over area); "
    "Karis 2014, Physically Based Shading on Mobile (environment BRDF)",
    knobs=(
        Knob(
            "indirect",
            0.5,
            "Irradiance from other surfaces: a share of the lights' flux over the scene's area, times how much the "
            "surfaces face each other (0 in the open, 1 inside a sphere).",
            low=0.0,
            high=10.0,
            sweep=(0.0, 0.25, 0.5, 1.0, 2.0),
        ),
    ),
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular", *COAT, *SHEEN),
    uniforms=uniforms,
)
