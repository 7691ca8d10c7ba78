"""Verdicts as one JSON document. A number that is not finite is text, as in results.json."""

import math
from collections.abc import Sequence
from typing import Any

from lightmeter.reports.verdict import Verdict


def to_document(verdicts: Sequence[Verdict]) -> dict[str, Any]:
    """The counts, and every verdict with how it was reached."""
    statuses = [verdict.status for verdict in verdicts]
    return {
        "passed": statuses.count("PASS"),
        "failed": statuses.count("FAIL"),
        "undecided": statuses.count("UNDECIDED"),
        "verdicts": [_entry(verdict) for verdict in verdicts],
    }


def _entry(verdict: Verdict) -> dict[str, Any]:
    measurement = verdict.measurement
    return {
        "name": verdict.name,
        "scene": verdict.scene,
        "of": verdict.of,
        "metric": verdict.metric,
        "limit": verdict.limit,
        "max": verdict.high,
        "min": verdict.low,
        "regression": verdict.regression,
        "status": verdict.status,
        **{k: _number(getattr(measurement, k, None)) for k in ("value", "low", "high")},
        "unit": measurement.unit if measurement else "",
        "samples": verdict.samples,
        "looks": verdict.looks,
        "error": verdict.error,
        "pixels": verdict.pixels,
        "seconds": round(verdict.seconds, 3),
        "reason": verdict.reason,
        "message": verdict.message,
    }


def _number(value: float | None) -> float | str | None:
    if value is None or math.isfinite(value):
        return value
    return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"
