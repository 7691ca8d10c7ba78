"""A comparison as a table for the terminal, made of rich's renderables; the caller prints them.

Names come from scene files and drivers, so every cell is plain `Text`: nothing in it is read as markup.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.ambient_content import ambient_line
from lightmeter.reports.bounce_content import bounce_line
from lightmeter.reports.candidates_table import side_by_side
from lightmeter.reports.closure import closure_statement
from lightmeter.reports.fix_first import fix_first
from lightmeter.reports.metric_words import TAILS, beside_the_mean, error_phrase, in_order, label, present
from lightmeter.reports.object_content import by_share
from lightmeter.reports.percentages import in_percent, percent_of
from lightmeter.reports.ray_content import ray_line
from lightmeter.reports.reasons import by_reason
from lightmeter.reports.results import Attribution, ObjectError, Results
from lightmeter.reports.shadow_content import shadow_line
from lightmeter.reports.shown_names import printable
from lightmeter.reports.significant import show_measurement, show_number
from lightmeter.reports.terminal_cells import bare, full, milliseconds, number, reason
from lightmeter.reports.truth_words import truth_words

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

_COLUMNS = ("flip", "ssim")
_BESIDE_SHARES = ("flip",)
"""What a log's 120 columns have room for beside the shares."""
_SHARED = "mse"
_LEAST_PERCENT = 0.005
_MOST_FIXES = 3
_STYLES = {"meets": "green", "wide": "yellow", "unknown": "yellow", "differs": "bold red"}


def comparison(results: Results) -> Group:
    """Table of effects and frame, what to fix first, closure, what was left out, notes, engines side by side: what
    there is of them."""
    from rich.console import Group
    from rich.text import Text

    parts: list = [comparison_table(results), *_tails(results)]
    if baked := [f"{e.effect} {show_number(e.bake_ms)} ms" for e in results.effects if e.bake_ms is not None]:
        parts.append(reason("baked once, before the first frame", ", ".join(baked)))
    if results.nonfinite.total():
        parts.append(Text(_nonfinite(results), style="bold red"))
    if results.attribution:
        totals = results.attribution.total.items()
        parts += [_fix_first(results, results.attribution, name) for name, total in totals if _finite(total)]
    if worst := by_share([one for one in results.objects if _finite(one.share)]):
        parts.append(_object(worst[0]))
    parts += [reason(*shadow_line(shadow)) for shadow in results.shadows]
    parts += [reason(*ray_line(rays)) for rays in results.rays]
    if results.ambient:
        parts.append(reason(*ambient_line(results.ambient)))
    parts += [reason(*bounce_line(bounce)) for bounce in results.bounces]
    if results.closure:
        statement = closure_statement(results.closure)
        parts.append(Text(statement.sentence, style=_STYLES[statement.verdict]))
    parts += [reason("left out", ", ".join(what), why) for why, what in by_reason(results.left_out).items()]
    if results.not_approximated:
        parts.append(reason("not approximated", ", ".join(results.not_approximated)))
    parts += [reason("note", note) for note in results.notes]
    parts += side_by_side(results)
    return Group(*parts)


