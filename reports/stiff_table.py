"""Stiff scenes as a table for the terminal; the caller prints it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from lightmeter.reports.stiff_results import Finding, blamed, state

if TYPE_CHECKING:
    from rich.table import Table


def stiff_table(findings: Sequence[Finding]) -> Table:
    """One row a scene; figures in per cent of the mean."""
    from rich.table import Table
    from rich.text import Text

    table = Table(
        title="Stiff scenes, in % of the reference's mean", title_justify="left", box=None, padding=(0, 1, 0, 0)
    )
    for column in ("scene", "finite"):
        table.add_column(column, no_wrap=True)
    for column in ("error", "noise", "frame changed", "truth changed"):
        table.add_column(column, justify="right")
    table.add_column("says", overflow="fold")
    for found in findings:
        finite = {"finite": "yes", "not finite": "NO"}.get(state(found), "refused")
        figures = (found.error, found.noise, found.frame_changed, found.truth_changed)
        said = [found.words] if found.words else []
        if changed := blamed(found):
            said.append("changed: " + ", ".join(f"{name} {_percent(share)} %" for name, share in changed))
        if found.lengths:
            said.append("in metres: " + ", ".join(found.lengths))
        table.add_row(found.name, finite, *map(_percent, figures), Text("; ".join(said)))
    return table


def _percent(share: float | None) -> str:
    return "" if share is None else f"{100 * share:.3g}"
