"""What kind of mistake each light's shadow makes, for the page and in words."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.cells import measured
from lightmeter.reports.results import LightShadow
from lightmeter.reports.shown_names import printable
from lightmeter.reports.significant import show_number


@dataclass(frozen=True)
class Mistake:
    """A kind of mistake in one place.

    Attributes:
        kind, place: its keys in `LightShadow.parts`.
        where: the place in words.
        likely: what it mostly is, in the field's own word; "" where there is none.
        meaning: a sentence or two.
    """

    kind: str
    place: str
    where: str
    likely: str
    meaning: str


KINDS = {"lit": "too light", "dark": "too dark"}
EDGE = "Up to 2 pixels from the true shadow's edge, or within its penumbra: resolution and filter."
MISTAKES = (
    Mistake("lit", "edge", "at the edge", "", EDGE),
    Mistake(
        "lit",
        "contact",
        "at a contact",
        "peter-panning",
        "Up to 8 pixels from what touches the surface: a bias has let the shadow come loose.",
    ),
    Mistake("lit", "near", "near an edge", "", "Up to 8 pixels from the shadow's edge: a filter too wide, or a leak."),
    Mistake(
        "lit",
        "away",
        "deep in shadow",
        "leak",
        "Farther from every edge: light bled through what blocks it, or that is missing from the map.",
    ),
    Mistake("dark", "edge", "at the edge", "", EDGE),
    Mistake(
        "dark",
        "contact",
        "at a contact",
        "",
        "Up to 8 pixels from what touches the surface: a corner that was taken for a shadow.",
    ),
    Mistake("dark", "near", "near an edge", "", "Up to 8 pixels from a shadow: a filter that spills."),
    Mistake(
        "dark",
        "away",
        "in full light",
        "acne",
        "Farther from every shadow: a surface that shadows itself; or the blur of one so thin that no pixel shows it.",
    ),
)
_LEAST = 0.01
"""Smaller shares are left out of the line in the terminal."""


def shadow_content(shadows: Sequence[LightShadow]) -> dict[str, Any] | None:
    """A row per light: its RMSE, and each mistake's share of its squared error; None where there are no shadows."""
    if not shadows:
        return None
    return {
        "groups": [
            {"title": words.capitalize(), "columns": sum(mistake.kind == kind for mistake in MISTAKES)}
            for kind, words in KINDS.items()
        ],
        "columns": [
            {"label": mistake.where, "likely": mistake.likely, "definition": mistake.meaning} for mistake in MISTAKES
        ],
        "rows": [
            {
                "light": shadow.light,
                "effect": shadow.effect,
                "rmse": measured(shadow.rmse),
                "cells": [_cell(shadow, mistake) for mistake in MISTAKES],
            }
            for shadow in shadows
        ],
    }


def shadow_line(shadow: LightShadow) -> tuple[str, str]:
    """The mistakes of a light's shadow, the largest first: whose it is, and the line."""
    parts = [(_share(shadow, mistake).value, mistake) for mistake in MISTAKES]
    told = sorted((part for part in parts if part[0] >= _LEAST), key=lambda part: -part[0])
    words = [
        f"{KINDS[mistake.kind]} {mistake.where}{f' ({mistake.likely}?)' if mistake.likely else ''} {_percent(share)} %"
        for share, mistake in told
    ]
    return f"shadow of {printable(shadow.light)}", ", ".join(words) or "no error that can be told from noise"


def _cell(shadow: LightShadow, mistake: Mistake) -> dict[str, Any] | None:
    """The share in percent, with its interval and how many pixels are wrong in the remarks; None where nothing is."""
    share, pixels = _share(shadow, mistake), shadow.parts[mistake.kind][mistake.place].pixels
    if math.isnan(share.value) or (share.value == 0 and not pixels):
        return None
    wrong = f"{pixels:,} {'pixel is' if pixels == 1 else 'pixels are'} off by more than a tenth of the light"
    shown = measured(share)
    interval = "" if share.low is None or share.high is None else f"{_percent(share.low)} to {_percent(share.high)} %; "
    return shown | {"value": _percent(share.value), "interval": "%", "remarks": f"{interval}{wrong}; {share.how}"}


def _share(shadow: LightShadow, mistake: Mistake) -> Measurement:
    return shadow.parts[mistake.kind][mistake.place].share


def _percent(share: float) -> str:
    """In percent; 0 where two digits do not show it."""
    return "0" if abs(share) < 5e-5 else show_number(100 * share, 2)
