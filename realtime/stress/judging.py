"""What a function gave beside what it should have given, lane by lane."""

from dataclasses import dataclass

import numpy as np

from ..twin import Twin

EPS = float(np.finfo(np.float32).eps)
LARGEST = float(np.finfo(np.float32).max)
SMALLEST = 1e-24
"""A smaller result is judged as if it were as large: even under a sun 10¹² times as bright as what is seen beside it
no frame shows it, and its factors lie near the end of what float32 holds with all digits."""
HALF_NORMAL = 2.0**-14
"""The smallest number that a half float, or a float of 11 or 10 bits, holds with its full digits."""
HALF_STEP = 2.0**-11
"""Half a rounding of a half float, relative."""
OF_CONSTANTS = 1e-3
"""A result below this part of the constants it is a difference of (`Twin.cancels`) is judged as if it were as large."""


@dataclass(frozen=True)
class Verdict:
    """Errors over lanes (n,).

    Attributes:
        relative: largest error of a result over its largest component; 0 where there is nothing to judge.
        absolute: likewise.
        nan, inf, negative: where the function is so and the exact result is not.
    """

    relative: np.ndarray
    absolute: np.ndarray
    nan: np.ndarray
    inf: np.ndarray
    negative: np.ndarray


def exact_results(twin: Twin, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """The twin's [result, out arguments…] in float64, each (components, n)."""
    arguments = [argument for argument in twin.arguments if not argument.out]
    n = inputs[0].shape[1]
    flat = [x[0] if a.size == 1 else x for a, x in zip(arguments, inputs, strict=True)]
    with np.errstate(all="ignore"):
        result = twin.python(*flat)
    results = result if isinstance(result, tuple) else (result,)
    return [np.broadcast_to(np.asarray(r, np.float64), (*np.shape(r)[:-1], n)).reshape(-1, n) for r in results]


def judged_slots(twin: Twin) -> list[int]:
    """Which of the results are numbers: whole ones and yes or no have no digits."""
    types = [twin.result, *(argument.type for argument in twin.arguments if argument.out)]
    return [slot for slot, kind in enumerate(types) if kind not in ("int", "bool", "void")]


def undecided(twin: Twin, inputs: list[np.ndarray]) -> np.ndarray:
    """(n,) lanes where float32 cannot tell the sign that a branch depends on: either side is right."""
    lanes = np.zeros(inputs[0].shape[1], bool)
    if twin.signs:
        with np.errstate(all="ignore"):
            for value, magnitude in twin.signs(*inputs):
                lanes |= ~(np.abs(value) > 4 * EPS * magnitude)
    return lanes


def judge(twin: Twin, inputs, got, exact, signed: set[int], smallest: float = SMALLEST, eps: float = EPS) -> Verdict:
    """The verdict over lanes.

    Args:
        signed: the results that are negative by rights.
        smallest: of the format that the results are held in.
        eps: of the numbers that are reckoned with: so far below 0 their rounding alone may lead.
    """
    n = inputs[0].shape[1]
    relative, absolute = np.zeros(n), np.zeros(n)
    nan, inf, negative = (np.zeros(n, bool) for _ in range(3))
    unclear = undecided(twin, inputs)
    floor = max(smallest, OF_CONSTANTS * twin.cancels)
    for slot in judged_slots(twin):
        e, g = exact[slot], got[slot]
        sound = np.isfinite(e).all(axis=0) & (np.abs(e) < LARGEST).all(axis=0)
        nan |= sound & np.isnan(g).any(axis=0)
        inf |= sound & np.isinf(g).any(axis=0)
        size = np.max(np.abs(np.where(np.isfinite(e), e, 0)), axis=0)
        allowed = twin.roundings * eps * (size + twin.cancels)
        negative |= (
            sound & (slot not in signed) & ((g < 0) & (e >= 0) & (-g > np.maximum(allowed, smallest))).any(axis=0)
        )
        with np.errstate(invalid="ignore", over="ignore"):
            error = np.max(np.abs(g - e), axis=0)
        error = np.where(sound & np.isfinite(error) & ~unclear, error, 0)
        absolute = np.maximum(absolute, error)
        relative = np.maximum(relative, error / np.maximum(size, floor))
    return Verdict(relative, absolute, nan, inf, negative)


def attainable(twin: Twin, inputs: list[np.ndarray], step: float = EPS / 2) -> np.ndarray:
    """(n,) relative change of the exact result when each component of the inputs moves by half a rounding, `step`."""
    here = exact_results(twin, inputs)
    slots = judged_slots(twin)
    change = np.zeros(inputs[0].shape[1])
    arguments = [argument for argument in twin.arguments if not argument.out]
    for i, argument in enumerate(arguments):
        for component in range(argument.size if argument.continuous else 0):
            moved = [x.copy() for x in inputs]
            moved[i][component] *= 1 - step
            for slot in slots:
                with np.errstate(all="ignore"):
                    moves = np.max(np.abs(exact_results(twin, moved)[slot] - here[slot]), axis=0)
                    size = np.maximum(np.max(np.abs(here[slot]), axis=0), OF_CONSTANTS * twin.cancels)
                    change = np.fmax(change, 0) + np.nan_to_num(moves / np.maximum(size, 1e-300), nan=0.0, posinf=1.0)
    return change
