"""Bars to both sides of 0 with whiskers, as positions in percent of a column's width."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from lightmeter.metrics.measurement import Measurement


@dataclass(frozen=True)
class Axis:
    """What a column of bars spans, the same for all of its rows; `low` ≤ 0 ≤ `high`."""

    low: float
    high: float

    @classmethod
    def spanning(cls, measurements: Iterable[Measurement]) -> "Axis":
        """The axis that holds 0 and every value and every end of an interval that is finite."""
        ends = [0.0]
        for one in measurements:
            ends += [end for end in (one.value, one.low, one.high) if end is not None and math.isfinite(end)]
        return cls(min(ends), max(ends))

    def position(self, value: float) -> float:
        """0 at the left end to 100 at the right one; what lies beyond is put at the end."""
        if self.high <= self.low:
            return 0.0
        return round(100 * min(1.0, max(0.0, (value - self.low) / (self.high - self.low))), 2)

    def bar(self, measurement: Measurement) -> dict[str, Any] | None:
        """A bar from 0 to the value, and its whisker; None for what is not a number."""
        if not math.isfinite(measurement.value):
            return None
        zero, tip = self.position(0.0), self.position(measurement.value)
        bar = {
            "start": min(zero, tip),
            "width": round(abs(tip - zero), 2),
            "zero": zero,
            "sign": "negative" if measurement.value < 0 else "positive",
        }
        low, high = measurement.low, measurement.high
        if low is not None and high is not None and not math.isnan(low) and not math.isnan(high):
            bar |= {"low": self.position(low), "high": self.position(high)}
        return bar
