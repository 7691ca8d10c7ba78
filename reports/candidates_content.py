"""Engines side by side, as the page shows them: texts and positions, no markup."""

from collections.abc import Sequence
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.candidate_words import (
    COLUMNS,
    LAYER_COLUMNS,
    definition_words,
    fault_name,
    fault_status,
    is_ours,
    layer_pair_name,
    masked_words,
    not_finite,
    pair_name,
    pixel_words,
    remedies,
    time_as_measured,
    time_words,
)
from lightmeter.reports.cells import measured, named, terms_with_meaning
from lightmeter.reports.engine_plot import engine_mark, engine_plot
from lightmeter.reports.metric_words import beside_the_mean, error_phrase, present
from lightmeter.reports.percentages import percent_of
from lightmeter.reports.results import Attribution, Candidate, LayerError, Metrics, Results
from lightmeter.reports.shown_names import printable, printable_lines, short_name
from lightmeter.reports.signed_bars import Axis
from lightmeter.reports.significant import show_measurement

_PLOTTED = ("rmse", "flip")
_MOST_REASONS = 4
_LONGEST_MAKER = 60


def candidates_content(results: Results, shown: set[str]) -> dict[str, Any] | None:
    """None where no engine was handed in; `shown` are the names of the pairs in the viewer."""
    candidates = results.candidates
    if not candidates and not results.failed_candidates:
        return None
    names = [name for candidate in candidates for name in candidate.metrics]
    columns = present(COLUMNS, names)
    axis = Axis.spanning(one.metrics["rmse"] for one in candidates if "rmse" in one.metrics)
    plots = [engine_plot(candidates, metric) for metric in present(_PLOTTED, names)]
    marks = [engine_mark(place, candidate) for place, candidate in enumerate(candidates)]
    return {
        "pixels": pixel_words(candidates, results.size),
        "columns": [named(name) for name in columns],
        "rows": [_row(one, mark, columns, axis, shown) for one, mark in zip(candidates, marks, strict=True)],
        "plots": [plot for plot in plots if plot],
        "findings": [_findings(one, mark) for one, mark in zip(candidates, marks, strict=True) if one.findings],
        "layers": [_layers(one, mark, shown) for one, mark in zip(candidates, marks, strict=True) if one.layers],
        "definitions": [{"name": _name(one), "words": definition_words(one)} for one in candidates if one.truths],
        "notes": [
            {"name": _name(one), "notes": [printable(note) for note in one.notes]} for one in candidates if one.notes
        ],
        "failed": [
            {"name": short_name(one.name), "why": printable_lines(one.why)} for one in results.failed_candidates
        ],
    }


def _name(candidate: Candidate) -> dict[str, Any]:
    """What it is called, and in full where that was cut."""
    short = short_name(candidate.name)
    return {"short": short, "full": candidate.name if short != candidate.name else "", "ours": is_ours(candidate)}


def _row(
    candidate: Candidate, mark: dict[str, Any], columns: Sequence[str], axis: Axis, shown: set[str]
) -> dict[str, Any]:
    masked = masked_words(candidate)
    rmse = candidate.metrics.get("rmse")
    made_by = [short_name(text, _LONGEST_MAKER) for text in (candidate.engine, candidate.device) if text]
    return {
        "name": _name(candidate),
        "mark": mark,
        "pair": pair_name(candidate) if pair_name(candidate) in shown else "",
        "made_by": " · ".join(made_by),
        "not_finite": not_finite(candidate),
        "cells": {name: _cell(name, candidate.metrics) for name in columns},
        "bar": axis.bar(rmse) if rmse else None,
        "time": _time(candidate),
        "reasons": masked[:_MOST_REASONS],
        "more_reasons": masked[_MOST_REASONS:],
    }


def _cell(name: str, metrics: Metrics) -> dict[str, Any] | None:
    if name not in metrics:
        return None
    return measured(metrics[name]) | {"tail": beside_the_mean(name, metrics)}


def _time(candidate: Candidate) -> dict[str, Any] | None:
    """Milliseconds, and below them who measured them and what they hold."""
    timing = candidate.time_ms
    if timing is None:
        return None
    spread = f"median over {timing.frames} frames, ± median absolute deviation" if timing.frames > 1 else "one run"
    return measured(time_as_measured(timing)) | {"unit": "", "remarks": spread, "tail": time_words(candidate)}


def _findings(candidate: Candidate, mark: dict[str, Any]) -> dict[str, Any]:
    return {
        "name": _name(candidate),
        "mark": mark,
        "corrected": all(finding.corrected for finding in candidate.findings),
        "faults": [
            {
                "fault": fault_name(finding),
                "words": printable(finding.words),
                "status": fault_status(finding),
                "corrected": finding.corrected,
            }
            for finding in candidate.findings
        ],
        "remedies": remedies(candidate.findings),
    }


def _layers(candidate: Candidate, mark: dict[str, Any], shown: set[str]) -> dict[str, Any]:
    """A row per buffer; the shares of the frame's error beside them, with rows for those that no buffer has."""
    columns = present(LAYER_COLUMNS, [name for layer in candidate.layers for name in layer.metrics])
    attribution = candidate.attribution
    metric = next(iter(attribution.total), "") if attribution else ""
    shares = _shares(attribution, metric) if attribution and metric else {}
    owners = {layer.layer: _player_of(layer, candidate.layers, shares) for layer in candidate.layers}
    axis = Axis.spanning(shares.values())
    return {
        "name": _name(candidate),
        "mark": mark,
        "columns": [named(name) for name in columns],
        "shared": error_phrase(metric) if shares else "",
        "rows": [
            {
                "layer": short_name(layer.layer),
                "pair": layer_pair_name(candidate, layer) if layer_pair_name(candidate, layer) in shown else "",
                "term": terms_with_meaning((layer.term,))[0],
                "cells": [_cell(name, layer.metrics) for name in columns],
                "pixels": f"{layer.pixels:,}",
                "share": _share(shares, owners[layer.layer], axis),
            }
            for layer in candidate.layers
        ],
        "rest": [
            {"name": short_name(name), "remark": _why_apart(name, candidate), "share": _share(shares, name, axis)}
            for name in shares
            if name not in owners.values()
        ],
        "total": show_measurement(attribution.total[metric]) if attribution and shares else "",
    }


def _shares(attribution: Attribution, metric: str) -> dict[str, Measurement]:
    """Player to its share, then what is unexplained; in percent where the frame's error can be told from 0."""
    found = {player.name: player.share[metric] for player in attribution.players if metric in player.share}
    if metric in attribution.residual:
        found["unexplained"] = attribution.residual[metric]
    total = attribution.total[metric]
    return {name: percent_of(share, total) or share for name, share in found.items()}


def _player_of(layer: LayerError, layers: Sequence[LayerError], shares: dict[str, Measurement]) -> str:
    """The player that the layer is: the one of its name, else of its term if no other layer has that; "" for none."""
    if layer.layer in shares:
        return layer.layer
    alone = sum(other.term == layer.term for other in layers) == 1
    return layer.term if alone and layer.term in shares else ""


def _why_apart(name: str, candidate: Candidate) -> str:
    """Why a player is not one of the layers."""
    if any(layer.term == name for layer in candidate.layers):
        return "its layers together"
    players = candidate.attribution.players if candidate.attribution else ()
    return "no layer" if any(player.name == name for player in players) else ""


def _share(shares: dict[str, Measurement], name: str, axis: Axis) -> dict[str, Any] | None:
    return {"cell": measured(shares[name]), "bar": axis.bar(shares[name])} if name in shares else None
