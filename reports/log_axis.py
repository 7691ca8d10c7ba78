"""A logarithmic axis of a drawing."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

_MARGIN = 0.12
"""Room beyond the outermost values, in decades: a factor of 1.3."""
_FEW = 2.5
"""Decades up to which 2 and 5 times a power of ten are marked too."""
_MOST_TICKS = 7
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class LogAxis:
    """From 10^`low` at the position `start` to 10^`high` at `end`; low < high."""

    low: float
    high: float
    start: float
    end: float

    @classmethod
    def spanning(cls, values: Iterable[float], start: float, end: float) -> "LogAxis":
        """The axis that holds every value above 0 with room around them, a decade long at least."""
        logs = [math.log10(value) for value in values if 0 < value < math.inf] or [0.0]
        low, high = min(logs) - _MARGIN, max(logs) + _MARGIN
        lacking = max(0.0, 1.0 - (high - low)) / 2
        return cls(low - lacking, high + lacking, start, end)

    def position(self, value: float) -> float:
        """Where a value lies; what lies beyond is put at the end, 0 and less at the low one."""
        log = math.log10(value) if value > 0 else -math.inf
        part = min(1.0, max(0.0, (log - self.low) / (self.high - self.low)))
        return round(self.start + part * (self.end - self.start), 2)

    def ticks(self) -> list[tuple[float, str]]:
        """Positions and texts of powers of ten, and of 2 and 5 times them where there is room."""
        exponents = range(math.floor(self.low), math.ceil(self.high) + 1)
        if self.high - self.low <= _FEW:
            values = [(factor, exponent) for exponent in exponents for factor in (1, 2, 5)]
        else:
            step = math.ceil(len(exponents) / _MOST_TICKS)
            values = [(1, exponent) for exponent in exponents if exponent % step == 0]
        inside = [(f, e) for f, e in values if self.low <= math.log10(f) + e <= self.high]
        return [(self._at(math.log10(f) + e), _text(f, e)) for f, e in inside]

    def _at(self, log: float) -> float:
        return round(self.start + (log - self.low) / (self.high - self.low) * (self.end - self.start), 2)


def _text(factor: int, exponent: int) -> str:
    if -4 <= exponent <= 4:
        return f"{factor * 10.0**exponent:.{max(0, -exponent)}f}"
    power = f"10{str(exponent).translate(_SUPERSCRIPTS)}"
    return power if factor == 1 else f"{factor}·{power}"
