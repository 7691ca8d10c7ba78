"""A sweep as tables for the terminal, made of rich's renderables; the caller prints them."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.metric_words import label
from lightmeter.reports.results import Timing
from lightmeter.reports.significant import show_measurement, show_number, show_value
from lightmeter.reports.sweep_results import METRICS, VIEWS, Setting, Standing, Sweep, SweptEffect, best, show_knob

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table


def sweep_tables(sweep: Sweep) -> Group:
    """A table per effect and view, with the best setting; the path tracer; notes."""
    from rich.console import Group
    from rich.text import Text

    parts: list = []
    for swept in sweep.effects:
        for view in swept.views:
            parts.append(_table(swept, view))
            parts += [Text(sentence) for sentence in conclusions(swept, view)] + [Text()]
        beside = remarks(swept)
        parts += [Text(sentence) for sentence in beside] + [Text()] * bool(beside)
    if sweep.path_tracer:
        parts.append(_curve(sweep))
    if sweep.others:
        parts.append(_others(sweep))
    parts += [Text.assemble(("note: ", "dim"), note) for note in sweep.notes]
    return Group(*parts)


def conclusions(swept: SweptEffect, view: str) -> list[str]:
    """For each metric: the best setting, when the path tracer is as good, and how many settings may be so too."""
    sentences = []
    for metric in METRICS:
        setting = best(swept, view, metric)
        if setting is None:
            continue
        standing = setting.standing(view)
        text = (
            f"Least {label(metric)}: {show_measurement(standing.metrics[metric])} with {setting.label} in "
            f"{show_number(standing.time_ms.median)} ms"
        )
        clause = crossing_clause(standing, metric)
        equals = _as_good(swept, view, setting) if metric == "rmse" else ""
        sentences.append((f"{text}; {clause}." if clause else f"{text}.") + equals)
    return sentences


def _as_good(swept: SweptEffect, view: str, least: Setting) -> str:
    """A sentence on the settings whose RMSE cannot be told from the least; "" where there are none."""
    others = [s for s in swept.settings if s.standing(view).as_good and s is not least]
    if not others:
        return ""
    fastest = min([least, *others], key=lambda s: s.standing(view).time_ms.median)
    beside = f", the fastest of them {fastest.label} in {show_number(fastest.standing(view).time_ms.median)} ms"
    return f" {len(others)} more cannot be told from it{'' if fastest is least else beside}."


def remarks(swept: SweptEffect) -> list[str]:
    """What the current setting is, and a sentence for each knob of which values make no difference."""
    return [f"Current setting: {swept.here}."] * bool(swept.here) + [
        f"No row for {idle.knob} ({', '.join(map(show_knob, idle.values))}): the same picture bit for bit, in "
        f"{_between(idle.least_ms, idle.most_ms)} ms."
        for idle in swept.idle
    ]


def _between(least: float, most: float) -> str:
    numbers = dict.fromkeys((show_number(least), show_number(most)))
    return " to ".join(numbers)


def crossing(standing: Standing, metric: str) -> str:
    """When the path tracer is as good, for a table; "" where that cannot be said."""
    found = standing.path_tracer.get(metric)
    return found.brief(show_number(found.ms)) if found else ""


def crossing_clause(standing: Standing, metric: str) -> str:
    """The same as a clause."""
    found = standing.path_tracer.get(metric)
    return found.sentence(show_number(found.ms)) if found else ""


def show_time(timing: Timing) -> str:
    """Median and its spread: "2.31 ± 0.04"."""
    return show_measurement(Measurement(timing.median, timing.median - timing.mad, timing.median + timing.mad))


def _table(swept: SweptEffect, view: str) -> Table:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    what = f"time of {swept.own_time}" if view == "effect" else "the frame's error and time"
    table = Table(
        title=Text(f"{swept.effect}: {VIEWS[view]} ({what})"), title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False
    )
    table.add_column("setting")
    for metric in METRICS:
        table.add_column(label(metric), justify="right", no_wrap=True)
    for column in ("ms", *["baked, ms"] * swept.bakes, "front", "path tracer (RMSE)"):
        table.add_column(column, justify="right", no_wrap=True)
    for setting in swept.settings:
        table.add_row(*map(Text, _cells(setting, view, swept.bakes)), style="bold" if setting.current else "")
    return table


def show_bake(setting: Setting) -> str:
    """What baking took, once."""
    return "–" if setting.bake_ms is None else show_number(setting.bake_ms)


def _cells(setting: Setting, view: str, bakes: bool) -> list[str]:
    standing = setting.standing(view)
    front = [label(metric) for metric in METRICS if standing.front.get(metric)]
    return [
        setting.label,
        *(_bare(standing.metrics[metric]) for metric in METRICS),
        show_time(standing.time_ms),
        *[show_bake(setting)] * bakes,
        ", ".join(front),
        crossing(standing, "rmse"),
    ]


def _bare(measurement: Measurement) -> str:
    """Value and interval without the unit."""
    failed = "✕ " if math.isnan(measurement.value) else ""
    return failed + show_measurement(replace(measurement, unit=""))


def _curve(sweep: Sweep) -> Table:
    from rich import box
    from rich.table import Table

    table = Table(title="Path tracer", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for column in ("spp", *(label(metric) for metric in METRICS), "ms"):
        table.add_column(column, justify="right", no_wrap=True)
    for point in sweep.path_tracer:
        values = (show_value(point.metrics[metric]) for metric in METRICS)
        table.add_row(str(point.spp), *values, show_time(point.time_ms))
    return table


def _others(sweep: Sweep) -> Table:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(title="Other renderers", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("renderer")
    for column in (*(label(metric) for metric in METRICS), "ms"):
        table.add_column(column, justify="right", no_wrap=True)
    table.add_column("time", style="dim")
    for other in sweep.others:
        values = [_bare(other.metrics[metric]) if metric in other.metrics else "–" for metric in METRICS]
        time = show_time(other.time_ms) if other.time_ms else "–"
        table.add_row(*map(Text, (other.name, *values, time, other.time_how)))
    return table
