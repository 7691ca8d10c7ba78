"""How wide the blur is, in blocks."""

import math

from ...effect import Knobs


def blur_sigma(knobs: Knobs, height: int) -> float:
    """The Gaussian's standard deviation, for a picture of that many rows."""
    return float(knobs["sigma"]) * height / int(knobs["divisor"])


def blur_radius(sigma: float) -> int:
    """Where the sum ends: beyond three standard deviations lies 0.3 % of a Gaussian."""
    return max(1, math.ceil(3 * sigma))
