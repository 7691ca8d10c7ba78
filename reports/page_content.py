"""The report's numbers as the page shows them: texts and positions of bars, no markup."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.closure import closure_statement
from lightmeter.reports.metric_words import definition, in_order, label, present
from lightmeter.reports.results import Effect, Results, Timing
from lightmeter.reports.significant import show_interval, show_number, show_value

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
        "effects": _effects(results, shown),
        "matrix": _matrix(results),
        "timing": _timing_chart(results),
        "left_out": [{"what": item.what, "why": item.why} for item in results.left_out],
        "not_approximated": [{"term": term, "meaning": _term_meaning(term)} for term in results.not_approximated],
        "notes": list(results.notes),
        "reference": _reference(results),
        "device": _flat(results.device),
        "schema": results.schema,
    }


def _subtitle(results: Results) -> str:
    parts = [f"{results.size[0]} × {results.size[1]} pixels"]
    if results.reference:
        parts.append(f"{results.reference.spp} samples per pixel in {results.reference.batches} batches")
    return " · ".join(parts)


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


def _measured(measurement: Measurement) -> dict[str, Any]:
    """Value, interval, unit and the remarks that stand in its tooltip."""
    remarks = [measurement.how]
    if measurement.floor is not None:
        remarks.append(f"noise floor {show_number(measurement.floor)}")
    if measurement.corrected is not None:
        remarks.append(f"corrected for noise {show_number(measurement.corrected)}")
    return {
        "value": show_value(measurement),
        "interval": show_interval(measurement),
        "unit": measurement.unit,
        "failed": math.isnan(measurement.value),  # an infinite PSNR is a perfect one
        "remarks": "; ".join(remark for remark in remarks if remark),
    }


def _named(name: str) -> dict[str, str]:
    return {"name": name, "label": label(name), "definition": definition(name)}


def _time(timing: Timing | None) -> dict[str, Any] | None:
    if timing is None:
        return None
    as_metric = Measurement(timing.median, timing.median - timing.mad, timing.median + timing.mad)
    spread = show_interval(as_metric) if math.isfinite(timing.mad) else ""
    return {
        "value": show_value(as_metric),
        "spread": spread,
        "failed": not math.isfinite(timing.median),
        "remarks": f"median over {timing.frames} frames, ± median absolute deviation",
    }


def _tiles(results: Results) -> list[dict[str, Any]]:
    metrics = results.frame.metrics
    names = present(_HEADLINE, metrics) or in_order(metrics)
    tiles = []
    for name in names[:_HEADLINE_TILES]:
        tile = _named(name) | _measured(metrics[name])
        floor = metrics[name].floor
        if not tile["interval"] and floor is not None:
            tile["interval"] = f"noise floor {show_number(floor)}"
        tiles.append(tile)
    time = _time(results.frame.time_ms)
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
        "metrics": [_named(name) | _measured(metrics[name]) for name in in_order(metrics)],
    }


def _effects(results: Results, shown: set[str]) -> dict[str, Any] | None:
    """The table of effects, with the frame as its last row."""
    if not results.effects:
        return None
    names = [name for effect in results.effects for name in effect.metrics]
    columns = present(_EFFECT_COLUMNS, names)
    ends = _bar_ends(results)
    shares = next((name for effect in results.effects for name in effect.share), None)
    rows = [_effect_row(effect, columns, ends, shares, shown) for effect in results.effects]
    frame = Effect("frame", (), {}, results.frame.metrics, results.frame.time_ms)
    rows.append(_effect_row(frame, columns, ends, shares, shown) | {"is_frame": True})
    return {
        "columns": [_named(name) for name in columns],
        "rmse": _named("rmse"),
        "share": label(shares) if shares else "",
        "rows": rows,
    }


def _effect_row(
    effect: Effect, columns: Sequence[str], ends: Mapping[str, float], shares: str | None, shown: set[str]
) -> dict[str, Any]:
    rmse = effect.metrics.get("rmse")
    share = effect.share.get(shares) if shares else None
    return {
        "name": effect.effect,
        "is_frame": False,
        "has_pair": effect.effect in shown,
        "terms": [{"term": term, "meaning": _term_meaning(term)} for term in effect.terms],
        "rmse": _measured(rmse) if rmse else None,
        "bar": _bar(rmse, ends) if rmse else None,
        "cells": [_measured(effect.metrics[name]) if name in effect.metrics else None for name in columns],
        "time": _time(effect.time_ms),
        "share": _measured(share) if share else None,
        "knobs": [f"{name} {_knob(value)}" for name, value in effect.knobs.items()],
    }


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
    bar = {"value": _percent(measurement.value, end)}
    if measurement.low is not None and measurement.high is not None:
        bar |= {"low": _percent(measurement.low, end), "high": _percent(measurement.high, end)}
    return bar


def _percent(value: float, end: float) -> float:
    return round(100 * min(1.0, max(0.0, value / end)), 2) if end > 0 and math.isfinite(value) else 0.0


def _matrix(results: Results) -> dict[str, Any] | None:
    """Every metric of everything; None where the headline has already shown them all."""
    rows = [("frame", results.frame.metrics)] + [(effect.effect, effect.metrics) for effect in results.effects]
    names = in_order(name for _, metrics in rows for name in metrics)
    if not names or (len(rows) == 1 and len(names) <= 1):
        return None
    return {
        "columns": [_named(name) for name in names],
        "rows": [
            {
                "name": name,
                "cells": [_measured(metrics[column]) if column in metrics else None for column in names],
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
                "value": _percent(item.median, end),
                "low": _percent(item.median - item.mad, end),
                "high": _percent(item.median + item.mad, end),
                "time": _time(Timing(item.median, item.mad, frames)),
            }
        )
    return {
        "bars": bars,
        "total": show_number(total),
        "frame": _time(frame),
        "rest": {"value": _percent(rest, end), "text": show_number(rest)} if rest > 0.01 * total else None,
    }


def _reference(results: Results) -> list[tuple[str, str]]:
    reference = results.reference
    if reference is None:
        return []
    return [
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


def _term_meaning(term: str) -> str:
    from lightmeter.scenes.terms import TERMS

    return TERMS[term].meaning if term in TERMS else ""
