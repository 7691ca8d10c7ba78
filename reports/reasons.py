"""What a comparison leaves out, reason by reason: with many effects, few reasons."""

from collections.abc import Iterable

from lightmeter.reports.results import LeftOut


def by_reason(left_out: Iterable[LeftOut]) -> dict[str, list[str]]:
    """Each reason with what it is the reason for, in the order of the first of them."""
    found: dict[str, list[str]] = {}
    for item in left_out:
        found.setdefault(item.why.replace(f"--use {item.what}", "--use EFFECT"), []).append(item.what)
    return found
