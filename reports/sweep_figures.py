"""A sweep's plots, as plotly's figures: error against time on logarithmic axes."""

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.metric_words import label
from lightmeter.reports.significant import show_measurement, show_number
from lightmeter.reports.sweep_results import CurvePoint, Other, Setting, SweptEffect, curve_of, show_knob
from lightmeter.reports.sweep_table import crossing_clause, show_bake, show_time

# Okabe & Ito 2008, Color Universal Design; those of them that are seen on white and on black. Each group has a
# symbol of its own beside its colour: there are knobs enough in one effect for colours to come again.
GROUP_COLOURS = ("#0072B2", "#E69F00", "#009E73", "#56B4E9", "#CC79A7")
GROUP_SYMBOLS = (
    *("circle", "square", "diamond", "triangle-up", "star"),
    *("triangle-down", "pentagon", "hourglass", "triangle-left", "star-square"),
)
PATH_TRACER = "#D55E00"
INK = "ink"
"""Stands for the page's text colour, dark or light."""


def figure(
    swept: SweptEffect, curve: Sequence[CurvePoint], view: str, metric: str, others: Sequence[Other] = ()
) -> dict[str, Any]:
    """One plot, as JSON for plotly: settings, their front, the path tracer's curve, the crossovers, other renderers."""
    listed = [s for s in swept.settings if math.isfinite(s.standing(view).metrics[metric].value)]
    points = list(curve) if swept.comparable else []
    shown = [o for o in others if view == "frame" and o.time_ms and _finite(o.metrics.get(metric))]
    values = [s.standing(view).metrics[metric].value for s in listed]
    values += [p.metrics[metric].value for p in [*points, *shown]]
    floor = 0.5 * min((v for v in values if v > 0), default=1.0)
    lines = {name: [s for s in members if s in listed] for name, members in groups(swept.settings).items()}
    traces = _settings(lines, view, metric, floor)
    traces += [_front(listed, view, metric, floor), _current(listed, view, metric, floor)]
    if points:
        traces += [_curve(points, metric, floor), *_crossovers(listed, view, metric, floor)]
    traces += [_other(other, metric, floor) for other in shown]
    traces.append(_names(listed, view, metric, floor))
    unit = next((s.standing(view).metrics[metric].unit for s in listed), "")
    of = swept.effect if view == "effect" else "the frame"
    time = swept.own_time if view == "effect" else "the frame"
    layout = {
        "xaxis": {"type": "log", "title": {"text": f"time of {time}, ms"}},
        "yaxis": {"type": "log", "title": {"text": f"{label(metric)} of {of}" + (f", {unit}" if unit else "")}},
    }
    return {"data": [trace for trace in traces if trace["x"]], "layout": layout}


def groups(settings: Sequence[Setting]) -> dict[str, list[Setting]]:
    """Settings that belong on one line: those of a knob; of a grid, those that share the value of the knob with the
    fewest, a choice rather than a number."""
    varied = [s.varied for s in settings if s.varied]
    names = list(dict.fromkeys(varied))
    if len(names) == 1 and len(names[0]) > 1:
        shortest = min(names[0], key=lambda knob: _values(settings, knob))
        keys = [f"{shortest} {show_knob(s.knobs[shortest])}" for s in settings]
        return {key: [s for s, k in zip(settings, keys, strict=True) if k == key] for key in dict.fromkeys(keys)}
    found = {}
    for name in names:
        members = [s for s in settings if s.varied in (name, ())]
        if all(isinstance(s.knobs[name[0]], (int, float)) for s in members):
            members.sort(key=lambda s: s.knobs[name[0]])
        found[name[0]] = members
    return found or {"setting": list(settings)}


def _values(settings: Sequence[Setting], knob: str) -> tuple[int, bool]:
    """How many values a knob takes, and whether they are numbers."""
    found = {s.knobs[knob] for s in settings}
    return len(found), all(isinstance(value, (int, float)) for value in found)


def _in_order(members: Sequence[Setting]) -> bool:
    """Whether a line through settings means anything: they differ in one knob, which is a number and no choice."""
    values = [{s.knobs[name] for s in members} for name in (members[0].knobs if members else ())]
    differing = [found for found in values if len(found) > 1]
    return len(differing) == 1 and not any(isinstance(value, (str, bool)) for value in differing[0])


