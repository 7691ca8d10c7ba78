"""From a limit and what was measured to a verdict in words."""

import math

from lightmeter.limit import Limit
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.registry import METRICS, find_metric
from lightmeter.metrics.sequential import Bound, Side
from lightmeter.reports.significant import show_number
from lightmeter.reports.verdict import Status

STATUS: dict[Side, Status] = {"within": "PASS", "beyond": "FAIL", "open": "UNDECIDED"}
"""What a side means."""


def bound_of(limit: Limit) -> Bound:
    """The bound of a limit that names it. Of a signed metric (bias) the magnitude is judged."""
    signed = limit.metric in METRICS and find_metric(limit.metric).signed
    number = limit.high if limit.high is not None else limit.low
    assert number is not None, "a regression's bound is the baseline's"
    return Bound(number, number, limit.high is not None, signed)


def judge(bound: Bound, measurement: Measurement) -> Status:
    """The verdict on a measurement that is all there will be.

    Without an interval it is a point: of one reference image, taken as exact, there is nothing else to judge. What is
    not a number fails.
    """
    if math.isnan(measurement.value):
        return "FAIL"
    low, high = measurement.low, measurement.high
    if low is None or high is None:
        low = high = measurement.value
    return STATUS[bound.side(low, high)]


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
    return f"{limit.metric} of {limit.what} = {shown} {reason} the limit {limit.words}"
