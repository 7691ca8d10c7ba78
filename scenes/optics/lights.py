"""What punctual lights send to a point (KHR_lights_punctual, read as radiometric)."""

from . import arrays as xp
from .arrays import Array


def spot_attenuation(cos_angle: Array, inner: Array, outer: Array) -> Array:
    """The cone's falloff, 0…1: the square of a linear ramp in the cosine (KHR_lights_punctual, reference code).

    Args:
        cos_angle: cosine of the angle between the spot's direction and the direction to the point.
        inner, outer: half angles in radians.
    """
    cos_inner, cos_outer = xp.cos(inner), xp.cos(outer)
    ramp = xp.clip((cos_angle - cos_outer) * (1 / xp.maximum(cos_inner - cos_outer, 1e-3)), 0.0, 1.0)
    return ramp * ramp


def range_window(inverse_square: Array, range_square: Array) -> Array:
    """How a light with a range ends there, 0…1: 1 − (d/r)⁴, and 0 beyond (KHR_lights_punctual, recommended window).

    Args:
        inverse_square: 1/d², 1/m², as `from_position` gives it.
        range_square: r², m².
    """
    ratio = 1 / xp.maximum(inverse_square * range_square, 1e-18)
    return xp.maximum(1 - ratio * ratio, 0.0)


def from_position(light_position: Array, point: Array) -> tuple[Array, Array]:
    """Direction from the points to the light (unit) and 1/distance², 1/m²; both 0 at the light itself."""
    offset = light_position - point
    square = xp.dot(offset, offset)
    inverse_square = xp.where(square > 0, 1 / xp.maximum(square, 1e-38), 0 * square)
    return offset * xp.sqrt(inverse_square), inverse_square
