"""A part in percent of its whole."""

import math

from lightmeter.metrics.measurement import Measurement


def percent_of(part: Measurement, whole: Measurement) -> Measurement | None:
    """`part` in percent of the value of `whole`; None where the whole cannot be told from 0.

    The interval is the part's own. That of the whole is left out: both come from the same pictures, and what is
    asked is which part is how large, not how sure the whole is.
    """
    if not math.isfinite(whole.value) or whole.value <= 0 or (whole.low is not None and whole.low <= 0):
        return None
    return in_percent(part, whole.value)


def in_percent(part: Measurement, whole: float = 1.0) -> Measurement:
    """`part` in percent of a number that is not 0."""
    scale = 100.0 / whole
    low, high = part.low, part.high
    return Measurement(
        part.value * scale,
        None if low is None else low * scale,
        None if high is None else high * scale,
        "%",
        part.how,
    )
