"""Environment maps: which texel a direction looks at.

A unit direction (x, y, z) lies at u = 0.5 + atan2(z, x)/2π of the map's width, from the left, and at v = acos(y)/π of
its height, from the top: the middle column looks along +X, the column at three quarters along +Z, and the top row up.
A texel's value is that of its centre; between centres values are bilinear, around the seam too, and beyond the first
and last row constant. A map that is turned by θ about +Y shows at azimuth φ what it has at φ + θ, since azimuths grow
clockwise as seen from above.
"""

from collections.abc import Callable

import numpy as np

from ..model import Environment
from . import arrays as xp
from .arrays import Array
from .texture import CLAMP, REPEAT, TexelGrid


def coordinates(direction: Array, rotation: Array) -> tuple[Array, Array]:
    """u (any whole turn beside 0…1) and v (0…1) of unit directions, components first."""
    x, y, z = direction[0], direction[1], direction[2]
    # acos(y) would lose half its digits near the poles.
    polar = xp.arctan2(xp.sqrt(x * x + z * z), y)
    return 0.5 + (xp.arctan2(z, x) + rotation) * (0.5 / np.pi), polar * (1 / np.pi)


def direction_at(u: Array, v: Array, rotation: Array) -> tuple[Array, Array, Array]:
    """The unit direction (x, y, z) that lies at u, v: the inverse of `coordinates`."""
    sin_polar, cos_polar = xp.sincos(v * np.pi)
    sin_azimuth, cos_azimuth = xp.sincos((u - 0.5) * (2 * np.pi) - rotation)
    return sin_polar * cos_azimuth, cos_polar, sin_polar * sin_azimuth


def grid(width: float, height: float, real: Callable = float, whole: Callable = int) -> TexelGrid:
    """How a map of this size is looked up; `real` and `whole` make the numbers of whose arrays it is."""
    identity = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    return TexelGrid(
        real(width), real(height), whole(REPEAT), whole(CLAMP), whole(0), tuple(real(number) for number in identity)
    )


def radiance(environment: Environment, direction: np.ndarray) -> np.ndarray:
    """(3, N) float64, W/(sr·m²): what arrives from unit directions (3, N)."""
    factor = np.array(environment.radiance, np.float64)[:, None]
    if environment.map is None:
        return np.broadcast_to(factor, direction.shape).copy()
    texels = environment.map.texels
    height, width = texels.shape[:2]
    total = np.zeros(direction.shape)
    u, v = coordinates(direction, environment.rotation)
    for column, row, weight in grid(float(width), float(height)).taps(u, v):
        total += weight * texels[row.astype(np.int64), column.astype(np.int64)].T
    return total * factor
