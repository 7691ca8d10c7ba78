"""Mirror lookup: the map itself along the mirror direction, whatever the roughness."""

from typing import Any

import numpy as np

from lightmeter.scenes.model import Light, Scene

from ...effect import Effect, Knobs
from ...environments.needed import same_everywhere


def uniforms(scene: Scene, _knobs: Knobs, _light: Light | None) -> dict[str, Any]:
    """The map's factor and rotation, and what the base gets."""
    assert scene.environment is not None, "the effect is left out of scenes without one"
    return {
        "environment_radiance": np.array(scene.environment.radiance),
        "environment_rotation": scene.environment.rotation,
        "mean_radiance": np.array(scene.environment.mean),
    }


EFFECT = Effect(
    name="mirror_lookup",
    terms=("environment",),
    summary="Every surface mirrors the map as if it were polished; the base gets the map's mean from everywhere.",
    citation="Blinn & Newell 1976, Texture and Reflection in Computer Generated Images; Karis 2014 (environment BRDF)",
    rank=4,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    unneeded=same_everywhere,
    uniforms=uniforms,
)
