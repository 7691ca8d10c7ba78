"""Shift and field of view: which of them an image has for sure, and how much."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .alignment import SHIFT, STILL, STRETCH, ZOOM, Edges, Fit, assess, pyramid, search
from .fault import Fault
from .placement import Placement

LEAST_SHIFT = 0.4
"""Pixels: half a pixel, less what differently lit edges may hide of it."""
LEAST_BORDER, LEAST_ANGLE = 0.45, 0.005
"""A field of view is named from this many pixels at the border, and this much of the tangent, on."""
SURE = 4.0
"""Standard errors that a shift or a scale must be away from 0."""
_GAIN, _GAIN_PER_PIXEL, _MOST_GAIN = 0.08, 0.06, 0.2
# By how much a fault of half a pixel must raise the Fisher transform of the edges' correlation, by how much more for
# each further pixel, and the most that is asked for.
_EVIDENCE = 2.0  # pixels' length of clear edges that must show it
_SMALLEST = 16  # pixels of the shorter side


@dataclass(frozen=True)
class Moves:
    """Which faults a placement may have, and the directions in which they move it."""

    shift: bool = True
    zoom: bool = True
    stretch: bool = False

    @property
    def free(self) -> np.ndarray:
        """(4, p)."""
        parts = [part for on, part in ((self.shift, SHIFT), (self.zoom, ZOOM), (self.stretch, STRETCH)) if on]
        return np.concatenate(parts, axis=1) if parts else np.zeros((4, 0))


def find_placement(
    tested: np.ndarray,
    reference: np.ndarray,
    variance: np.ndarray | None,
    valid: np.ndarray,
    start: tuple[float, float] = (0.0, 0.0),
) -> Placement:
    """Where the tested image lies: with a shift and scales where there are for sure, else as the reference.

    Args:
        tested, reference: (H, W) luminance, finite, not negative.
        variance: (H, W) of the reference's noise, or None.
        valid: (H, W) bool, where the tested image is what was handed in.
        start: (right, down) pixels, where to look as well as in place.
    """
    if min(tested.shape) < _SMALLEST:
        return Placement()
    levels = pyramid(tested, reference, variance, valid)
    edges = levels[-1][1]
    if not len(edges.rows):
        return Placement()
    moves, found = Moves(), _search(levels, start)
    # Backward elimination: what does not hold its ground is taken out, and the rest found again.
    while moves.free.size:
        fit = assess(edges, found, moves.free)
        kept = _kept(edges, fit, moves)
        if kept == moves:
            break
        moves, found = kept, search(edges, _project(found, kept.free), kept.free)
        if not np.isfinite(found).all():
            moves, found = Moves(shift=False, zoom=False), np.zeros(4)
    # Another aspect is rare, and looked for last.
    both = replace(moves, zoom=True, stretch=True)
    starts = (found, _descend(levels[:-1], start, Moves(stretch=True).free))
    candidates = [search(edges, _project(begin, both.free), both.free) for begin in starts]
    candidates = [one for one in candidates if np.isfinite(one).all()]
    if candidates:
        best = max(candidates, key=lambda one: edges.correlation(one, one))
        fit = assess(edges, best, both.free)
        if _holds(edges, fit, moves, slice(both.free.shape[1] - 1, None), _least_border(edges)):
            moves, found = both, best
    return _placement(edges, found, moves)


def shift_fault(placement: Placement) -> Fault | None:
    """The shift in words, if there is any."""
    if not (placement.right or placement.down):
        return None
    parts = []
    for value, positive, negative in ((placement.right, "right", "left"), (placement.down, "down", "up")):
        if value:
            parts.append((abs(value), positive if value > 0 else negative))
    (first, where), *rest = parts
    words = f"shifted by {first:.2f} pixels {where}" + "".join(f" and {size:.2f} {way}" for size, way in rest)
    return Fault("shift", words, {"right": placement.right, "down": placement.down})


def field_of_view_fault(placement: Placement) -> Fault | None:
    """The difference in field of view in words, if there is any."""
    across, upright = 100 * (placement.across - 1), 100 * (placement.upright - 1)
    if not (across or upright):
        return None
    if abs(across - upright) < 1e-9:
        seen = f"sees {_more(across)} than the truth"
    else:
        seen = f"sees {_more(across)} across and {_more(upright)} upright than the truth: another aspect"
    words = f"{seen} (in the tangent of half the angle of view)"
    return Fault("field_of_view", words, {"horizontal": across, "vertical": upright})


def _more(percent: float) -> str:
    return f"{abs(percent):.1f} % {'more' if percent > 0 else 'less'}" if percent else "as much"


def _search(levels: list[tuple[int, Edges]], start: tuple[float, float]) -> np.ndarray:
    """(4,) the better of the placement near none and of the one found coarse to fine; near none in doubt."""
    edges = levels[-1][1]
    free = Moves().free
    near = search(edges, np.zeros(4), free)
    near = near if np.isfinite(near).all() else np.zeros(4)
    far = _descend(levels, start, free)
    return far if _gain(edges, far, near) > _wanted(float(np.abs((far - near) / edges.units).max())) else near


def _descend(levels: list[tuple[int, Edges]], start: tuple[float, float], free: np.ndarray) -> np.ndarray:
    """(4,) the placement that is found coarse to fine."""
    found = np.array([*start, 0.0, 0.0])
    for factor, level in levels:
        pixels = np.array([factor, factor, 1.0, 1.0])
        better = search(level, found / pixels, free, STILL if factor == 1 else 10 * STILL) * pixels
        found = better if np.isfinite(better).all() else found
    return found


def _kept(edges: Edges, fit: Fit, moves: Moves) -> Moves:
    """Without the faults that do not hold their ground; the same where all do."""
    without_shift, without_zoom = replace(moves, shift=False), replace(moves, zoom=False)
    shift = moves.shift and _holds(edges, fit, without_shift, slice(2), LEAST_SHIFT)
    zoom = moves.zoom and _holds(edges, fit, without_zoom, slice(2 * moves.shift, None), _least_border(edges))
    return Moves(shift, zoom)


def _least_border(edges: Edges) -> float:
    return max(LEAST_BORDER, LEAST_ANGLE * max(edges.shape) / 2)


def _holds(edges: Edges, fit: Fit, without: Moves, part: slice, least: float) -> bool:
    """Whether the fault of these parameters is large, sure, and makes the edges coincide better than its absence."""
    size = float(np.hypot.reduce(fit.moved[part]))
    if size < least or not _sure(fit)[part].any():
        return False
    other = search(edges, _project(fit.placement, without.free), without.free)
    return _gain(edges, fit.placement, other) >= _wanted(size)


def _wanted(size: float) -> float:
    """The gain that is asked of a fault of that many pixels."""
    return min(_GAIN + _GAIN_PER_PIXEL * max(size - 0.5, 0.0), _MOST_GAIN)


def _sure(fit: Fit) -> np.ndarray:
    return (np.abs(fit.moved) > SURE * fit.doubt) & (fit.evidence >= _EVIDENCE)


def _placement(edges: Edges, found: np.ndarray, moves: Moves) -> Placement:
    """The placement in which what cannot be told from 0 is 0: a half of a shift, or one of two scales."""
    if not moves.free.size:
        return Placement()
    parts = [SHIFT] * moves.shift + ([np.eye(4)[:, 2:]] if moves.stretch else [ZOOM] * moves.zoom)
    free = np.concatenate(parts, axis=1)
    fit = assess(edges, found, free)
    right, down, across, upright = edges.units * (free @ np.where(_sure(fit), fit.moved, 0.0))
    return Placement(right, down, 1 + across, 1 + upright)


def _project(placement: np.ndarray, free: np.ndarray) -> np.ndarray:
    """(4,) the part of a placement along the free directions."""
    return free @ np.linalg.lstsq(free, placement, rcond=None)[0] if free.size else np.zeros(4)


def _gain(edges: Edges, placement: np.ndarray, other: np.ndarray) -> float:
    """By how much a placement's edges are more alike than another's: a difference of Fisher transforms."""
    if not np.isfinite(other).all():
        return np.inf
    one, two = edges.correlation(placement, other), edges.correlation(other, placement)
    return float(np.arctanh(min(one, 0.9999)) - np.arctanh(min(two, 0.9999)))