def _settings(lines: Mapping[str, Sequence[Setting]], view: str, metric: str, floor: float) -> list[dict[str, Any]]:
    traces = []
    for index, (name, members) in enumerate(lines.items()):
        colour = GROUP_COLOURS[index % len(GROUP_COLOURS)]
        symbol = GROUP_SYMBOLS[index % len(GROUP_SYMBOLS)]
        measured = [s.standing(view).metrics[metric] for s in members]
        times = [s.standing(view).time_ms for s in members]
        traces.append(
            {
                "name": escape(name),
                "mode": "lines+markers" if _in_order(members) else "markers",
                "x": [t.median for t in times],
                "y": [max(m.value, floor) for m in measured],
                "error_x": _bar([t.mad for t in times], [t.mad for t in times], colour),
                "error_y": _interval(measured, floor, colour),
                "line": {"color": colour, "width": 1, "dash": "dot"},
                "marker": {
                    "color": colour,
                    "size": 10,
                    "symbol": [symbol if m.value > 0 else "triangle-down-open" for m in measured],
                },
                "hovertext": [_hover(s, view, metric) for s in members],
                "hoverinfo": "text",
            }
        )
    return traces


def _hover(setting: Setting, view: str, metric: str) -> str:
    standing = setting.standing(view)
    measured = standing.metrics[metric]
    lines = [
        f"<b>{escape(setting.label)}</b>" + (" (current)" if setting.current and setting.varied else ""),
        f"{label(metric)} {escape(show_measurement(measured))}",
        f"{show_time(standing.time_ms)} ms" + (f", baked in {show_bake(setting)} ms" if setting.bake_ms else ""),
        *(["on the Pareto front"] if standing.front.get(metric) else []),
    ]
    if measured.value <= 0:
        lines.append("drawn at the lower edge: no error beyond the reference's noise")
    clause = crossing_clause(standing, metric)
    return "<br>".join(lines + ([clause] if clause else []))


def _front(listed: Sequence[Setting], view: str, metric: str, floor: float) -> dict[str, Any]:
    """A stair: what is reached at a time stays reached until the next setting of the front is affordable."""
    on = _on_front(listed, view, metric)
    return {
        "name": "Pareto front",
        "mode": "lines",
        "x": [s.standing(view).time_ms.median for s in on],
        "y": [max(s.standing(view).metrics[metric].value, floor) for s in on],
        "line": {"shape": "hv", "color": INK, "width": 2},
        "opacity": 0.55,
        "hoverinfo": "skip",
    }


def _names(listed: Sequence[Setting], view: str, metric: str, floor: float) -> dict[str, Any]:
    """The front's settings by name: below them, where no other can be, and the fastest's inside the plot."""
    on = _on_front(listed, view, metric)
    return {
        "name": "names",
        "mode": "markers+text",
        "x": [s.standing(view).time_ms.median for s in on],
        "y": [max(s.standing(view).metrics[metric].value, floor) for s in on],
        "text": [escape(s.label) for s in on],
        "textposition": ["bottom right", *["bottom left"] * len(on)][: len(on)],
        "textfont": {"size": 11, "color": INK},
        "marker": {"size": 16, "opacity": 0},  # keeps the text off the symbol
        "hoverinfo": "skip",
        "showlegend": False,
    }


def _on_front(listed: Sequence[Setting], view: str, metric: str) -> list[Setting]:
    """The front, the fastest first."""
    on = [s for s in listed if s.standing(view).front.get(metric)]
    return sorted(on, key=lambda s: s.standing(view).time_ms.median)


def _current(listed: Sequence[Setting], view: str, metric: str, floor: float) -> dict[str, Any]:
    here = [s.standing(view) for s in listed if s.current]
    return {
        "name": "current setting",
        "mode": "markers",
        "x": [s.time_ms.median for s in here],
        "y": [max(s.metrics[metric].value, floor) for s in here],
        "marker": {"symbol": "circle-open", "size": 19, "color": INK, "line": {"width": 2}},
        "hoverinfo": "skip",
    }


