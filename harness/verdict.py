"""Whether a measurement keeps within a limit."""

import math

from lightmeter.limits import Limit
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.registry import find_metric
from lightmeter.reports.junit import Status
from lightmeter.reports.significant import show_number


def judge(limit: Limit, measurement: Measurement) -> Status:
    """PASS where the whole interval keeps within the limit, FAIL where all of it is beyond, else UNDECIDED.

    A metric without an interval is judged by its value and by the value corrected for noise: where they disagree the
    reference's noise decides, which is no reason to fail. What is not a number fails. Of a signed metric (bias) the
    magnitude is judged.
    """
    value, low, high = _judged(limit, measurement)
    if math.isnan(value):
        return "FAIL"
    worst, best = (high, low) if limit.high is not None else (low, high)
    if _within(limit, worst):
        return "PASS"
    if math.isnan(best) or _within(limit, best) or math.isnan(worst):
        return "UNDECIDED"
    return "FAIL"


def explain_verdict(limit: Limit, measurement: Measurement, status: Status) -> str:
    """One sentence: what was measured, and why that is the verdict."""
    if math.isnan(measurement.value):
        return f"{measurement.how or 'the value is not a number'}; the limit is {limit.words}"
    reason = {
        "PASS": "keeps within",
        "FAIL": "is beyond",
        "UNDECIDED": "may lie on either side of",
    }[status]
    shown = show_number(measurement.value, 5)
    if measurement.low is not None and measurement.high is not None:
        shown += f" ({show_number(measurement.low, 5)} … {show_number(measurement.high, 5)})"
    if measurement.corrected is not None:
        shown += f" (corrected for noise: {show_number(measurement.corrected, 5)})"
    return f"{limit.metric} of {limit.of} = {shown} {reason} the limit {limit.words}"


def _within(limit: Limit, value: float) -> bool:
    return value <= limit.high if limit.high is not None else value >= (limit.low or 0.0)


def _judged(limit: Limit, measurement: Measurement) -> tuple[float, float, float]:
    """Value and interval as they are judged; without an interval its ends are the value and the corrected one."""
    value, low, high = measurement.value, measurement.low, measurement.high
    if low is None or high is None:
        corrected = value if measurement.corrected is None else measurement.corrected
        low, high = min(value, corrected), max(value, corrected)
    if not find_metric(limit.metric).signed:
        return value, low, high
    nearest = 0.0 if low <= 0 <= high else min(abs(low), abs(high))
    return abs(value), nearest, max(abs(low), abs(high))
