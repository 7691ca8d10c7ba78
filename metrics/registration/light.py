"""Transfer and exposure: which curve and which factor lie between an image and the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .agreement import Agreement, Truth
from .curves import SRGB, Curve
from .fault import Fault

LEAST_STOPS = 0.1
"""The logarithm of the smallest factor that is named: ambient light that is a little off moves levels by less."""
_TOGETHER = 0.15  # by which surfaces may differ from the background's factor, in the logarithm
_UNSURE = 0.4  # of a factor, in the logarithm: how far levels may differ from it, and contrasts from levels, together
_SUPPORT = 0.2  # share of levels × share of contrasts that must speak for a curve or a factor,
_LEAD = 2.0  # and how many times that of what was promised
_HALF = 0.5  # of the levels must agree once a curve is undone
_POWERS = ((1 / 2.6, 1 / 1.8), (1.8, 2.6))  # exponents of displays: other power laws are no transfer curve
_NEARLY_ALL, _FLATTER, _NEARER = 0.9, 0.4, (0.5, 0.7)
# Share of levels that are too bright; by how much contrasts are raised less than levels, in the logarithm; what undoing
# must leave of the distance of levels and of contrasts from the truth.
_FINER = 0.05  # by which a power law must fit better than the sRGB curve to be called one


@dataclass(frozen=True)
class Light:
    """What was done to an image's values.

    Attributes:
        curve: the transfer curve that was put on once too often, or None.
        factor: the exposure, 1 where there is none to be named.
    """

    curve: Curve | None = None
    factor: float = 1.0

    def undo(self, image: np.ndarray) -> np.ndarray:
        """The image without them."""
        straight = image if self.curve is None else self.curve.undo(image)
        return straight / self.factor


def find_light(tested: np.ndarray, truth: Truth, backdrop: float | None = None) -> Light:
    """The curve and the factor under which levels and contrasts agree with the truth's, if they clearly do.

    Args:
        tested: (H, W, 3) as promised linear, finite, not negative.
        backdrop: the factor that the background has for sure, as nothing shades it; None: unknown.
    """
    best, curve = truth.agreement(tested), None
    support = _own_support(best)
    if _LEAD * support < 1:
        found = _straightest(tested, truth)
        if found is not None and _own_support(found[1]) >= max(_SUPPORT, _LEAD * support):
            curve, best = found
        elif _washed_out(best, truth.agreement(SRGB[0].undo(tested))):
            return Light(SRGB[0])
    return Light(curve, _factor(best, backdrop))


def _straightest(tested: np.ndarray, truth: Truth) -> tuple[Curve, Agreement] | None:
    """The curve whose undoing makes levels agree best, and what it makes of the image; None where less than half do."""
    curves = list(SRGB)
    exponent = truth.exponent(tested)
    if any(low <= exponent <= high for low, high in _POWERS):
        curves.append(Curve.of(exponent, False))
    found = [(curve, truth.agreement(curve.undo(tested))) for curve in curves]
    found = [one for one in found if one[1].tells and one[1].level_share(one[1].level) >= _HALF]
    return max(found, key=lambda one: one[1].sharpness + (_FINER if one[0].srgb else 0.0), default=None)


def _washed_out(plain: Agreement, decoded: Agreement) -> bool:
    """Whether an image that agrees on nothing is sRGB-encoded all the same.

    Encoding brightens nearly everything, the dark more than the bright, so that contrasts grow less than levels; and
    decoding must bring both much nearer to the truth. An exposure raises contrasts as it raises levels.
    """
    if plain.brighter < _NEARLY_ALL or not (plain.tells and plain.contrast < plain.level - _FLATTER):
        return False
    levels, contrasts = (after / before for after, before in zip(decoded.off, plain.off, strict=True))
    return levels <= _NEARER[0] and contrasts <= _NEARER[1]


def transfer_fault(light: Light, display: bool) -> Fault | None:
    """The curve in words, if there is one."""
    if light.curve is None:
        return None
    exponent = light.curve.exponent
    curve = "sRGB curve" if light.curve.srgb else "power law"
    if exponent < 1:
        what = "encoded twice" if display else "encoded, where linear values were promised"
    else:
        what = "linear, where display values were promised" if display else "decoded once too often, or linear already"
    size = {"exponent": exponent, "srgb": float(light.curve.srgb)}
    return Fault("transfer", f"{what} ({curve}, exponent {exponent:.2f})", size)


def exposure_fault(light: Light, display: bool) -> Fault | None:
    """The factor in words, if there is one."""
    if light.factor == 1:
        return None
    stops = np.log2(light.factor)
    words = f"exposed × {light.factor:.3g} ({stops:+.2f} stops)"
    return Fault("exposure", words, {"factor": light.factor, "display": float(display)})


def _own_support(agreement: Agreement) -> float:
    """What speaks for the factor that most levels share."""
    return agreement.support(agreement.level) if agreement.tells else 0.0


def _factor(agreement: Agreement, backdrop: float | None) -> float:
    """The exposure, or 1: the background's where the surfaces share it, else the surfaces' own."""
    if not agreement.tells:
        return 1.0
    level, contrast = agreement.level, agreement.contrast
    if min(abs(level), abs(contrast)) <= LEAST_STOPS:
        return 1.0
    behind = None if backdrop is None else float(np.log(backdrop))
    if (
        behind is not None
        and max(abs(level - behind), abs(contrast - behind)) <= _TOGETHER
        and abs(behind) > LEAST_STOPS
    ):
        factor = behind
    elif abs(level - contrast) + agreement.spread <= _UNSURE * abs(level):
        factor = level
    else:
        return 1.0
    enough = agreement.support(factor) >= max(_SUPPORT, _LEAD * agreement.support(0.0))
    return float(np.exp(factor)) if enough else 1.0
