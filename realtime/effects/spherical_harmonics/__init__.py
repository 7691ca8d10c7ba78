"""Spherical harmonics: the irradiance of the environment as a quadratic polynomial of the normal."""

import math

from ...effect import Effect, Knob, Knobs
from ...environments.needed import same_everywhere

COSINE = (1.0, 2.0 / 3.0, 1.0 / 4.0)
"""A_l/π of the clamped cosine (Ramamoorthi & Hanrahan 2001, eq. 8 and 9)."""


def band_weights(order: int, window: str) -> list[float]:
    """What each coefficient is multiplied with; Hann's window is (1 + cos(πl/order))/2 (Sloan 2008)."""
    weights = []
    for band in range(order):
        damped = 0.5 * (1 + math.cos(math.pi * band / order)) if window == "hann" else 1.0
        weights += [COSINE[band] * damped] * (2 * band + 1)
    return weights


def defines(knobs: Knobs) -> dict[str, object]:
    """How many coefficients there are."""
    return {"COEFFICIENTS": int(knobs["order"]) ** 2}


EFFECT = Effect(
    name="spherical_harmonics",
    terms=("environment",),
    summary="Irradiance from the environment's first spherical harmonics; the specular lobe gets that of the mirror "
    "direction, as if it were as wide as the base's.",
    citation="Ramamoorthi & Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps, eq. 3, 8, 9, "
    "13; Sloan 2008, Stupid Spherical Harmonics (SH) Tricks (windowing); Karis 2014 (environment BRDF)",
    knobs=(
        Knob("order", 3, "Bands: 2 has four coefficients a colour, 3 has nine.", choices=(2, 3), sweep=(2, 3)),
        Knob(
            "window",
            "none",
            "Hann's window damps the higher bands, so that a sun does not ring.",
            choices=("none", "hann"),
            sweep=("none", "hann"),
        ),
    ),
    rank=1,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    unneeded=same_everywhere,
    defines=defines,
)
