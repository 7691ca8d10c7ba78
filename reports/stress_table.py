"""A stress run as tables for the terminal, made of rich's renderables; the caller prints them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lightmeter.realtime.stress.findings import FORMATS, Example, Stressed
from lightmeter.realtime.stress.regimes import REGIMES
from lightmeter.reports.stress_results import SHORT, StressResults, command, inherent, shown, words

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

FEW = 3.0
"""Digits below which a cell stands out: a thousandth."""


def stress_tables(results: StressResults, form: str = "fp32") -> Group:
    """The grid of function and regime, what its columns mean, and safe domains."""
    from rich.console import Group
    from rich.text import Text

    regimes = [r for r in REGIMES if any(r in f.cells[form] for f in results.functions)]
    legend = "; ".join(f"{SHORT[r]}: {REGIMES[r]}" for r in regimes)
    parts = [_grid(results, regimes, form), Text(f"Digits kept (~: lost to the inputs' own rounding). {legend}")]
    parts += [Text()] + [Text(line) for f in results.functions if (line := safe_domain(f))]
    return Group(*parts)


def safe_domain(function: Stressed) -> str:
    """Where 1 % is kept, in words; "" where neither α nor a cosine is among the arguments."""
    clauses = [
        f"nowhere over all {name}" if least is None else f"down to {name} = {least:.2g}"
        for name, least in function.safe.items()
    ]
    return f"{function.name} keeps 1 % {', '.join(clauses)}" if clauses else ""


def input_table(name: str, examples: dict[str, Example]) -> Table:
    """One input in every format."""
    from rich.table import Table

    example = examples["fp32"]
    table = Table(title=f"{name} at {words(example.inputs)}", title_justify="left")
    for column in ("format", "got", "exact (float64)", "relative error", "digits", "attainable"):
        table.add_column(column)
    for form, found in examples.items():
        got, exact = (", ".join(f"{v:.9g}" for v in values) for values in (found.got, found.exact))
        table.add_row(form, got, exact, f"{found.relative:.3g}", f"{found.digits:.1f}", f"{found.attainable:.1f}")
    return table


def _grid(results: StressResults, regimes: list[str], form: str) -> Table:
    from rich.table import Table
    from rich.text import Text

    table = Table(title=f"{form}: {FORMATS[form]}", title_justify="left", box=None, padding=(0, 1, 0, 0))
    table.add_column("function", no_wrap=True)
    for regime in regimes:
        table.add_column(SHORT[regime], no_wrap=True, justify="right", min_width=3)
    owner = ""
    for function in results.functions:
        before, owner = owner, function.name.partition("/")[0]
        if owner != before:
            table.add_row(Text(owner, style="bold"))
        name = "  " + function.name.partition("/")[2]
        table.add_row(name, *(_cell(function.cells[form].get(regime)) for regime in regimes))
    return table


def _cell(cell) -> Text:
    from rich.text import Text

    if cell is None:
        return Text("")
    text = shown(cell)
    if cell.fault:
        return Text(text, style="bold red")
    return (
        Text("~" + text[0], style="dim")
        if inherent(cell) and cell.digits < FEW
        else Text(text, style="yellow" if cell.digits < FEW else "")
    )


def fault_lines(results: StressResults, form: str = "fp32") -> list[str]:
    """For each function and regime that is not finite or wrongly negative: how often, and the command that shows it."""
    lines = []
    for function in results.functions:
        for regime, cell in function.cells[form].items():
            if cell.fault:
                count = f"{cell.fault} at {cell.counts[cell.fault]} of {cell.lanes} inputs"
                again = command(function.name, cell.faults[cell.fault])
                lines.append(f"✕ {function.name}, {regime}: {count}: {again}")
    return lines
