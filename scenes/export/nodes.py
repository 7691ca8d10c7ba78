"""Nodes: where shapes, lights and the camera stand (glTF 2.0, section 3.5; KHR_lights_punctual)."""

from typing import Any

import numpy as np

from ..framing import look_at
from ..model import IDENTITY, Camera, DirectionalLight, PunctualLight, SpotLight
from .radiant import color_and_strength

PUNCTUAL = "KHR_lights_punctual"


def node(name: str, matrix: np.ndarray, **content: Any) -> dict[str, Any]:
    """A node; glTF writes a matrix (4, 4) column by column, and the identity not at all."""
    columns = np.vstack([matrix[:3], (0, 0, 0, 1)]).T
    placed = {} if np.array_equal(columns, IDENTITY) else {"matrix": columns.ravel().tolist()}
    return {"name": name, **placed, **content}


def light(given: PunctualLight) -> tuple[dict[str, Any], np.ndarray]:
    """A light of KHR_lights_punctual, its strength in W/sr or W/m² as it is, and its node's matrix (4, 4)."""
    sun = isinstance(given, DirectionalLight)
    color, intensity = color_and_strength(given.irradiance if sun else given.intensity)
    content = {"name": given.name, "type": "point", "color": color, "intensity": intensity}
    matrix = np.eye(4)
    if isinstance(given, DirectionalLight | SpotLight):
        matrix = look_at((0.0, 0.0, 0.0), given.direction)
        content["type"] = "directional"
    if isinstance(given, SpotLight):
        content |= {"type": "spot", "spot": {"innerConeAngle": given.inner, "outerConeAngle": given.outer}}
    if not isinstance(given, DirectionalLight):
        matrix[:3, 3] = given.position
        content |= {} if given.range is None else {"range": given.range}
    return content, matrix


def camera(given: Camera, aspect: float) -> dict[str, Any]:
    """A camera (section 3.10); `aspect` is the image's width over its height."""
    distances = {"znear": given.near, "zfar": given.far}
    if given.yfov is not None:
        lens = {"aspectRatio": aspect, "yfov": given.yfov, **distances}
        return {"name": given.name, "type": "perspective", "perspective": lens}
    lens = {"xmag": given.ymag * aspect, "ymag": given.ymag, **distances}
    return {"name": given.name, "type": "orthographic", "orthographic": lens}
