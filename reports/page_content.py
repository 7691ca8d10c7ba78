"""The report's numbers as the page shows them: texts and positions of bars, no markup."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.ambient_content import ambient_content
from lightmeter.reports.attribution_content import attribution_content
from lightmeter.reports.bounce_content import bounce_content
from lightmeter.reports.candidates_content import candidates_content
from lightmeter.reports.cells import measured, named, share_of_width, terms_with_meaning, timed
from lightmeter.reports.closure import closure_statement
from lightmeter.reports.metric_words import beside_the_mean, in_order, label, present
from lightmeter.reports.object_content import object_content
from lightmeter.reports.percentages import percent_of
from lightmeter.reports.ray_content import ray_content
from lightmeter.reports.reasons import by_reason
from lightmeter.reports.results import Effect, Metrics, Results, Timing
from lightmeter.reports.shadow_content import shadow_content
from lightmeter.reports.significant import show_number
from lightmeter.reports.truth_words import truth_name, truth_words

_HEADLINE = ("nrmse", "rmse", "flip", "flip_hdr", "ssim")
_EFFECT_COLUMNS = ("flip", "flip_hdr", "ssim")
_HEADLINE_TILES = 4


def page_content(results: Results, shown: set[str]) -> dict[str, Any]:
    """Everything of the page but the pictures; `shown` are the names of the pairs in the viewer."""
    return {
        "scene": results.scene,
        "subtitle": _subtitle(results),
        "failures": _failures(results),
        "tiles": _tiles(results),
        "closure": _closure(results),
        "candidates": candidates_content(results, shown),
        "attribution": attribution_content(results, shown),
        "objects": object_content(results.objects),
        "shadows": shadow_content(results.shadows),
        "rays": ray_content(results.rays),
        "ambient": ambient_content(results.ambient),
        "bounces": bounce_content(results.bounces),
        "effects": _effects(results, shown),
        "matrix": _matrix(results),
        "timing": _timing_chart(results),
        "left_out": [{"what": ", ".join(what), "why": why} for why, what in by_reason(results.left_out).items()],
        "not_approximated": terms_with_meaning(results.not_approximated),
        "notes": list(results.notes),
        "reference": _reference(results),
        "device": _flat(results.device),
        "schema": results.schema,
    }


def _subtitle(results: Results) -> str:
    parts = [f"{results.size[0]} × {results.size[1]} pixels"]
    if results.reference:
        parts.append(f"{results.reference.spp} samples per pixel in {results.reference.batches} batches")
    return " · ".join(parts) + truth_words(results.reference)


def _failures(results: Results) -> list[str]:
    """One sentence per tested image that holds pixels which are not finite."""
    bad = results.nonfinite
    found = [("the frame", bad.frame, bad.where.get("frame", ()))] if bad.frame else []
    found += [(f"effect {name}", count, bad.where.get(name, ())) for name, count in bad.effects.items() if count]
    sentences = []
    for what, count, places in found:
        where = ", ".join(f"({x}, {y})" for x, y in places[:4])
        noun = "pixel is" if count == 1 else "pixels are"
        sentences.append(f"{count} {noun} not finite in {what}" + (f": first at {where}" if where else ""))
    return sentences


def _tiles(results: Results) -> list[dict[str, Any]]:
    metrics = results.frame.metrics
    names = present(_HEADLINE, metrics) or in_order(metrics)
    tiles = []
    for name in names[:_HEADLINE_TILES]:
        tile = named(name) | _with_tail(name, metrics)
        floor = metrics[name].floor
        if not tile["interval"] and floor is not None:
            tile["interval"] = f"noise floor {show_number(floor)}"
        tiles.append(tile)
    time = timed(results.frame.time_ms)
    if time:
        tiles.append(
            {
                "label": "Frame time",
                "definition": "Time of one real-time frame on this machine.",
                "value": time["value"],
                "interval": time["spread"],
                "unit": "ms",
                "failed": time["failed"],
                "remarks": time["remarks"],
                "tail": "",
            }
        )
    return tiles


def _closure(results: Results) -> dict[str, Any] | None:
    if results.closure is None:
        return None
    statement = closure_statement(results.closure)
    metrics = results.closure.metrics
    return {
        "verdict": statement.verdict,
        "sentence": statement.sentence,
        "how": results.closure.bias.how,
        "metrics": [named(name) | measured(metrics[name]) for name in in_order(metrics)],
    }


def _effects(results: Results, shown: set[str]) -> dict[str, Any] | None:
    """The table of effects, with the frame as its last row."""
    if not results.effects:
        return None
    names = [name for effect in results.effects for name in effect.metrics]
    columns = present(_EFFECT_COLUMNS, names)
    ends = _bar_ends(results)
    shared = next((name for effect in results.effects for name in effect.share), "")
    shares = _shares(results, shared)
    rows = [_effect_row(effect, columns, ends, shares.get(effect.effect), shown) for effect in results.effects]
    frame = Effect("frame", (), {}, results.frame.metrics, results.frame.time_ms)
    rows.append(_effect_row(frame, columns, ends, None, shown) | {"is_frame": True})
    return {
        "columns": [named(name) for name in columns],
        "rmse": named("rmse"),
        "share": label(shared),
        "rows": rows,
    }


def _effect_row(
    effect: Effect,
    columns: Sequence[str],
    ends: Mapping[str, float],
    share: Measurement | None,
    shown: set[str],
) -> dict[str, Any]:
    rmse = effect.metrics.get("rmse")
    return {
        "name": effect.effect,
        "is_frame": False,
        "has_pair": effect.effect in shown,
        "terms": terms_with_meaning(effect.terms),
        "rmse": _with_tail("rmse", effect.metrics) if rmse else None,
        "bar": _bar(rmse, ends) if rmse else None,
        "cells": [_with_tail(name, effect.metrics) if name in effect.metrics else None for name in columns],
        "time": timed(effect.time_ms),
        "baked": None if effect.bake_ms is None else show_number(effect.bake_ms),
        "share": measured(share) if share else None,
        "knobs": [f"{name} {_knob(value)}" for name, value in effect.knobs.items()] + stored_bytes(effect),
    }


def stored_bytes(effect: Effect) -> list[str]:
    """What it stores takes, in words; nothing where it stores none."""
    return [] if effect.bytes_per_pixel is None else [f"{effect.bytes_per_pixel} bytes per pixel"]


def _shares(results: Results, metric: str) -> dict[str, Measurement]:
    """Effect to its share of the frame's error, in percent where that error can be told from 0."""
    totals = results.attribution.total if results.attribution else results.frame.metrics
    total = totals.get(metric)
    found = {effect.effect: effect.share[metric] for effect in results.effects if metric in effect.share}
    return {name: (percent_of(share, total) if total else None) or share for name, share in found.items()}


