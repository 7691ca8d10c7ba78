"""The verdict of a limit: by the whole interval, or not at all."""

import math

import pytest

from lightmeter.holding import conditions
from lightmeter.limit import Limit
from lightmeter.metrics.measurement import Measurement
from lightmeter.verdict import bound_of, explain_verdict, judge


def limit(metric: str, high: float | None = None, low: float | None = None) -> Limit:
    return Limit("here", "plane", "frame", metric, high, low, conditions())


@pytest.mark.parametrize(
    ("bound", "measured", "verdict"),
    [
        (limit("rmse", high=1), Measurement(0.5, 0.4, 0.6), "PASS"),
        (limit("rmse", high=1), Measurement(0.9, 0.8, 1.0), "PASS"),
        (limit("rmse", high=1), Measurement(0.9, 0.8, 1.1), "UNDECIDED"),
        (limit("rmse", high=1), Measurement(1.1, 0.9, 1.3), "UNDECIDED"),
        (limit("rmse", high=1), Measurement(1.5, 1.4, 1.6), "FAIL"),
        (limit("rmse", high=1), Measurement(math.nan), "FAIL"),
        (limit("rmse", high=1), Measurement(math.nan, 0.1, 0.2), "FAIL"),
        (limit("rmse", high=1), Measurement(math.inf), "FAIL"),
        (limit("rmse", high=1), Measurement(0.5, math.nan, math.nan), "UNDECIDED"),
        (limit("rmse", high=1), Measurement(0.5, 0.0, math.inf), "UNDECIDED"),
        (limit("psnr", low=30), Measurement(35, 33, 37), "PASS"),
        (limit("psnr", low=30), Measurement(29, 28, 31), "UNDECIDED"),
        (limit("psnr", low=30), Measurement(25, 24, 26), "FAIL"),
        (limit("psnr", low=30), Measurement(math.inf, 40, math.inf), "PASS"),
        (limit("psnr", low=30), Measurement(math.inf), "PASS"),
        (limit("flip", high=0.1), Measurement(0.09), "PASS"),
        (limit("flip", high=0.1), Measurement(0.11), "FAIL"),
        (limit("bias", high=0.1), Measurement(-0.05, -0.06, -0.04), "PASS"),
        (limit("bias", high=0.1), Measurement(-0.5, -0.6, -0.4), "FAIL"),
        (limit("bias", high=0.1), Measurement(0.5, 0.4, 0.6), "FAIL"),
        (limit("bias", high=0.1), Measurement(-0.1, -0.2, -0.05), "UNDECIDED"),
        (limit("bias", high=0.1), Measurement(0.01, -0.02, 0.04), "PASS"),
    ],
)
def test_verdicts(bound, measured, verdict):
    assert judge(bound_of(bound), measured) == verdict
    assert bound.metric in explain_verdict(bound, measured, verdict)
