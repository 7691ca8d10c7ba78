"""Gate verdicts as JUnit XML, the form that every CI server shows.

PASS is a test case, FAIL one with a `failure`, UNDECIDED one that is `skipped` (or, in strict mode, a
`failure` of type "undecided"): a noisy reference never turns into a red build by itself.
"""

import math
import os
import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

from lightmeter.reports.one_step import write_text
from lightmeter.reports.significant import show_measurement
from lightmeter.reports.verdict import Verdict

# What XML 1.0 cannot hold, even escaped.
_UNPRINTABLE = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def to_junit(verdicts: Sequence[Verdict], suite: str = "lightmeter gate", *, strict: bool = False) -> str:
    """The XML document as text; see the module for what each status becomes."""
    failures = sum(_is_failure(verdict, strict) for verdict in verdicts)
    skipped = sum(verdict.status == "UNDECIDED" for verdict in verdicts) if not strict else 0
    seconds = sum(verdict.seconds for verdict in verdicts)
    counts = {
        "tests": str(len(verdicts)),
        "failures": str(failures),
        "errors": "0",
        "skipped": str(skipped),
        "time": _time(seconds),
    }
    root = ET.Element("testsuites", {"name": _text(suite), **counts})
    group = ET.SubElement(root, "testsuite", {"name": _text(suite), **counts})
    for verdict in verdicts:
        _add_case(group, verdict, suite, strict)
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def write_junit(
    path: str | os.PathLike[str],
    verdicts: Sequence[Verdict],
    suite: str = "lightmeter gate",
    *,
    strict: bool = False,
) -> Path:
    """Write `to_junit(…)` to `path` as UTF-8, in one step."""
    return write_text(path, to_junit(verdicts, suite, strict=strict))


def _add_case(group: ET.Element, verdict: Verdict, suite: str, strict: bool) -> None:
    owner, _, _ = verdict.name.rpartition("/")
    case = ET.SubElement(
        group,
        "testcase",
        {
            "name": _text(verdict.name),
            "classname": _text(owner or suite).replace("/", "."),
            "time": _time(verdict.seconds),
        },
    )
    summary = verdict.message or f"{verdict.status}: limit {verdict.limit}"
    if _is_failure(verdict, strict):
        kind = "undecided" if verdict.status == "UNDECIDED" else "limit"
        ET.SubElement(case, "failure", {"message": _text(summary), "type": kind}).text = _text(_details(verdict))
    elif verdict.status == "UNDECIDED":
        ET.SubElement(case, "skipped", {"message": _text(summary)})
    ET.SubElement(case, "system-out").text = _text(_details(verdict))


def _is_failure(verdict: Verdict, strict: bool) -> bool:
    return verdict.status == "FAIL" or (strict and verdict.status == "UNDECIDED")


def _details(verdict: Verdict) -> str:
    lines = [f"verdict: {verdict.status}", f"limit: {verdict.limit}"]
    if verdict.measurement is not None:
        lines.append(f"measured: {show_measurement(verdict.measurement)}")
        if verdict.measurement.how:
            lines.append(f"how: {verdict.measurement.how}")
    if verdict.looks:
        lines.append(f"samples: {verdict.samples}, looks: {verdict.looks}")
    if verdict.message:
        lines.append(verdict.message)
    return "\n".join(lines)


def _time(seconds: float) -> str:
    return f"{seconds if math.isfinite(seconds) else 0.0:.3f}"


def _text(text: str) -> str:
    return _UNPRINTABLE.sub("\N{REPLACEMENT CHARACTER}", text)
