"""A comparison as a table for the terminal, made of rich's renderables; the caller prints them.

Names come from scene files and drivers, so every cell is plain `Text`: nothing in it is read as markup.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.closure import closure_statement
from lightmeter.reports.metric_words import in_order, label, present
from lightmeter.reports.results import Results, Timing
from lightmeter.reports.significant import show_interval, show_measurement, show_value

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

_COLUMNS = ("flip", "ssim")
_STYLES = {"meets": "green", "wide": "yellow", "unknown": "yellow", "differs": "bold red"}


def comparison(results: Results) -> Group:
    """Table of effects and frame, closure, what is not finite, what was left out, notes: what there is of them."""
    from rich.console import Group
    from rich.text import Text

    parts: list = [comparison_table(results)]
    if results.nonfinite.total():
        parts.append(Text(_nonfinite(results), style="bold red"))
    if results.closure:
        statement = closure_statement(results.closure)
        parts.append(Text(statement.sentence, style=_STYLES[statement.verdict]))
    parts += [_reason("left out", item.what, item.why) for item in results.left_out]
    if results.not_approximated:
        parts.append(_reason("not approximated", ", ".join(results.not_approximated), ""))
    parts += [_reason("note", note, "") for note in results.notes]
    return Group(*parts)


def comparison_table(results: Results) -> Table:
    """A row per effect and one for the frame: term, RMSE with interval, FLIP, SSIM, milliseconds."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    title = Text(f"{results.scene}, {results.size[0]}×{results.size[1]}")
    table = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    names = [name for metrics in _all_metrics(results) for name in metrics]
    columns = present(_COLUMNS, names)
    table.add_column("effect", no_wrap=True)
    table.add_column("term", no_wrap=True)
    table.add_column("RMSE", justify="right", no_wrap=True)
    for name in columns:
        table.add_column(label(name), justify="right", no_wrap=True)
    table.add_column("ms", justify="right", no_wrap=True)
    for effect in results.effects:
        cells = [_number(effect.metrics.get(name)) for name in columns]
        terms = Text("\n".join(effect.terms))
        table.add_row(Text(effect.effect), terms, _bare(effect.metrics.get("rmse")), *cells, _time(effect.time_ms))
    if results.effects:
        table.add_section()
    frame = results.frame.metrics
    cells = [_number(frame.get(name)) for name in columns]
    table.add_row(Text("frame", style="bold"), Text(), _bare(frame.get("rmse")), *cells, _time(results.frame.time_ms))
    unit = next((m["rmse"].unit for m in _all_metrics(results) if "rmse" in m and m["rmse"].unit), "")
    table.caption = Text(f"RMSE in {unit}, of code values 0…1 for tone and encode" if unit else "", justify="left")
    return table


def metric_table(metrics: dict[str, Measurement]) -> Table:
    """A row per metric: name, value, interval, unit, how it was obtained (for `diff`)."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("metric")
    table.add_column("value", justify="right")
    table.add_column("how", style="dim")
    for name in in_order(metrics):
        table.add_row(Text(label(name)), _full(metrics[name]), Text(metrics[name].how))
    return table


def _all_metrics(results: Results) -> list:
    return [results.frame.metrics, *(effect.metrics for effect in results.effects)]


def _nonfinite(results: Results) -> str:
    bad = results.nonfinite
    counts = {"frame": bad.frame, **bad.effects}
    parts = []
    for name, count in counts.items():
        if count:
            places = ", ".join(f"({x}, {y})" for x, y in bad.where.get(name, ())[:3])
            parts.append(f"{name} {count}" + (f" at {places}" if places else ""))
    return "✕ pixels that are not finite: " + "; ".join(parts)


def _full(measurement: Measurement | None) -> Text:
    from rich.text import Text

    if measurement is None:
        return Text("–", style="dim")
    if math.isnan(measurement.value):  # an infinite PSNR is a perfect one
        return Text(f"✕ {show_measurement(measurement)}", style="bold red")
    return Text(show_measurement(measurement))


def _bare(measurement: Measurement | None) -> Text:
    """The same without its unit, which the caption names."""
    return _full(None if measurement is None else replace(measurement, unit=""))


def _number(measurement: Measurement | None) -> Text:
    from rich.text import Text

    if measurement is None:
        return Text("–", style="dim")
    failed = math.isnan(measurement.value)
    return Text(("✕ " if failed else "") + show_value(measurement), style="bold red" if failed else "")


def _time(timing: Timing | None) -> Text:
    from rich.text import Text

    if timing is None:
        return Text("–", style="dim")
    measured = Measurement(timing.median, timing.median - timing.mad, timing.median + timing.mad)
    return Text(" ".join(part for part in (show_value(measured), show_interval(measured)) if part))


def _reason(kind: str, what: str, why: str) -> Text:
    from rich.text import Text

    return Text.assemble((f"{kind}: ", "dim"), what, (f": {why}" if why else "", "dim"))