def _with_tail(name: str, metrics: Metrics) -> dict[str, Any]:
    """The metric's cell, with the percentiles and the worst tile that go with it."""
    return measured(metrics[name]) | {"tail": beside_the_mean(name, metrics)}


def _knob(value: Any) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _bar_ends(results: Results) -> dict[str, float]:
    """Unit to the largest value that a bar in this unit must show, for units that two rows or more share."""
    found = [results.frame.metrics.get("rmse"), *(effect.metrics.get("rmse") for effect in results.effects)]
    finite = [rmse for rmse in found if rmse is not None and math.isfinite(rmse.value)]
    units = [rmse.unit for rmse in finite]
    ends: dict[str, float] = {}
    for rmse in finite:
        high = rmse.high if rmse.high is not None and math.isfinite(rmse.high) else rmse.value
        if units.count(rmse.unit) > 1:
            ends[rmse.unit] = max(ends.get(rmse.unit, 0.0), rmse.value, high)
    return ends


def _bar(measurement: Measurement, ends: Mapping[str, float]) -> dict[str, float] | None:
    """Bar and interval in percent of the column; None where there is nothing to compare with."""
    end = ends.get(measurement.unit)
    if end is None or not math.isfinite(measurement.value):
        return None
    bar = {"value": share_of_width(measurement.value, end)}
    if measurement.low is not None and measurement.high is not None:
        bar |= {"low": share_of_width(measurement.low, end), "high": share_of_width(measurement.high, end)}
    return bar


def _matrix(results: Results) -> dict[str, Any] | None:
    """Every metric of everything; None where the headline has already shown them all."""
    rows = [("frame", results.frame.metrics)] + [(effect.effect, effect.metrics) for effect in results.effects]
    names = in_order(name for _, metrics in rows for name in metrics)
    if not names or (len(rows) == 1 and len(names) <= 1):
        return None
    return {
        "columns": [named(name) for name in names],
        "rows": [
            {
                "name": name,
                "cells": [measured(metrics[column]) if column in metrics else None for column in names],
            }
            for name, metrics in rows
        ],
    }


def _timing_chart(results: Results) -> dict[str, Any] | None:
    """A bar per pass, and one for what the frame took beyond its passes."""
    if not results.passes:
        return None
    frame = results.frame.time_ms
    finite = [item.median + item.mad for item in results.passes if math.isfinite(item.median + item.mad)]
    total = sum(item.median for item in results.passes if math.isfinite(item.median))
    rest = frame.median - total if frame and math.isfinite(frame.median) else 0.0
    end = max([*finite, rest, 1e-9])
    frames = frame.frames if frame else 0
    bars = []
    for item in results.passes:
        bars.append(
            {
                "name": item.name,
                "effect": item.effect,
                "value": share_of_width(item.median, end),
                "low": share_of_width(item.median - item.mad, end),
                "high": share_of_width(item.median + item.mad, end),
                "time": timed(Timing(item.median, item.mad, frames)),
            }
        )
    return {
        "bars": bars,
        "total": show_number(total),
        "frame": timed(frame),
        "rest": {"value": share_of_width(rest, end), "text": show_number(rest)} if rest > 0.01 * total else None,
    }


def _reference(results: Results) -> list[tuple[str, str]]:
    reference = results.reference
    if reference is None:
        return []
    return [
        ("Truth", truth_name(reference.truth)),
        ("Samples per pixel", str(reference.spp)),
        ("Independent batches", str(reference.batches)),
        ("Rendering time", f"{show_number(reference.seconds)} s"),
        ("Origin", "taken from the store" if reference.cached else "rendered for this report"),
    ]


def _flat(mapping: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    """Nested entries as (name, text) rows."""
    rows = []
    for key, value in mapping.items():
        name = f"{prefix}{str(key).replace('_', ' ')}"
        if isinstance(value, Mapping):
            rows += _flat(value, f"{name} · ")
        elif isinstance(value, (list, tuple)):
            rows.append((name, ", ".join(map(str, value))))
        else:
            rows.append((name, "—" if value is None else str(value)))
    return rows
