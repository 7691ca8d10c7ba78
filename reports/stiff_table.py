"""Stiff scenes as a table for the terminal; the caller prints it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from rich.table import Table


class Found(Protocol):
    """What became of a scene; figures are over the mean of the reference, None: without meaning."""

    name: str
    error: float | None
    noise: float | None
    frame_changed: float | None
    truth_changed: float | None
    blame: tuple[tuple[str, float], ...]
    words: str
    refused: bool
    finite: bool


def stiff_table(findings: Sequence[Found]) -> Table:
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
        finite = "refused" if found.refused else "yes" if found.finite else "NO"
        figures = (found.error, found.noise, found.frame_changed, found.truth_changed)
        said = [found.words] if found.words else []
        if found.blame and found.blame[0][1] >= 1e-3:
            said.append("changed: " + ", ".join(f"{name} {_percent(share)} %" for name, share in found.blame))
        table.add_row(found.name, finite, *map(_percent, figures), Text("; ".join(said)))
    return table


def _percent(share: float | None) -> str:
    return "" if share is None else f"{100 * share:.3g}"
