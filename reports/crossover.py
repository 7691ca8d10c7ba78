"""The crossover: at what time another method, of which a convergence curve is known, has become this good."""

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Crossover:
    """When a curve reaches an error.

    Attributes:
        ms: the time.
        relation: "=": interpolated between two points of the curve; "<=": the curve's first point is as good already;
            ">": it is not reached within the curve, which ends at `ms`.
    """

    ms: float
    relation: str

    def brief(self, number: str) -> str:
        """For a table's cell, with `number` for the milliseconds."""
        return {"=": f"after {number} ms", "<=": f"within {number} ms", ">": f"not within {number} ms"}[self.relation]

    def sentence(self, number: str) -> str:
        """The same of the path tracer, as a clause."""
        return {
            "=": f"the path tracer is as good after {number} ms",
            "<=": f"the path tracer's first image, after {number} ms, is as good",
            ">": f"the path tracer is not as good within {number} ms",
        }[self.relation]


def crossover(curve: Sequence[tuple[float, float]], error: float) -> Crossover | None:
    """From what time on a curve is at or below `error`.

    From there on *every* later point is as good, so that a single lucky image does not count. Between two points the
    curve is a power law (a straight line in log-log, as 1/√n is); beyond its last one nothing is claimed.

    Args:
        curve: (time, error), times above 0 and rising; points that are not finite are passed over.

    Returns:
        None where the curve has no point, or `error` is not finite.
    """
    known = [point for point in curve if all(map(math.isfinite, point))]
    if not known or not math.isfinite(error):
        return None
    worse = [index for index, (_, e) in enumerate(known) if e > error]
    if not worse:
        return Crossover(known[0][0], "<=")
    last = worse[-1]
    if last == len(known) - 1:
        return Crossover(known[-1][0], ">")
    return Crossover(_interpolate(known[last], known[last + 1], error), "=")


def _interpolate(before: tuple[float, float], after: tuple[float, float], error: float) -> float:
    """The time at which the line through two points in log-log has this error; before[1] > error ≥ after[1]."""
    (t0, e0), (t1, e1) = before, after
    if error <= 0 or e1 <= 0:  # no logarithm: an error of 0 is reached where it was measured
        return t1
    part = math.log(e0 / error) / math.log(e0 / e1)
    return t0 * (t1 / t0) ** part
