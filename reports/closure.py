"""What the closure says, in one plain sentence."""

import math
from dataclasses import dataclass
from typing import Literal

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.results import Closure
from lightmeter.reports.significant import show_interval, show_value

# A wide interval holds 0 and proves nothing; this is the half-width, as a fraction of the mean, up to which a
# closure counts as shown (the design's bound for the scenes of the library).
NARROW = 5e-4

Verdict = Literal["meets", "wide", "differs", "unknown"]


@dataclass(frozen=True)
class Statement:
    """The verdict and the sentence that explains it."""

    verdict: Verdict
    sentence: str


def closure_statement(closure: Closure) -> Statement:
    """Whether the composition with every term exact meets the reference, and how surely."""
    bias = closure.bias
    low, high = bias.low, bias.high
    shown = _shown(bias)
    if not math.isfinite(bias.value):
        return Statement("differs", f"With every term exact the composition is not a number: {shown}.")
    if low is None or high is None or not math.isfinite(high - low):
        return Statement(
            "unknown", f"With every term exact the composition is off by {shown}; no interval, so it proves nothing."
        )
    if not low <= 0 <= high:
        return Statement(
            "differs", f"With every term exact the composition does not meet the reference: {shown} is unexplained."
        )
    if (high - low) / 2 > NARROW:
        return Statement(
            "wide",
            f"With every term exact the composition agrees with the reference as far as can be told: {shown}. "
            "The interval is too wide to prove it: a larger budget narrows it.",
        )
    return Statement("meets", f"With every term exact the composition meets the reference: {shown}.")


def _shown(bias: Measurement) -> str:
    unit = bias.unit.strip()
    of = "of the mean" if unit in ("", "1", "of the mean") else unit
    interval = show_interval(bias)
    if "…" in interval:
        interval = f"({interval})"
    return " ".join(part for part in ("bias", show_value(bias), interval, of) if part)
