"""Durations and sizes as people write them: "30d", "5GB"."""

import math
import re

from lightmeter.failures import UsageError

_SECONDS = {"s": 1, "m": 60, "min": 60, "h": 3600, "d": 86400, "w": 7 * 86400}
_BYTES = {"": 1, "b": 1} | {
    unit: factor
    for power, letter in enumerate("kmgt", 1)
    for unit, factor in ((f"{letter}b", 1000**power), (letter, 1000**power), (f"{letter}ib", 1024**power))
}


def duration(text: str, what: str) -> float:
    """Seconds from "30d", "12h", "90min", "2w" or "45s".

    Raises:
        UsageError: it is none; `what` is what the message calls it.
    """
    return _read(text, what, _SECONDS, "a time such as 30d, 12h or 2w")


def byte_count(text: str, what: str) -> int:
    """Bytes from "5GB", "500MB", "1GiB" or "1000".

    Raises:
        UsageError: it is none; `what` is what the message calls it.
    """
    return int(_read(text, what, _BYTES, "a size such as 5GB, 500MB or 1GiB"))


def _read(text: str, what: str, units: dict[str, int], expected: str) -> float:
    match = re.fullmatch(r"(\d{1,12}(?:\.\d{1,6})?)\s*([a-z]*)", text.strip().lower())
    if match is None or match[2] not in units:
        raise UsageError(f"{what}: expected {expected}, got {text!r}")
    return float(match[1]) * units[match[2]]


def show_bytes(count: int) -> str:
    """ "12.3 MB", in powers of 1000."""
    power = min(4, max(0, math.floor(math.log10(max(count, 1)) / 3)))
    return f"{count} B" if power == 0 else f"{count / 1000**power:.1f} {' kMGT'[power]}B"


def show_duration(seconds: float) -> str:
    """ "3 d", "5 h", "12 min" or "40 s", in the largest unit that fits."""
    for unit, length in (("d", 86400), ("h", 3600), ("min", 60)):
        if seconds >= length:
            return f"{seconds / length:.0f} {unit}"
    return f"{max(0.0, seconds):.0f} s"


def counted(count: int, noun: str, plural: str = "") -> str:
    """ "1 batch", "8 batches"."""
    return f"{count} {noun if count == 1 else plural or noun + 's'}"
