"""Metals by their measured complex indices, as what a renderer in linear Rec. 709 makes of them.

A spectrum becomes RGB as a reflectance under D65 does: seen by the CIE 1931 2° observer, in the primaries of Rec. 709,
a perfect mirror being (1, 1, 1). Saturated metals lie a little outside of those primaries: gold's red is above 1.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from .fresnel import f_conductor


@dataclass(frozen=True)
class Metal:
    """Measured optical constants at room temperature.

    Attributes:
        source: who measured.
        wavelengths: nm, ascending, over the visible range.
        n, k: real part and extinction coefficient at those wavelengths.
    """

    source: str
    wavelengths: tuple[float, ...]
    n: tuple[float, ...]
    k: tuple[float, ...]


NOBLE = "Johnson & Christy 1972, Optical Constants of the Noble Metals"
TRANSITION = "Johnson & Christy 1974, Optical Constants of Transition Metals"
RAKIC = "Rakić 1995, Algorithm for the Determination of Intrinsic Optical Constants of Metal Films, table 2"
# fmt: off
PHOTONS_1972 = (
    354.2, 367.9, 381.5, 397.4, 413.3, 430.5, 450.9, 471.4, 495.9, 520.9, 548.6, 582.1, 616.8, 659.5, 704.5, 756.0,
    821.1,
)
PHOTONS_1974 = (354, 368, 381, 397, 413, 431, 451, 471, 496, 521, 549, 582, 617, 659, 704, 756, 821)

METALS = {
    "aluminium": Metal(
        RAKIC,
        (326.28, 364.66, 413.28, 442.80, 476.87, 516.60, 563.57, 619.93, 652.25, 688.81, 729.32, 774.91, 794.78),
        (.31474, .39877, .52135, .60790, .72780, .87340, 1.0728, 1.3660, 1.5724, 1.8301, 2.1606, 2.6154, 2.7675),
        (3.9165, 4.3957, 5.0008, 5.3676, 5.7781, 6.2418, 6.7839, 7.4052, 7.7354, 8.0601, 8.3565, 8.4914, 8.3866),
    ),
    "chromium": Metal(
        TRANSITION, PHOTONS_1974,
        (1.84, 1.87, 1.92, 2.00, 2.08, 2.19, 2.33, 2.51, 2.75, 2.94, 3.18, 3.22, 3.17, 3.09, 3.05, 3.08, 3.20),
        (2.64, 2.69, 2.74, 2.83, 2.93, 3.04, 3.14, 3.24, 3.30, 3.33, 3.33, 3.30, 3.30, 3.34, 3.39, 3.42, 3.48),
    ),
    "copper": Metal(
        NOBLE, PHOTONS_1972,
        (1.37, 1.36, 1.33, 1.32, 1.28, 1.25, 1.24, 1.25, 1.22, 1.18, 1.02, 0.70, 0.30, 0.22, 0.21, 0.24, 0.26),
        (1.916, 1.975, 2.045, 2.116, 2.207, 2.305, 2.397, 2.483, 2.564, 2.608, 2.577, 2.704, 3.205, 3.747, 4.205, 4.665,
         5.180),
    ),
    "gold": Metal(
        NOBLE, PHOTONS_1972,
        (1.50, 1.48, 1.46, 1.47, 1.46, 1.45, 1.38, 1.31, 1.04, 0.62, 0.43, 0.29, 0.21, 0.14, 0.13, 0.14, 0.16),
        (1.866, 1.895, 1.933, 1.952, 1.958, 1.948, 1.914, 1.849, 1.833, 2.081, 2.455, 2.863, 3.272, 3.697, 4.103, 4.542,
         5.083),
    ),
    "iron": Metal(
        TRANSITION, PHOTONS_1974,
        (1.93, 2.02, 2.12, 2.24, 2.35, 2.48, 2.59, 2.67, 2.74, 2.86, 2.95, 2.94, 2.88, 2.92, 2.86, 2.87, 2.94),
        (2.35, 2.43, 2.50, 2.58, 2.65, 2.71, 2.77, 2.82, 2.88, 2.91, 2.93, 2.99, 3.05, 3.10, 3.19, 3.28, 3.39),
    ),
    "silver": Metal(
        NOBLE, PHOTONS_1972,
        (0.10, 0.07, 0.05, 0.05, 0.05, 0.04, 0.04, 0.05, 0.05, 0.05, 0.06, 0.05, 0.06, 0.05, 0.04, 0.03, 0.04),
        (1.419, 1.657, 1.864, 2.070, 2.275, 2.462, 2.657, 2.869, 3.093, 3.324, 3.586, 3.858, 4.152, 4.483, 4.838, 5.242,
         5.727),
    ),
}
# fmt: on
WAVELENGTHS = np.arange(380.0, 781.0, 5.0)
"""nm, where spectra are summed."""


@cache
def rgb_weights() -> np.ndarray:
    """(3, 81): weights over `WAVELENGTHS` that turn a reflectance into linear Rec. 709; each row adds up to 1."""
    import colour

    shape = colour.SpectralShape(WAVELENGTHS[0], WAVELENGTHS[-1], WAVELENGTHS[1] - WAVELENGTHS[0])
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape).values
    light = colour.SDS_ILLUMINANTS["D65"].copy().align(shape).values
    weights = colour.RGB_COLOURSPACES["ITU-R BT.709"].matrix_XYZ_to_RGB @ (observer * light[:, None]).T
    return weights / weights.sum(axis=1, keepdims=True)


def index_at(metal: str, wavelengths: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """n and k at wavelengths in nm, linear between the measured ones.

    Raises:
        KeyError: where the metal is not among `METALS`.
    """
    data = METALS[metal]
    return np.interp(wavelengths, data.wavelengths, data.n), np.interp(wavelengths, data.wavelengths, data.k)


def rgb_reflectance(metal: str, cosine: np.ndarray) -> np.ndarray:
    """(3, …) linear Rec. 709: what a smooth metal reflects at those cosines (…), wavelength by wavelength.

    Raises:
        KeyError: where the metal is not among `METALS`.
    """
    cosine = np.asarray(cosine, np.float64)
    n, k = index_at(metal, WAVELENGTHS)
    return np.tensordot(rgb_weights(), f_conductor(cosine, *(a.reshape(-1, *[1] * cosine.ndim) for a in (n, k))), 1)


def rgb_index(metal: str) -> tuple[np.ndarray, np.ndarray]:
    """(3,) each: n and k turned to RGB as if they were reflectances, which is what renderers in RGB do.

    Raises:
        KeyError: where the metal is not among `METALS`.
    """
    n, k = index_at(metal, WAVELENGTHS)
    return rgb_weights() @ n, rgb_weights() @ k