def _curve(points: Sequence[CurvePoint], metric: str, floor: float) -> dict[str, Any]:
    measured = [p.metrics[metric] for p in points]
    spread = [p.time_ms.mad for p in points]
    return {
        "name": "path tracer",
        "mode": "lines+markers",
        "x": [time for time, _ in curve_of(points, metric)],
        "y": [max(m.value, floor) for m in measured],
        "error_x": _bar(spread, spread, PATH_TRACER),
        "error_y": _interval(measured, floor, PATH_TRACER),
        "line": {"color": PATH_TRACER, "width": 2},
        "marker": {"color": PATH_TRACER, "size": 7, "symbol": "cross"},
        "hovertext": [
            f"<b>path tracer, {p.spp} spp</b><br>{label(metric)} {escape(show_measurement(p.metrics[metric]))}"
            f"<br>{show_time(p.time_ms)} ms per image"
            for p in points
        ],
        "hoverinfo": "text",
    }


def _finite(measured: Measurement | None) -> bool:
    return measured is not None and math.isfinite(measured.value)


def _other(other: Other, metric: str, floor: float) -> dict[str, Any]:
    """Another renderer; hollow where its time holds its start-up."""
    measured, time = other.metrics[metric], other.time_ms
    assert time is not None, "without a time it has no place in the plot"
    return {
        "name": escape(other.name),
        "mode": "markers+text",
        "x": [time.median],
        "y": [max(measured.value, floor)],
        "error_x": _bar([time.mad], [time.mad], INK),
        "error_y": _interval([measured], floor, INK),
        "marker": {"color": INK, "size": 11, "symbol": "hexagon-open" if other.time_whole else "hexagon"},
        "text": [escape(other.name)],
        "textposition": "top center",
        "hovertext": [
            f"<b>{escape(other.name)}</b><br>{label(metric)} {escape(show_measurement(measured))}"
            f"<br>{show_time(time)} ms, {escape(other.time_how)}<br>over {other.pixels} pixels"
        ],
        "hoverinfo": "text",
    }


def _crossovers(listed: Sequence[Setting], view: str, metric: str, floor: float) -> list[dict[str, Any]]:
    """From each setting of the front to where the path tracer is as good; nothing where the curve does not say."""
    marks, lines = [], []
    for setting in listed:
        standing = setting.standing(view)
        crossed = standing.path_tracer.get(metric)
        if crossed is not None and crossed.relation == "=" and standing.front.get(metric):
            error = max(standing.metrics[metric].value, floor)
            text = f"the path tracer is as good as <b>{escape(setting.label)}</b><br>after {show_number(crossed.ms)} ms"
            marks.append((crossed.ms, error, text))
            lines += [(standing.time_ms.median, error), (crossed.ms, error), (None, None)]
    return [
        {
            "name": "crossover",
            "mode": "lines",
            "x": [x for x, _ in lines],
            "y": [y for _, y in lines],
            "line": {"color": INK, "width": 1, "dash": "dash"},
            "opacity": 0.4,
            "hoverinfo": "skip",
            "showlegend": False,
        },
        {
            "name": "crossover",
            "mode": "markers",
            "x": [x for x, _, _ in marks],
            "y": [y for _, y, _ in marks],
            "marker": {"symbol": "x", "size": 11, "color": INK},
            "hovertext": [text for _, _, text in marks],
            "hoverinfo": "text",
        },
    ]


def _interval(measured: Sequence[Measurement], floor: float, colour: str) -> dict[str, Any]:
    """The intervals as bars; of no length where there is none, and none below the plot's lower edge."""
    up = [m.high - max(m.value, floor) if m.high is not None else 0.0 for m in measured]
    down = [max(m.value, floor) - max(m.low, floor / 2) if m.low is not None else 0.0 for m in measured]
    return _bar([max(0.0, x) for x in up], [max(0.0, x) for x in down], colour)


def _bar(plus: Sequence[float], minus: Sequence[float], colour: str) -> dict[str, Any]:
    return {
        "type": "data",
        "symmetric": False,
        "array": list(plus),
        "arrayminus": list(minus),
        "color": colour,
        "thickness": 1.2,
        "width": 3,
    }


def figures(
    swept: SweptEffect, curve: Sequence[CurvePoint], metrics: Sequence[str], others: Sequence[Other] = ()
) -> Mapping[str, Any]:
    """View to metric to figure, for the views that tell its settings apart."""
    return {view: {metric: figure(swept, curve, view, metric, others) for metric in metrics} for view in swept.views}
