"""Pixels that lack what the truth shows: multiplied by their alpha, or without the surroundings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_erosion

from .fault import Fault
from .sides import Sides

OPAQUE, CLEAR = 0.98, 1 / 512
"""Alphas from and up to which a pixel counts as wholly or not at all covered: 8 bits hold no finer."""
_FEWEST = 16  # pixels that must speak for a fault
_DARK = 1e-3  # of the truth: black
_EVEN = 0.02  # relative spread of one colour
_OTHER, _OTHER_BENT = 0.1, 0.3  # of the logarithm: another colour; and where a curve was undone that may not be the one
_SAME = 0.02  # of the logarithm: channels that go together
_OFF = 0.3  # relative error from which on a pixel counts no more: its surface is another
_NOISE = 3.0  # standard errors above 0 of what shines
_CLEAR_OF_EDGES = 2  # pixels


def alpha_fault(sides: Sides) -> Fault | None:
    """Colours that are multiplied by alpha, where a pixel was promised as it is seen.

    At pixels that are partly covered three things are held against each other: the truth as it is; the truth times
    alpha; and the truth without the surroundings' part, which is a missing background and no fault of alpha.

    Args:
        sides: aligned, without other faults.
    """
    if sides.alpha is None:
        return None
    alpha, lit = sides.alpha, _shines(sides)
    partly = lit & (alpha > CLEAR) & (alpha < OPAQUE)
    gone = lit & (alpha <= CLEAR) & _black(sides)
    if np.count_nonzero(partly) >= _FEWEST:
        share = alpha[partly][:, None]
        truth, tested = sides.truth[partly], sides.tested[partly]
        expected = [truth, share * truth]
        behind = _behind(sides)
        if behind is not None:
            expected.append(np.maximum(truth - (1 - share) * behind, 0.0))
        level = truth.mean(axis=1, keepdims=True)
        costs = [np.mean(np.minimum(np.abs(tested - one) / level, _OFF) ** 2) for one in expected]
        if not (costs[1] == min(costs) and costs[1] < costs[0] / 2):
            return None
        pixels = int(np.count_nonzero(partly))
    else:
        # Without partly covered pixels only surfaces can tell: background that is black is named as that.
        gone &= ~_background(sides)
        pixels = 0
        if np.count_nonzero(gone) < _FEWEST:
            return None
    lost = int(np.count_nonzero(gone))
    words = f"colours are multiplied by alpha at {pixels + lost} pixels"
    words += f", and lost at {lost} of them, where alpha is 0" if lost else ""
    return Fault("alpha", words, {"pixels": float(pixels + lost), "lost": float(lost)})


def background_fault(sides: Sides, explained: bool = False, bent: bool = False) -> Fault | None:
    """Surroundings that the truth shows, and the image does not: black, or one other colour.

    Args:
        sides: aligned, without other faults.
        explained: whether a multiplication by alpha has been named: then what has no alpha is black for that.
        bent: whether a transfer curve was undone.
    """
    seen = _background(sides) & _shines(sides)
    if explained and sides.alpha is not None:
        seen &= sides.alpha > CLEAR
    colour = _one_colour(sides, seen)
    if colour is None:
        return None
    if colour.black:
        what = "is black"
    elif np.abs(colour.ratios).max() <= (_OTHER_BENT if bent else _OTHER):
        return None
    elif colour.factor is not None:
        what = f"is × {colour.factor:.3g} as bright as the truth's"
    else:
        what = "is one colour, ({:.3g}, {:.3g}, {:.3g})".format(*colour.value)
    alike = np.abs(sides.tested - colour.value).max(axis=2) <= colour.tolerance
    pixels = int(np.count_nonzero(seen & alike))
    return Fault("background", f"the background {what} at {pixels} pixels", {"pixels": float(pixels)})


def background_factor(sides: Sides) -> float | None:
    """The factor by which the background's one colour is brighter than the truth's; None where it is no multiple."""
    colour = _one_colour(sides, _background(sides) & _shines(sides))
    return None if colour is None or colour.black else colour.factor


@dataclass(frozen=True, eq=False)
class _Colour:
    """The colour that a background has everywhere.

    Attributes:
        value: (3,).
        tolerance: how far from it a pixel may be.
        ratios: (3,) logarithms of its ratios to the truth's.
        black: whether it is.
    """

    value: np.ndarray
    tolerance: float
    ratios: np.ndarray
    black: bool

    @property
    def factor(self) -> float | None:
        """What the ratios are, where they are the same."""
        return float(np.exp(self.ratios.mean())) if np.ptp(self.ratios) < _SAME else None


def _one_colour(sides: Sides, seen: np.ndarray) -> _Colour | None:
    """The one colour of these pixels; None where there are too few, or it is not one."""
    inner: np.ndarray = np.asarray(binary_erosion(seen, iterations=_CLEAR_OF_EDGES, border_value=1))
    if np.count_nonzero(inner) < _FEWEST:
        return None
    tested, truth = sides.tested[inner], sides.truth[inner]
    value, level = np.median(tested, axis=0), float(truth.mean())
    tolerance = max(_EVEN * float(value.max()), _DARK * level)
    if np.percentile(np.abs(tested - value), 90) > tolerance:
        return None
    ratios = np.log(np.maximum(np.median(tested / truth, axis=0), _DARK))
    return _Colour(value, tolerance, ratios, bool(value.max() <= _DARK * level))


def dark_background(sides: Sides) -> np.ndarray:
    """(H, W) bool: pixels that see no surface, where the truth shines and the tested image is black."""
    return _background(sides) & _black(sides)


def _background(sides: Sides) -> np.ndarray:
    return np.zeros(sides.valid.shape, bool) if sides.background is None else sides.background & sides.valid


def _shines(sides: Sides) -> np.ndarray:
    """(H, W) bool: where the truth is above 0 for sure."""
    level = sides.truth.mean(axis=2)
    noise = 0.0 if sides.variance is None else np.sqrt(sides.variance.mean(axis=2))
    return sides.valid & (level > _NOISE * noise) & (level > _DARK * float(level.mean()))


def _black(sides: Sides) -> np.ndarray:
    return sides.valid & (sides.tested.max(axis=2) <= _DARK * sides.truth.mean(axis=2)) & (sides.truth.max(axis=2) > 0)


def _behind(sides: Sides) -> np.ndarray | None:
    """(3,) what surrounds the scene, as far as it is one colour; None where nothing tells."""
    seen = _background(sides)
    return np.median(sides.truth[seen], axis=0) if np.count_nonzero(seen) >= _FEWEST else None
