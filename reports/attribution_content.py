"""Where the error comes from, as the page shows it: shares beside milliseconds, and what to fix first."""

import math
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.cells import measured, share_of_width, terms_with_meaning, timed
from lightmeter.reports.fix_first import fix_first
from lightmeter.reports.metric_words import definition, error_phrase
from lightmeter.reports.percentages import percent_of
from lightmeter.reports.pictures import share_map_name
from lightmeter.reports.results import Attribution, Player, Results, Timing
from lightmeter.reports.signed_bars import Axis
from lightmeter.reports.significant import show_measurement, show_number


def attribution_content(results: Results, shown: set[str]) -> list[dict[str, Any]]:
    """A panel per metric; empty where nothing was attributed. `shown` are the names of the pairs in the viewer."""
    wholes = {"Whole frame": results.attribution, "Display chain": results.display_attribution}
    return [
        _panel(results, attribution, metric, shown, whole)
        for whole, attribution in wholes.items()
        if attribution is not None
        for metric in attribution.total
    ]


def _panel(results: Results, attribution: Attribution, metric: str, shown: set[str], whole: str) -> dict[str, Any]:
    total = attribution.total[metric]
    parts = [player.share[metric] for player in attribution.players if metric in player.share]
    residual = attribution.residual.get(metric)
    axis = Axis.spanning([*parts, total, *([residual] if residual else [])])
    times = {effect.effect: effect.time_ms for effect in results.effects}
    slowest = max((time.median for time in times.values() if time and math.isfinite(time.median)), default=0.0)
    rows = [
        _row(player, total, metric, axis, times.get(player.name), slowest, shown)
        for player in attribution.players
        if metric in player.share
    ]
    error = error_phrase(metric)
    title = error[0].upper() + error[1:] if attribution is results.attribution else f"Display: {error}"
    return {
        "metric": metric,
        "title": title,
        "whole": whole,
        "definition": definition(metric),
        "rows": rows,
        "unexplained": _share(residual, total, axis) if residual else None,
        "total": _share(total, total, axis) | {"in_unit": show_measurement(total)},
        "frame_time": timed(results.frame.time_ms if attribution is results.attribution else None),
        "compensates": any(part.value < 0 for part in parts),
        "advice": [
            {"verdict": advice.verdict, "sentence": advice.sentence}
            for advice in fix_first(results, attribution, metric)
        ],
        "effort": _effort(attribution, metric),
    }


def _row(
    player: Player,
    total: Measurement,
    metric: str,
    axis: Axis,
    time: Timing | None,
    slowest: float,
    shown: set[str],
) -> dict[str, Any]:
    return _share(player.share[metric], total, axis) | {
        "name": player.name,
        "has_pair": player.name in shown,
        "map": share_map_name(metric),
        "terms": terms_with_meaning(player.terms),
        "approximated": player.approximated,
        "time": timed(time),
        "time_bar": share_of_width(time.median, slowest) if time else 0.0,
    }


def _share(share: Measurement, total: Measurement, axis: Axis) -> dict[str, Any]:
    """Percentage and bar; in the metric's unit where the total cannot be told from 0. The tooltip has the unit."""
    cell = measured(percent_of(share, total) or share)
    in_unit = show_measurement(share)
    return {
        "cell": cell | {"remarks": "; ".join(part for part in (in_unit, share.how) if part)},
        "bar": axis.bar(share),
    }


def _effort(attribution: Attribution, metric: str) -> str:
    """How many sets of exact players were looked at, and what one cost."""
    seconds = attribution.seconds_per_subset.get(metric)
    cost = "" if seconds is None else f", at {_duration(seconds)} a set"
    if attribution.exhaustive:
        return f"The frame's error was measured for all {attribution.subsets} sets of exact parts{cost}."
    return (
        f"The frame's error was measured for {attribution.subsets} sets of exact parts, drawn as random orders{cost}: "
        "all of them would be too many."
    )


def _duration(seconds: float) -> str:
    return f"{show_number(1000 * seconds)} ms" if seconds < 1 else f"{show_number(seconds)} s"
