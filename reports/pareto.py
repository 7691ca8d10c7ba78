"""The Pareto front: what nothing else beats in both time and error."""

import math
from collections.abc import Sequence


def pareto_front(points: Sequence[tuple[float, float]], spreads: Sequence[float] = ()) -> list[bool]:
    """For each (time, error), both better when smaller, whether no other point is as good in both and better in one.

    Equal points are on the front together. A point that is not finite is never on it, and beats none.

    Where times are uncertain a point has to earn its place: it is on the front only if it is faster than every better
    one there by more than the two spreads together. Else what noise makes look fast would never be beaten.

    Args:
        spreads: of each time; none: the times are exact.
    """
    spread = list(spreads) or [0.0] * len(points)
    finite = [index for index, point in enumerate(points) if all(map(math.isfinite, point))]
    front: list[int] = []
    for index in sorted(finite, key=lambda i: (points[i][1], points[i][0])):
        if not any(_beats(points[i], points[index], math.hypot(spread[i], spread[index])) for i in front):
            front.append(index)
    return [index in front for index in range(len(points))]


def _beats(a: tuple[float, float], b: tuple[float, float], unsure: float) -> bool:
    """Whether `a`, which errs no more than `b`, is better: of equal errors, by a time that is told apart."""
    return a[0] < b[0] - unsure if a[1] == b[1] else a[0] <= b[0] + unsure
