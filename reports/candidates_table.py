"""Engines side by side for the terminal: a table, then what has to be said of single engines.

The names and the messages are other people's, so every cell is plain `Text` of printable letters.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from lightmeter.reports.candidate_words import (
    COLUMNS,
    definition_words,
    fault_name,
    fault_status,
    is_ours,
    masked_words,
    not_finite,
    pixel_words,
    remedies,
    time_as_measured,
    time_words,
)
from lightmeter.reports.metric_words import label, present
from lightmeter.reports.results import Candidate, FailedCandidate, Results
from lightmeter.reports.shown_names import printable, printable_lines, short_name
from lightmeter.reports.significant import show_measurement
from lightmeter.reports.terminal_cells import bare, number, reason

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table
    from rich.text import Text

_LONGEST_NAME = 24


def side_by_side(results: Results) -> list[RenderableType]:
    """The table and whose times they are, findings, masks, layers, notes, failures; nothing where no engine was handed
    in."""
    parts: list[RenderableType] = [_table(results)] if results.candidates else []
    parts += _times(results.candidates)
    for candidate in results.candidates:
        parts += _remarks(candidate)
    return parts + [_failure(failed) for failed in results.failed_candidates]


def _table(results: Results) -> Table:
    """A row per engine: RMSE with its interval, FLIP, SSIM, relative bias, milliseconds."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(
        title=Text("engines side by side"), title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False,
        caption=Text(_caption(results), justify="left"),
    )  # fmt: skip
    columns = present(COLUMNS, [name for one in results.candidates for name in one.metrics])
    table.add_column("engine", no_wrap=True)
    for name in columns:  # where 80 columns are too few a number breaks before its interval instead of being cut
        table.add_column(label(name), justify="right", overflow="fold")
    table.add_column("ms", justify="right", overflow="fold")
    for candidate in results.candidates:
        cells = [(bare if name == "rmse" else number)(candidate.metrics.get(name)) for name in columns]
        time = bare(time_as_measured(candidate.time_ms) if candidate.time_ms else None)
        table.add_row(Text(_name(candidate), style="bold" if is_ours(candidate) else ""), *cells, time)
    return table


def _times(candidates: Sequence[Candidate]) -> Iterator[Text]:
    """Who measured which engine's time, and what it holds."""
    found: dict[str, list[str]] = {}
    for candidate in candidates:
        if how := time_words(candidate):
            found.setdefault(how, []).append(_name(candidate))
    for how, names in found.items():
        yield reason(f"time of {', '.join(names)}", how)


def _caption(results: Results) -> str:
    metrics = [candidate.metrics for candidate in results.candidates]
    unit = next((one["rmse"].unit for one in metrics if "rmse" in one and one["rmse"].unit), "")
    return "; ".join([*([f"RMSE in {unit}"] if unit else []), pixel_words(results.candidates, results.size)])


def _name(candidate: Candidate) -> str:
    return short_name(candidate.name, _LONGEST_NAME) + (" (ours)" if is_ours(candidate) else "")


def _remarks(candidate: Candidate) -> Iterator[Text]:
    from rich.text import Text

    name = _name(candidate)
    if candidate.nonfinite:
        yield Text(f"✕ {name}: {not_finite(candidate)}", style="bold red")
    for finding in candidate.findings:
        words = f"{name}: {fault_name(finding)}: {printable(finding.words)}; {fault_status(finding)}"
        yield Text(f"registration of {words}", style="" if finding.corrected else "yellow")
    for purpose, option in remedies(candidate.findings):
        yield Text(f"  {purpose}: {option}", style="yellow")
    if words := definition_words(candidate):
        yield reason(f"definition of {name}", words)
    if masked := masked_words(candidate):
        yield reason(f"masked for {name}", ", ".join(masked))
    for layer in candidate.layers:
        errors = [f"{label(m)} {show_measurement(layer.metrics[m])}" for m in present(("rmse", "flip"), layer.metrics)]
        term = f" ({printable(layer.term)})" if layer.term != layer.layer else ""
        yield reason(f"layer of {name}", printable(layer.layer) + term, ", ".join(errors))
    for note in candidate.notes:
        yield reason(f"note of {name}", printable(note))


def _failure(failed: FailedCandidate) -> Text:
    from rich.text import Text

    why = printable_lines(failed.why).replace("\n", "\n  ")
    return Text.assemble((f"✕ {short_name(failed.name)} gave no frame: ", "bold red"), why)
