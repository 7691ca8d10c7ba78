"""IEC 61966-2-1 (sRGB), both ways."""

from . import arrays as xp
from .arrays import Array


def srgb_decode(code: Array) -> Array:
    """Code values 0…1 to linear light (IEC 61966-2-1)."""
    curve = xp.power(xp.maximum((code + 0.055) * (1 / 1.055), 0.0), 2.4)
    return xp.where(code <= 0.04045, code * (1 / 12.92), curve)


def srgb_encode(linear: Array) -> Array:
    """Linear light 0…1 to code values (IEC 61966-2-1)."""
    curve = 1.055 * xp.power(xp.maximum(linear, 0.0), 1 / 2.4) - 0.055
    return xp.where(linear <= 0.0031308, linear * 12.92, curve)
