"""What an argument stands for, and the values at which shading functions break.

A kind is told from the argument's name and from the range of its draw; `Argument.kind` overrides it.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ..twin import Argument, direction

BELOW_1, ABOVE_1 = (float(np.nextafter(np.float32(1), np.float32(x))) for x in (0, 2))
DENORMAL = 1e-40
ALPHAS = (1e-6, 1e-5, 1e-4, 1e-3, 0.045**2, 0.089**2, 0.01, 0.1, 0.5, 1.0)

EXTREMES = {
    "alpha": ALPHAS,
    "roughness": tuple(a**0.5 for a in ALPHAS),
    "cosine": (-1.0, -0.05, -1e-7, 0.0, DENORMAL, 1e-30, 1e-7, 1e-6, 1e-4, 1e-2, 0.5, BELOW_1, 1.0, ABOVE_1),
    "share": (-1e-7, 0.0, DENORMAL, 1e-7, 1e-4, 0.5, BELOW_1, 1.0, ABOVE_1),
    "colour": (0.0, DENORMAL, 1e-7, 0.04, 0.5, BELOW_1, 1.0, ABOVE_1, 2.0),
    "index": (0.5, BELOW_1, 1.0, ABOVE_1, 1.0001, 1.5, 4.0, 100.0),
    "intensity": (-1e-3, 0.0, DENORMAL, 1e-30, 1e-10, 1e-4, 1.0, 65504.0, 1e10, 1e30),
    "distance": (0.0, DENORMAL, 1e-6, 1e-3, 1.0, 1e3, 1e6),
    "number": (),
}
"""Values of each kind of scalar, and lengths of each kind of vector but directions. Those of a "number" are its own
declared ends: nothing is known of what lies beyond."""

UNIT_SLACK = 1e-6
"""How far from 1 a unit vector's length may be: a few roundings of float32."""

DRAWS = 1 << 15
"""From which a range is told: its ends are missed by about as small a part."""
SMALL = 5e-3
"""A share's or a reflectance's draw begins at 0, and its least value lies below this."""

COSINES = ("cosine", "_dot_", "cos_")
DISTANCES = ("depth_difference", "distance", "distance_to", "radius", "offset", "light_position", "point", "to_centre")
INTENSITIES = ("radiance", "linear", "scattered", "mirrored", "sky", "ground")


@dataclass(frozen=True)
class Domain:
    """What an argument is declared to be.

    Attributes:
        kind: of EXTREMES, "direction", or "fixed" (whole numbers, yes or no, matrices).
        low, high: ends of what its draw and its boundary give; for directions, of their length.
    """

    kind: str
    low: float
    high: float


@cache
def domain_of(argument: Argument) -> Domain:
    """The kind and the declared range."""
    assert argument.draw is not None
    if argument.draw is direction:
        return Domain(argument.kind or "direction", 1 - UNIT_SLACK, 1 + UNIT_SLACK)
    drawn = np.asarray(argument.draw(np.random.default_rng(0), DRAWS))
    within = np.concatenate([drawn.ravel(), *(np.ravel(value) for value in argument.boundary)])
    kind = argument.kind or _kind(argument, drawn)
    # A boundary may lie beyond a range, as 1.02 for a cosine, and is then no part of what is declared.
    bounds = (0.0, 1.0) if kind in ("share", "colour", "cosine") and drawn.min() >= 0 else (-np.inf, np.inf)
    return Domain(kind, max(float(within.min()), bounds[0]), min(float(within.max()), bounds[1]))


def _kind(argument: Argument, drawn: np.ndarray) -> str:
    name, low, high = argument.name, drawn.min(), drawn.max()
    if argument.type in ("int", "bool", "mat4") or (drawn == np.round(drawn)).all():
        return "fixed"
    if name == "alpha" or (name == "k" and high <= 1):
        return "alpha"
    if name in ("roughness", "spread_of_slopes", "sigma"):
        return "roughness"
    if name == "index":
        return "index"
    if name in INTENSITIES:
        return "intensity"
    if any(part in name for part in COSINES) and argument.type == "float":
        return "cosine"
    if name in DISTANCES:
        return "distance"
    if 0 <= low < SMALL and 0.9 < high <= 1:
        return "colour" if argument.type == "vec3" else "share"
    return "number"
