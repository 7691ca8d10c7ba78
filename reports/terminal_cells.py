"""Numbers and sentences as rich's plain texts, for the terminal; nothing in them is read as markup."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.results import Timing
from lightmeter.reports.significant import show_interval, show_measurement, show_value

if TYPE_CHECKING:
    from rich.text import Text


def full(measurement: Measurement | None) -> Text:
    from rich.text import Text

    if measurement is None:
        return Text("–", style="dim")
    if math.isnan(measurement.value):  # an infinite PSNR is a perfect one
        return Text(f"✕ {show_measurement(measurement)}", style="bold red")
    return Text(show_measurement(measurement))


def bare(measurement: Measurement | None) -> Text:
    """The same without its unit, which the caption names."""
    return full(None if measurement is None else replace(measurement, unit=""))


def number(measurement: Measurement | None) -> Text:
    from rich.text import Text

    if measurement is None:
        return Text("–", style="dim")
    failed = math.isnan(measurement.value)
    return Text(("✕ " if failed else "") + show_value(measurement), style="bold red" if failed else "")


def milliseconds(timing: Timing | None) -> Text:
    from rich.text import Text

    if timing is None:
        return Text("–", style="dim")
    measured = Measurement(timing.median, timing.median - timing.mad, timing.median + timing.mad)
    return Text(" ".join(part for part in (show_value(measured), show_interval(measured)) if part))


def reason(kind: str, what: str, why: str = "") -> Text:
    from rich.text import Text

    return Text.assemble((f"{kind}: ", "dim"), what, (f": {why}" if why else "", "dim"))
