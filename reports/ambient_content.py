"""How far ambient visibility is from each of its truths, for the page and in words."""

from collections.abc import Sequence
from typing import Any

from lightmeter.reports.cells import measured, named
from lightmeter.reports.results import AmbientError
from lightmeter.reports.shown_names import printable
from lightmeter.reports.significant import show_measurement

COLUMNS = ("rmse", "relative_bias")


def ambient_content(errors: Sequence[AmbientError]) -> dict[str, Any] | None:
    """A row per truth; None where no effect gives the environment's visibility."""
    if not errors:
        return None
    return {
        "columns": [named(name) for name in COLUMNS],
        "rows": [
            {
                "effect": error.effect,
                "truth": truth_in_words(error),
                "cells": [measured(error.metrics[name]) for name in COLUMNS],
            }
            for error in errors
        ],
    }


def truth_in_words(error: AmbientError) -> str:
    """What it is held against."""
    if error.truth == "term":
        return "occluded over unoccluded radiance (the term)"
    return "open directions" if error.radius is None else f"open directions within {error.radius:g} m"


def ambient_line(errors: Sequence[AmbientError]) -> tuple[str, str]:
    """Every truth with its RMSE: whose they are, and the line."""
    parts = [f"{truth_in_words(error)} {show_measurement(error.metrics['rmse'])}" for error in errors]
    return f"{printable(errors[0].effect)} against", ", ".join(parts)
