"""What becomes of marched rays and what that costs, for the page and in words."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from lightmeter.reports.cells import measured
from lightmeter.reports.results import RayError, RayPart
from lightmeter.reports.shown_names import printable
from lightmeter.reports.significant import show_number


@dataclass(frozen=True)
class Fate:
    """Where a ray ends.

    Attributes:
        verdict: its key in `RayError.parts`.
        label: in words.
        meaning: a sentence or two.
    """

    verdict: str
    label: str
    meaning: str


FATES = (
    Fate("wrong", "wrong hit", "It met a surface, but what it should have met the camera does not see."),
    Fate("met", "other light", "What it should have met is in the picture: lit or seen otherwise, or just missed."),
    Fate("left", "left the screen", "It left the picture, or came nearer than the camera sees; it shows the fallback."),
    Fate("hidden", "hidden behind something", "It passed behind what is seen and met nothing after that."),
    Fate("open", "in the open", "It went on in sight, or its steps ended, and it met nothing."),
    Fate("none", "no ray", "The surface mirrors nothing: what is wrong is light from all around."),
)
_LEAST = 0.01
"""Smaller shares are left out of the line in the terminal."""


def ray_content(rays: Sequence[RayError]) -> dict[str, Any] | None:
    """A row per effect: its RMSE, and each fate's share of its squared error; None where no effect marches rays."""
    if not rays:
        return None
    return {
        "columns": [{"label": fate.label, "definition": fate.meaning} for fate in FATES],
        "rows": [
            {
                "effect": error.effect,
                "rmse": measured(error.rmse),
                "cells": [_cell(error.parts[fate.verdict]) for fate in FATES],
            }
            for error in rays
        ],
    }


def ray_line(error: RayError) -> tuple[str, str]:
    """The fates that cost most, the largest first: whose rays they are, and the line."""
    told = [(error.parts[fate.verdict].share.value, fate.label) for fate in FATES]
    words = [f"{label} {_percent(share)} %" for share, label in sorted(told, reverse=True) if share >= _LEAST]
    return f"rays of {printable(error.effect)}", ", ".join(words) or "no error that can be told from noise"


def _cell(part: RayPart) -> dict[str, Any] | None:
    """The share in percent, with its interval and the pixels in the remarks; None where there are none."""
    share = part.share
    if math.isnan(share.value) or not part.pixels:
        return None
    interval = "" if share.low is None or share.high is None else f"{_percent(share.low)} to {_percent(share.high)} %; "
    pixels = f"{part.pixels:,} {'pixel' if part.pixels == 1 else 'pixels'}"
    return measured(share) | {
        "value": _percent(share.value),
        "interval": "%",
        "remarks": f"{interval}{pixels}; {share.how}",
    }


def _percent(share: float) -> str:
    """In percent; 0 where two digits do not show it."""
    return "0" if abs(share) < 5e-5 else show_number(100 * share, 2)
