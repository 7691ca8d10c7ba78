"""IEC 61966-2-1 (sRGB): the curve both ways, and how bright its primaries are."""

from . import arrays as xp
from .arrays import Array

LUMINANCE = (0.2126, 0.7152, 0.0722)
"""Of linear red, green and blue."""


def srgb_decode(code: Array) -> Array:
    """Code values 0…1 to linear light (IEC 61966-2-1)."""
    curve = xp.power(xp.maximum((code + 0.055) * (1 / 1.055), 0.0), 2.4)
    return xp.where(code <= 0.04045, code * (1 / 12.92), curve)


def srgb_encode(linear: Array) -> Array:
    """Linear light 0…1 to code values (IEC 61966-2-1)."""
    curve = 1.055 * xp.power(xp.maximum(linear, 0.0), 1 / 2.4) - 0.055
    return xp.where(linear <= 0.0031308, linear * 12.92, curve)
