"""The path tracer's own convergence: the error of its image against the time it takes, at growing sample counts."""

import time
from collections.abc import Iterator, Mapping

import numpy as np

from lightmeter.measuring import Display, Question, answer
from lightmeter.metrics.measurement import Measurement
from lightmeter.progress import Report
from lightmeter.reports.results import Timing
from lightmeter.reports.sweep_results import METRICS, CurvePoint
from lightmeter.sides import Sides
from lightmeter.truth import Truth

IMAGES = 3
"""Images per sample count, each with random numbers of its own; an odd number, so that one is in the middle."""


def convergence(
    truth: Truth, display: Display, goal: Mapping[str, float], seconds: float, report: Report
) -> Iterator[CurvePoint]:
    """The curve at 1, 2, 4, … samples per pixel, until every goal is reached or the time is spent.

    Each image is timed and held against the reference, which is independent of it. A point has the median time and
    the median error of its images; the interval is that image's, and says how well the reference knows its error.

    Args:
        goal: metric to the error that is to be reached.
        seconds: rendering time of the whole curve, about; there is one point at least.
    """
    number = 0

    def image(spp: int) -> tuple[float, np.ndarray]:
        nonlocal number
        number += 1
        start = time.perf_counter()
        made = truth.path_traced(spp, number)
        return time.perf_counter() - start, made

    for spp in (1, 2):  # compiles, and brings memory and caches to where they stay
        image(spp)
    spent, spp = 0.0, 1
    while True:
        report("path tracer", int(10 * min(spent, seconds)), int(10 * seconds))
        made = [image(spp) for _ in range(IMAGES)]
        took = [one for one, _ in made]
        spent += sum(took)
        errors = [
            answer(Question(METRICS, Sides([picture], list(truth.reference.batches))), display) for _, picture in made
        ]
        point = CurvePoint(spp, _timing(took), {name: _median([e[name] for e in errors]) for name in METRICS})
        yield point
        reached = all(point.metrics[name].value <= goal[name] for name in METRICS)
        if reached or spent + 2 * sum(took) > seconds:
            break
        spp *= 2
    report("path tracer", 1, 1)


def _timing(seconds: list[float]) -> Timing:
    milliseconds = np.array(seconds) * 1e3
    median = float(np.median(milliseconds))
    return Timing(median, float(np.median(np.abs(milliseconds - median))), len(milliseconds))


def _median(measured: list[Measurement]) -> Measurement:
    """The measurement in the middle (of an odd number)."""
    return sorted(measured, key=lambda m: m.value)[len(measured) // 2]
