"""Verdicts as plain text, for where neither colours nor Markdown are shown."""

from collections.abc import Sequence
from io import StringIO

from lightmeter.reports.gate_table import shown, verdict_table
from lightmeter.reports.verdict import Verdict

WIDTH = 100
"""Columns: what a terminal is likely to have."""


def to_text(verdicts: Sequence[Verdict], confidence: float) -> str:
    """A headline, the gate's table, and a sentence for each limit that does not hold."""
    from rich.console import Console

    lost = [verdict for verdict in verdicts if verdict.status != "PASS"]
    page = StringIO()
    out = Console(file=page, width=WIDTH, color_system=None, force_terminal=False)
    counts = {word: sum(v.status == status for v in verdicts) for status, word in _WORDS}
    told = ", ".join(f"{count} {word}" for word, count in counts.items() if count)
    out.print(f"lightmeter: {told} at confidence {confidence:g}", highlight=False)
    out.print(verdict_table(verdicts))
    lines = [f"{verdict.scene}: {verdict.message}" for verdict in lost]
    return "\n".join([*(line.rstrip() for line in page.getvalue().splitlines()), *lines])


_WORDS = (("FAIL", "failed"), ("UNDECIDED", "undecided"), ("PASS", "held"))


def to_line(verdict: Verdict) -> str:
    """A verdict in one line: "PASS: 0.051 (0.050 … 0.052), limit flip <= 0.12, 64 samples"."""
    samples = f", {verdict.samples} samples" if verdict.samples else ""
    return f"{verdict.status}: {shown(verdict)}, limit {verdict.limit}{samples}"
