"""Radiant quantities as glTF writes them: a colour up to 1, and a strength."""

import math

from ..model import Vector


def color_and_strength(radiant: Vector) -> tuple[list[float], float]:
    """`radiant` as a colour of at most 1 a channel, times a strength of at least 1.

    The strength is a power of two, so that colour times strength is `radiant` to the last bit.
    """
    mantissa, exponent = math.frexp(max(radiant))
    strength = max(1.0, math.ldexp(1.0, exponent - (mantissa == 0.5)))
    return [channel / strength for channel in radiant], strength
