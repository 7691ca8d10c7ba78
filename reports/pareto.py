"""The Pareto front: what nothing else beats in both time and error."""

import math
from collections.abc import Sequence


def pareto_front(points: Sequence[tuple[float, float]]) -> list[bool]:
    """For each (time, error), both better when smaller, whether no other point is as good in both and better in one.

    Equal points are on the front together. A point that is not finite is never on it, and beats none.
    """
    finite = [p for p in points if all(map(math.isfinite, p))]
    return [p in finite and not any(_beats(other, p) for other in finite) for p in points]


def _beats(a: tuple[float, float], b: tuple[float, float]) -> bool:
    return a[0] <= b[0] and a[1] <= b[1] and a != b
