"""Cook-Torrance: GGX, height-correlated Smith, Schlick and a Lambert base, for punctual lights."""

import math
from typing import Any

import numpy as np

from lightmeter.scenes.model import AreaLight, DirectionalLight, Light, Scene, SpotLight

from ...effect import Effect, Knobs


def punctual(_scene: Scene, light: Light) -> bool:
    """Every light without an extent."""
    return not isinstance(light, AreaLight)


def uniforms(_scene: Scene, _knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """The light as the shader takes it; a directional one has no position (w = 0)."""
    if isinstance(light, DirectionalLight):
        away = -np.array(light.direction)
        return {"light_position": np.append(away, 0.0), "light_power": np.array(light.irradiance)}
    if isinstance(light, AreaLight) or light is None:
        raise TypeError("cook_torrance takes punctual lights only")
    values = {
        "light_position": np.append(light.position, 1.0),
        "light_power": np.array(light.intensity),
        "inverse_range_square": 0.0 if light.range is None else 1 / light.range**2,
    }
    if isinstance(light, SpotLight):
        values |= {
            "spot_direction": np.array(light.direction),
            "spot_cosines": np.array([math.cos(light.inner), math.cos(light.outer)]),
        }
    else:
        # A cone that holds every direction: the ramp is 1 from cos = −1 on.
        values |= {"spot_direction": np.array([0.0, 0.0, 1.0]), "spot_cosines": np.array([-1.0, -2.0])}
    return values


EFFECT = Effect(
    name="cook_torrance",
    terms=("direct",),
    summary="GGX microfacets with height-correlated Smith and Schlick's Fresnel over a Lambert base.",
    citation="Cook & Torrance 1982, A Reflectance Model for Computer Graphics; Walter et al. 2007, eq. 33; "
    "Heitz 2014, eq. 99; Schlick 1994, eq. 15; glTF 2.0, Appendix B",
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    lights=punctual,
    uniforms=uniforms,
)
