"""Verdicts as a table for the terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from lightmeter.reports.significant import show_measurement, show_number
from lightmeter.reports.verdict import Verdict

if TYPE_CHECKING:
    from rich.table import Table

STYLES = {"PASS": "green", "FAIL": "bold red", "UNDECIDED": "yellow"}


def verdict_table(verdicts: Sequence[Verdict]) -> Table:
    """A row per limit. Names come from scene files, so every cell is plain `Text`."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("verdict", no_wrap=True)
    table.add_column("of", overflow="fold")
    table.add_column("limit", overflow="fold")
    table.add_column("measured", overflow="fold")
    for name in ("samples", "looks", "pixels", "s"):
        table.add_column(name, justify="right", no_wrap=True)
    for v in verdicts:
        table.add_row(
            Text(v.status, style=STYLES[v.status]),
            Text(f"{v.scene}/{v.of}" if v.scene else v.name),
            Text(str(v.limit)),
            Text(shown(v)),
            Text(str(v.samples)),
            Text(str(v.looks)),
            Text("" if v.pixels is None else str(v.pixels)),
            Text(f"{v.seconds:.1f}"),
        )
    return table


def shown(verdict: Verdict) -> str:
    """What was measured; a value without an interval as exactly as a limit may be written."""
    measurement = verdict.measurement
    if measurement is None:
        return "not judged"
    if measurement.low is None:
        return f"{show_number(measurement.value, 5)} {measurement.unit}".strip()
    return show_measurement(measurement)
