"""Punctual lights for effects that shade with them: which they are, and how punctual.glsl takes one."""

import math
from typing import Any

import numpy as np

from lightmeter.scenes.model import AreaLight, DirectionalLight, Light, Scene, SpotLight

from .effect import Knobs


def punctual(_scene: Scene, light: Light) -> bool:
    """Every light without an extent."""
    return not isinstance(light, AreaLight)


def uniforms(_scene: Scene, _knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """The light as punctual.glsl takes it; a directional one has no position (w = 0).

    Raises:
        TypeError: where the light has an extent, or there is none.
    """
    if isinstance(light, DirectionalLight):
        away = -np.array(light.direction)
        return {"light_position": np.append(away, 0.0), "light_power": np.array(light.irradiance)}
    if isinstance(light, AreaLight) or light is None:
        raise TypeError("punctual.glsl takes punctual lights only")
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
