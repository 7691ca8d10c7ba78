"""Engines in a plane of error against time, both logarithmic, as positions in a drawing; no markup."""

import itertools
import math
from collections.abc import Sequence
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.candidate_words import has_time, is_ours, time_as_measured
from lightmeter.reports.label_places import Box, label_places
from lightmeter.reports.log_axis import LogAxis
from lightmeter.reports.metric_words import label
from lightmeter.reports.pareto import pareto_front
from lightmeter.reports.results import Candidate
from lightmeter.reports.shown_names import short_name, text_width
from lightmeter.reports.significant import show_interval, show_measurement, show_value
from lightmeter.reports.sweep_figures import GROUP_COLOURS

WIDTH, HEIGHT = 680, 400
_ROOM = Box(62, 12, WIDTH - 12, HEIGHT - 46)
_LONGEST_LABEL = 26
_COLUMN = 6.9
"""About the width of a letter of the labels, in the drawing's units."""
_FARTHEST = 10.0
"""How many times a value the end of its interval may be to be shown; a whisker beyond runs into the edge."""

# Circle, square, diamond, triangle and star around (0, 0), of about the same area.
_SHAPES = (
    "M-5.5 0A5.5 5.5 0 1 1 5.5 0A5.5 5.5 0 1 1-5.5 0Z",
    "M-5-5H5V5H-5Z",
    "M0-7L7 0L0 7L-7 0Z",
    "M0-6.5L6.5 5H-6.5Z",
    "M0-7.5L1.9-2.6L7.1-2.3L3.1 1L4.4 6.1L0 3.3L-4.4 6.1L-3.1 1L-7.1-2.3L-1.9-2.6Z",
)


def engine_mark(place: int, candidate: Candidate) -> dict[str, Any]:
    """Colour and shape of the engine that stands at `place`; no two of the first 25 have both in common.

    Hollow is one whose time holds its start-up.
    """
    count = len(GROUP_COLOURS)
    return {
        "colour": GROUP_COLOURS[place % count],
        "shape": _SHAPES[(place + place // count) % len(_SHAPES)],
        "hollow": candidate.time_whole,
    }


def engine_plot(candidates: Sequence[Candidate], metric: str) -> dict[str, Any] | None:
    """The plot of one metric; None where less than two engines have a time and an error.

    An error of 0 or less (noise taken out of an error that is none) is drawn at the lower edge. The front is that of
    what was measured: a time with start-up is the most that the engine's frame can take, so what it beats is beaten.
    """
    placed = [(place, one) for place, one in enumerate(candidates) if _can_be_drawn(one, metric)]
    if len(placed) < 2:
        return None
    errors = [one.metrics[metric] for _, one in placed]
    times = [_time(one) for _, one in placed]
    across = LogAxis.spanning([end for time in times for end in _ends(time)], _ROOM.left, _ROOM.right)
    upward = LogAxis.spanning([end for error in errors for end in _ends(error)], _ROOM.bottom, _ROOM.top)
    points = [(across.position(t.value), upward.position(e.value)) for t, e in zip(times, errors, strict=True)]
    names = [_label(one, error) for (_, one), error in zip(placed, errors, strict=True)]
    on_front = pareto_front([(time.value, error.value) for time, error in zip(times, errors, strict=True)])
    corners = _stair([point for point, on in zip(points, on_front, strict=True) if on])
    widths = [_COLUMN * text_width(name) for name in names]
    labels = label_places(points, widths, _ROOM, [_along(a, b) for a, b in itertools.pairwise(corners)])
    unit = next((error.unit for error in errors if error.unit), "")
    return {
        "metric": metric,
        "title": f"{label(metric)} against time",
        "width": WIDTH,
        "height": HEIGHT,
        "room": _ROOM,
        "across": across.ticks(),
        "upward": upward.ticks(),
        "x_title": "time of a frame, ms",
        "y_title": label(metric) + (f", {unit}" if unit else ""),
        "front": "M" + "L".join(f"{x} {y}" for x, y in corners),
        "at_the_edge": any(error.value <= 0 for error in errors),
        "hollow": any(one.time_whole for _, one in placed),
        "engines": [
            engine_mark(place, one)
            | {
                "name": name,
                "ours": is_ours(one),
                "x": point[0],
                "y": point[1],
                "label": where,
                "whisker_x": _whisker(time, across),
                "whisker_y": _whisker(error, upward),
                "tip": _tip(one, metric, on),
            }
            for (place, one), name, point, where, time, error, on in zip(
                placed, names, points, labels, times, errors, on_front, strict=True
            )
        ],
        "absent": [short_name(one.name) for one in candidates if not _can_be_drawn(one, metric)],
    }


def _can_be_drawn(candidate: Candidate, metric: str) -> bool:
    error = candidate.metrics.get(metric)
    drawable = error is not None and math.isfinite(error.value)
    return drawable and has_time(candidate) and _time(candidate).value > 0


def _time(candidate: Candidate) -> Measurement:
    assert candidate.time_ms is not None
    return time_as_measured(candidate.time_ms)


def _label(candidate: Candidate, error: Measurement) -> str:
    ours = " (ours)" if is_ours(candidate) else ""
    return short_name(candidate.name, _LONGEST_LABEL) + ours + (" ↓" if error.value <= 0 else "")


def _ends(measurement: Measurement) -> list[float]:
    """The value and the ends of its interval, as far as the axis has to hold them."""
    value, low, high = measurement.value, measurement.low, measurement.high
    if low is None or high is None:
        return [value]
    nearest = value / _FARTHEST if value > 0 else 0.0
    farthest = value * _FARTHEST if value > 0 else math.inf
    return [value, *(end for end in (low, high) if nearest <= end <= farthest)]


def _whisker(measurement: Measurement, axis: LogAxis) -> tuple[float, float] | None:
    low, high = measurement.low, measurement.high
    if low is None or high is None or math.isnan(low) or math.isnan(high):
        return None
    return axis.position(low), axis.position(high)


def _stair(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """The front's corners: what is reached at a time stays reached until the next engine of the front is affordable."""
    ordered = sorted(points)
    corners = [(ordered[0][0], _ROOM.top)]
    for x, y in ordered:
        corners += [(x, corners[-1][1]), (x, y)]
    return [*corners, (_ROOM.right, corners[-1][1])]


def _along(a: tuple[float, float], b: tuple[float, float]) -> Box:
    """An upright or level line as an obstacle."""
    return Box(min(a[0], b[0]) - 1, min(a[1], b[1]) - 1, max(a[0], b[0]) + 1, max(a[1], b[1]) + 1)


def _tip(candidate: Candidate, metric: str, on_front: bool) -> str:
    error, time = candidate.metrics[metric], _time(candidate)
    shown = " ".join(part for part in (show_value(time), show_interval(time), "ms") if part)
    parts = [
        short_name(candidate.name, 80),
        f"{label(metric)} {show_measurement(error)}",
        f"{shown}, {candidate.time_how}" if candidate.time_how else shown,
    ]
    if error.value <= 0:
        parts.append("drawn at the lower edge: no error beyond the reference's noise")
    return "; ".join([*parts, *(["on the Pareto front"] if on_front else [])])