def comparison_table(results: Results) -> Table:
    """A row per effect and one for the frame: term, RMSE with interval, FLIP, SSIM, milliseconds.

    Where the error was attributed, also the share of the frame's MSE, with rows for what no effect stands for.
    """
    from rich import box
    from rich.table import Table
    from rich.text import Text

    title = Text(f"{results.scene}, {results.size[0]}×{results.size[1]}{truth_words(results.reference)}")
    table = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    names = [name for metrics in _all_metrics(results) for name in metrics]
    shares = _shares(results)
    columns = present(_COLUMNS if not shares else _BESIDE_SHARES, names)
    table.add_column("effect", no_wrap=True)
    table.add_column("term", no_wrap=True)
    table.add_column("RMSE", justify="right", no_wrap=True)
    for name in columns:
        table.add_column(label(name), justify="right", no_wrap=True)
    if shares:
        table.add_column(f"% of {label(_SHARED)}", justify="right", no_wrap=True)
    table.add_column("ms", justify="right", no_wrap=True)
    for effect in results.effects:
        cells = [number(effect.metrics.get(name)) for name in columns]
        cells += [_percent(shares.get(effect.effect))] if shares else []
        stored = [] if effect.bytes_per_pixel is None else [f"{effect.bytes_per_pixel} bytes per pixel"]
        terms = Text("\n".join([*effect.terms, *stored]))
        table.add_row(
            Text(effect.effect), terms, bare(effect.metrics.get("rmse")), *cells, milliseconds(effect.time_ms)
        )
    effects = {effect.effect for effect in results.effects}
    for name in (name for name in shares if name not in effects):
        blank = [Text() for _ in columns]
        table.add_row(Text(), Text(name, style="dim"), Text(), *blank, _percent(shares[name]), Text())
    if results.effects:
        table.add_section()
    frame = results.frame.metrics
    cells = [number(frame.get(name)) for name in columns]
    cells += [Text("100")] if shares else []
    table.add_row(
        Text("frame", style="bold"), Text(), bare(frame.get("rmse")), *cells, milliseconds(results.frame.time_ms)
    )
    unit = next((m["rmse"].unit for m in _all_metrics(results) if "rmse" in m and m["rmse"].unit), "")
    table.caption = Text(f"RMSE in {unit}, of code values 0…1 for tone and encode" if unit else "", justify="left")
    return table


def _percent(share: Measurement | None) -> Text:
    """A share in percent; what two decimals do not show is 0."""
    ends = [] if share is None else [abs(x) for x in (share.value, share.low, share.high) if x is not None]
    return bare(Measurement(0.0) if ends and max(ends) < _LEAST_PERCENT else share)


def _shares(results: Results) -> dict[str, Measurement]:
    """Player to its share of the frame's MSE in percent, then what is unexplained; empty where there is none."""
    attribution = results.attribution
    if attribution is None or _SHARED not in attribution.total:
        return {}
    parts = {player.name: player.share[_SHARED] for player in attribution.players if _SHARED in player.share}
    if _SHARED in attribution.residual:
        parts["unexplained"] = attribution.residual[_SHARED]
    found = {name: percent_of(part, attribution.total[_SHARED]) for name, part in parts.items()}
    return {name: share for name, share in found.items() if share}


def _tails(results: Results) -> list[Text]:
    """The frame's percentiles and worst tiles, which a mean would drown."""
    found = {label(name): beside_the_mean(name, results.frame.metrics) for name in TAILS}
    line = "; ".join(f"{name} {tail}" for name, tail in found.items() if tail)
    return [reason("frame, beside the mean", line)] if line else []


def _fix_first(results: Results, attribution: Attribution, metric: str) -> Text:
    """The players whose exactness removes most, at most three of them."""
    fixes = [item for item in fix_first(results, attribution, metric) if item.verdict == "fix"]
    named = [f"{item.name} {show_measurement(item.removed)}" for item in fixes[:_MOST_FIXES]]
    what = ", ".join(named) or "nothing stands out of the noise"
    return reason(f"fix first ({error_phrase(metric)} removed)", what)


def _object(worst: ObjectError) -> Text:
    share = show_measurement(in_percent(worst.share))
    material = f" ({printable(worst.material)})" if worst.material else ""
    what = f"{printable(worst.name)}{material} holds {share} of the squared error, on {worst.pixels:,} pixels"
    return reason("largest error", what)


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
        table.add_row(Text(label(name)), full(metrics[name]), Text(metrics[name].how))
    return table


def _all_metrics(results: Results) -> list:
    return [results.frame.metrics, *(effect.metrics for effect in results.effects)]


def _finite(measurement: Measurement) -> bool:
    return math.isfinite(measurement.value)


def _nonfinite(results: Results) -> str:
    bad = results.nonfinite
    counts = {"frame": bad.frame, **bad.effects}
    parts = []
    for name, count in counts.items():
        if count:
            places = ", ".join(f"({x}, {y})" for x, y in bad.where.get(name, ())[:3])
            parts.append(f"{name} {count}" + (f" at {places}" if places else ""))
    return "✕ pixels that are not finite: " + "; ".join(parts)
