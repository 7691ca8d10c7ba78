"""A measured figure, and a table of them for the terminal."""

from collections.abc import Iterable
from dataclasses import dataclass

from rich import box
from rich.table import Table
from rich.text import Text

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.significant import show_number


@dataclass(frozen=True)
class Figure:
    """One number.

    Attributes:
        what: what was measured.
        value: in `unit`.
        aim: the value that it should not exceed; None where there is no aim.
        note: how it was obtained, or how sure it is.
    """

    what: str
    value: float
    unit: str
    aim: float | None = None
    note: str = ""

    @classmethod
    def of(cls, what: str, measurement: Measurement, aim: float | None = None) -> "Figure":
        """A figure from a metric, its interval in the note."""
        parts = []
        if measurement.low is not None and measurement.high is not None:
            parts.append(f"{show_number(measurement.low)} … {show_number(measurement.high)}")
        if measurement.corrected is not None:
            parts.append(f"corrected for noise {show_number(measurement.corrected)}")
        return cls(what, measurement.value, measurement.unit, aim, "; ".join(parts))


def table(title: str, figures: Iterable[Figure]) -> Table:
    """A row per figure; those that meet their aim are green, the others yellow."""
    made = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    made.add_column("what")
    made.add_column("value", justify="right", no_wrap=True)
    made.add_column("aim", justify="right", no_wrap=True)
    made.add_column("note", style="dim")
    for figure in figures:
        style = "" if figure.aim is None else "green" if figure.value <= figure.aim else "yellow"
        value = Text(f"{show_number(figure.value)} {figure.unit}".strip(), style=style)
        aim = "" if figure.aim is None else f"≤ {show_number(figure.aim)}"
        made.add_row(Text(figure.what), value, aim, Text(figure.note))
    return made
