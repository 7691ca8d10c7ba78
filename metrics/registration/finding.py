"""Looks for what is commonly wrong with a frame, and says by how much."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .agreement import Truth
from .fault import Fault
from .flip import find_flip, flip_fault
from .geometry import field_of_view_fault, find_placement, shift_fault
from .holes import OPAQUE, alpha_fault, background_factor, background_fault, dark_background
from .light import Light, exposure_fault, find_light, transfer_fault
from .placement import Placement
from .sides import Sides

_ENOUGH = 0.25  # of the pixels must be opaque, or all are asked for the exposure


def find_faults(
    tested: np.ndarray,
    reference: np.ndarray | Sequence[np.ndarray],
    *,
    alpha: np.ndarray | None = None,
    background: np.ndarray | None = None,
    display: bool = False,
) -> tuple[Fault, ...]:
    """What is wrong with a frame as a whole, in the order in which `find_faults` looks for it.

    A flip first; then shift and field of view, on edges, which light does not move; then transfer and exposure
    together; then, with all of that undone, alpha and background. A fault is named where it is sure and large enough to
    matter; what cannot be told (no edges, no agreement) is not named. docs/registration.md says how, and how well.

    Args:
        tested: (H, W, 3), the frame, scene-linear. Pixels that are not finite are left out; values below 0 count as 0.
        reference: (K, H, W, 3), independent batches of the truth; pixels that are not finite in any are left out.
        alpha: (H, W) as it was handed in, 0…1.
        background: (H, W) bool, where pixels' centres see no surface; without it, no background is missed.
        display: both sides are display values 0…1, encoded by the sRGB curve.

    Raises:
        InputError: the shapes do not fit.
    """
    sides = Sides.of(tested, reference, alpha, background, display)
    if not sides.valid.any():
        return ()
    flip = find_flip(*sides.luminances)
    sides = sides.without_flip(flip)
    start = (flip.right, flip.down)
    aligned, placement = _aligned(sides, start)
    light = _light(aligned)
    if light.curve is not None:
        # A curve moves the edges of what is partly covered: with it undone, they are looked at once more.
        sides = replace(sides, tested=light.curve.undo(sides.tested))
        aligned, placement = _aligned(sides, start)
        light = replace(light, factor=_light(aligned).factor)
    straight = replace(aligned, tested=aligned.tested / light.factor)
    clear = alpha_fault(straight)
    found = (
        flip_fault(flip),
        shift_fault(placement),
        field_of_view_fault(placement),
        transfer_fault(light, display),
        exposure_fault(light, display),
        clear,
        background_fault(straight, explained=clear is not None, bent=light.curve is not None),
    )
    return tuple(fault for fault in found if fault is not None)


def _aligned(sides: Sides, start: tuple[float, float]) -> tuple[Sides, Placement]:
    """The truth laid as the tested image, and how that lies."""
    placement = find_placement(*sides.luminances, sides.valid, start)
    return sides.aligned(placement), placement


def _light(sides: Sides) -> Light:
    """What was done to the values, asked of pixels that are wholly there.

    Where all pixels together say nothing and the background is wrong, it may be the background's fault: then the
    surfaces are asked alone.
    """
    valid = sides.valid & ~dark_background(sides)
    if sides.alpha is not None and np.count_nonzero(valid & (sides.alpha >= OPAQUE)) >= _ENOUGH * valid.size:
        valid = valid & (sides.alpha >= OPAQUE)
    light = find_light(sides.tested, Truth(sides.truth, sides.variance, valid), background_factor(sides))
    if light == Light() and sides.background is not None and background_fault(sides) is not None:
        surfaces = valid & ~sides.background
        return find_light(sides.tested, Truth(sides.truth, sides.variance, surfaces))
    return light
