"""Verdicts as Markdown that fits a comment on a pull request, with small heatmaps beside it."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from lightmeter.reports.gate_table import shown
from lightmeter.reports.heatmap import colourise, map_for
from lightmeter.reports.one_step import write_text
from lightmeter.reports.pictures import ErrorMap
from lightmeter.reports.verdict import Verdict

LONGEST = 65_536
"""Characters of a comment."""

SIDE = 160
"""Pixels of a heatmap's longer side."""

MOST_PICTURES = 12
ORDER = {"FAIL": 0, "UNDECIDED": 1, "PASS": 2}
MARKS = {"PASS": "✅", "FAIL": "❌", "UNDECIDED": "❔"}
Maps = Mapping[tuple[str, str], ErrorMap]
"""(scene, what) to what is wrong with it."""


def write_markdown(path: Path, verdicts: Sequence[Verdict], maps: Maps, confidence: float, seconds: float) -> Path:
    """Write the comment, and the heatmaps of what failed first as `<name>.<number>.png` beside it.

    Args:
        maps: FLIP maps of what was judged.
    """
    ordered = sorted(verdicts, key=lambda v: ORDER[v.status])
    wanted = list(dict.fromkeys((v.scene, v.of) for v in ordered if (v.scene, v.of) in maps))[:MOST_PICTURES]
    pictures = {}
    for number, key in enumerate(wanted, 1):
        pictures[key] = f"{path.stem}.{number}.png"
        write_small(path.with_name(pictures[key]), maps[key])
    return write_text(path, to_markdown(ordered, pictures, confidence, seconds))


def to_markdown(
    verdicts: Sequence[Verdict], pictures: Mapping[tuple[str, str], str], confidence: float, seconds: float
) -> str:
    """The comment: a headline, a table, and the details folded; at most `LONGEST` characters.

    Args:
        verdicts: in the order in which they are shown; what does not fit is counted.
        pictures: (scene, what) to the file beside the comment.
    """
    parts = [_headline(verdicts, confidence, seconds), _table_head()]
    room = LONGEST - sum(map(len, parts)) - 400
    rows, used = _fit([_row(v) for v in verdicts], room * 2 // 3)
    parts += rows
    if len(rows) < len(verdicts):
        parts.append(f"\n{len(verdicts) - len(rows)} more are not shown: a comment has no room for them.\n")
    images = [f"**{_plain(f'{scene}/{of}')}**\n\n![FLIP]({name})\n\n" for (scene, of), name in pictures.items()]
    details, _ = _fit([f"- {_plain(v.message)}\n" for v in verdicts if v.message] + ["\n", *images], room - used)
    if details:
        parts.append("\n<details>\n<summary>Details</summary>\n\n" + "".join(details) + "\n</details>\n")
    return "".join(parts)


def write_small(path: Path, error: ErrorMap) -> None:
    """The map alone, `SIDE` pixels on its longer side: a small image is enlarged by a whole factor."""
    from PIL import Image

    picture = colourise(error.values, map_for(error), *error.range())
    factor = max(1, SIDE // max(picture.shape[:2]))
    image = Image.fromarray(np.ascontiguousarray(picture.repeat(factor, axis=0).repeat(factor, axis=1)))
    image.thumbnail((SIDE, SIDE), Image.Resampling.BOX)
    image.save(path)


def _headline(verdicts: Sequence[Verdict], confidence: float, seconds: float) -> str:
    counts = {status: sum(v.status == status for v in verdicts) for status in ORDER}
    worst = next(status for status in ORDER if counts[status] or status == "PASS")
    words = {"FAIL": "failed", "UNDECIDED": "undecided", "PASS": "held"}
    told = ", ".join(f"{count} {words[status]}" for status, count in counts.items() if count)
    return f"### {MARKS[worst]} lightmeter: {told or 'no limit'}\n\nConfidence {confidence:g}, {seconds:.1f} s.\n\n"


def _table_head() -> str:
    return "| | what | limit | measured | samples | s |\n|---|---|---|---|---:|---:|\n"


def _row(v: Verdict) -> str:
    cells = (
        f"{MARKS[v.status]} {v.status}",
        _plain(f"{v.scene}/{v.of}" if v.scene else v.name),
        _plain(str(v.limit)),
        _plain(shown(v)),
        str(v.samples),
        f"{v.seconds:.1f}",
    )
    return "| " + " | ".join(cells) + " |\n"


def _fit(lines: Sequence[str], room: int) -> tuple[list[str], int]:
    """As many lines from the start as fit, and the characters they take."""
    kept, used = [], 0
    for line in lines:
        if used + len(line) > room:
            break
        kept.append(line)
        used += len(line)
    return kept, used


def _plain(text: str) -> str:
    """Text that Markdown shows as it stands, in one line of at most 300 characters."""
    short = " ".join(text.split())[:300]
    return re.sub(r"([\\`*_\[\]<>|#~!&@])", r"\\\1", short)
