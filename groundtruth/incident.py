"""What a punctual light sends to points, in double precision: direction, irradiance across it, distance."""

import numpy as np

from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.model import DirectionalLight, PunctualLight, SpotLight
from lightmeter.scenes.optics import lights as optics


def incident(light: PunctualLight, point):
    """The light at points.

    Args:
        point: `mi.Vector3d`, world space.

    Returns:
        direction to the light (`Vector3d`, unit), irradiance across it (`Color3d`, W/m²), and the light's position
        (`Vector3d`), or None for a light at infinity.
    """
    if isinstance(light, DirectionalLight):
        direction = -np.asarray(light.direction, np.float64)
        towards, irradiance = _opaque(mi.Vector3d, direction / np.linalg.norm(direction)), light.irradiance
        return towards + 0 * point, _opaque(mi.Color3d, irradiance) + 0 * point.x, None
    position = _opaque(mi.Vector3d, light.position)
    towards, inverse_square = optics.from_position(position, point)
    strength = inverse_square
    if light.range is not None:
        strength = strength * optics.range_window(inverse_square, _opaque(mi.Float64, [light.range**2]))
    if isinstance(light, SpotLight):
        axis = np.asarray(light.direction, np.float64)
        axis = _opaque(mi.Vector3d, axis / np.linalg.norm(axis))
        inner, outer = _opaque(mi.Float64, [light.inner]), _opaque(mi.Float64, [light.outer])
        strength = strength * optics.spot_attenuation(-dr.dot(towards, axis), inner, outer)
    return towards, _opaque(mi.Color3d, light.intensity) * strength, position


def _opaque(kind, values):
    array = kind(*[float(v) for v in values])
    dr.make_opaque(array)
    return array
