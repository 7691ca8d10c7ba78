"""How much of the light that other surfaces scatter an effect recovers, for the page and in words."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.cells import measured
from lightmeter.reports.results import BounceShare
from lightmeter.reports.significant import show_interval, show_value

COLUMNS = {
    "share": ("recovered", "How much of the true light's own pattern is in the effect's: Σ t·R over Σ R·R."),
    "energy": ("energy", "Whether there is as much of it, wherever it lies: Σ t over Σ R."),
    "leaked": ("leaked", "What is too bright, over all that should be there: light that no surface sends here."),
    "missing": ("missing", "What is too dark, over all that should be there."),
}


def bounce_content(bounces: Sequence[BounceShare]) -> dict[str, Any] | None:
    """A row for each number of bounces; None where no effect is for them alone."""
    if not bounces:
        return None
    return {
        "effect": bounces[0].effect,
        "columns": [{"label": label, "definition": meaning} for label, meaning in COLUMNS.values()],
        "rows": [
            {
                "truth": which(bounce),
                "cells": [measured(_percent(getattr(bounce, name))) for name in COLUMNS],
                "rmse": measured(bounce.rmse),
            }
            for bounce in bounces
        ],
    }


def bounce_line(bounce: BounceShare) -> tuple[str, str]:
    """What an effect is held against, and what it recovers of that."""
    parts = []
    for name, (label, _) in COLUMNS.items():
        percent = _percent(getattr(bounce, name))
        parts.append(" ".join(part for part in (label, show_value(percent), "%", show_interval(percent)) if part))
    return f"{bounce.effect} against {which(bounce)}", ", ".join(parts)


def which(bounce: BounceShare) -> str:
    """The truth in words."""
    return {1: "one bounce", 2: "two bounces", None: "all bounces"}[bounce.bounces]


def _percent(part: Measurement) -> Measurement:
    low, high = (None if end is None else 100 * end for end in (part.low, part.high))
    return replace(part, value=100 * part.value, low=low, high=high)
