"""Undoes the faults of a frame."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..input_error import InputError
from .curves import Curve, srgb_decode, srgb_encode
from .fault import Fault
from .flip import mirror
from .holes import CLEAR
from .placement import Placement, inside

ORDER = ("transfer", "exposure", "alpha", "flip", "shift", "field_of_view")
"""In which faults are undone, whichever are given: first what was done to values, then where they lie. The last two in
one step, so that the image is resampled once."""


def correct(tested: np.ndarray, faults: Iterable[Fault], *, alpha: np.ndarray | None = None) -> np.ndarray:
    """The frame without the given faults, as a new array.

    Resampling is cubic and adds nothing outside the range of neighbouring pixels; it blurs a little. Where the
    corrected frame shows what the handed one does not hold, the border repeats: `outside` says where.

    Args:
        tested: (H, W, 3), the frame as it was handed to `find_faults`.
        faults: some or all of what that found.
        alpha: (H, W) as it was handed in; needed for the fault "alpha". Pixels whose alpha is 0 stay as they are.

    Returns:
        (H, W, 3) float32.

    Raises:
        InputError: a background that is missing cannot be made up; colours are to be divided by an alpha that is not
            given; or there is no such fault.
    """
    given = {fault.name: fault for fault in faults}
    _check(given, alpha)
    image = np.asarray(tested, np.float64)
    if "transfer" in given:
        size = given["transfer"].size
        image = Curve.of(size["exponent"], bool(size["srgb"])).undo(image)
    if "exposure" in given:
        size = given["exposure"].size
        image = srgb_encode(srgb_decode(image) / size["factor"]) if size["display"] else image / size["factor"]
    if "alpha" in given and alpha is not None:
        covered = np.where(np.asarray(alpha) > CLEAR, alpha, 1.0)
        image = image / covered[..., None]
    if "flip" in given:
        size = given["flip"].size
        image = mirror(image, bool(size["left_right"]), bool(size["up_down"]))
    image = _placement(given).undo(image)
    return np.ascontiguousarray(image, np.float32)


def outside(faults: Iterable[Fault], shape: tuple[int, ...]) -> np.ndarray:
    """(H, W) bool: pixels of a corrected frame that show what the handed one does not hold.

    Args:
        faults: as given to `correct`.
        shape: of the frame.
    """
    placement = _placement({fault.name: fault for fault in faults})
    return ~inside(*placement.targets(shape), shape)


def _placement(given: dict[str, Fault]) -> Placement:
    shift = given["shift"].size if "shift" in given else {"right": 0.0, "down": 0.0}
    seen = given["field_of_view"].size if "field_of_view" in given else {"horizontal": 0.0, "vertical": 0.0}
    return Placement(shift["right"], shift["down"], 1 + seen["horizontal"] / 100, 1 + seen["vertical"] / 100)


def _check(given: dict[str, Fault], alpha: np.ndarray | None) -> None:
    if "background" in given:
        raise InputError(
            "a missing background cannot be corrected",
            expected=f"faults among {', '.join(ORDER)}",
            actual="background",
            remedy="Render the surroundings, or leave the background out of the comparison.",
        )
    unknown = [name for name in given if name not in ORDER]
    if unknown:
        raise InputError(
            f"there is no fault {unknown[0]!r}",
            expected=f"faults among {', '.join(ORDER)}",
            actual=unknown[0],
            remedy="Give what find_faults returned.",
        )
    if "alpha" in given and alpha is None:
        raise InputError(
            "colours cannot be divided by alpha",
            expected="the alpha that came with the image",
            actual="none",
            remedy="Give alpha, or leave that fault out.",
        )
