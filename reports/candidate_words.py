"""What is said of engines side by side, the same on the page and in the terminal."""

import math
from collections.abc import Sequence

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.results import Candidate, Finding, LayerError, Timing
from lightmeter.reports.shown_names import printable

COLUMNS = ("rmse", "flip", "ssim", "relative_bias")
_LOST = ("background",)
"""Faults that leave nothing to correct: what is missing is not in the picture in another form."""


def is_ours(candidate: Candidate) -> bool:
    return candidate.source == "lightmeter"


def pair_name(candidate: Candidate) -> str:
    """The name of its pair of pictures: our own frame is in the report as "frame"."""
    return "frame" if is_ours(candidate) else candidate.name


def layer_pair_name(candidate: Candidate, layer: LayerError) -> str:
    return f"{candidate.name} {layer.layer}"


def has_time(candidate: Candidate) -> bool:
    return candidate.time_ms is not None and math.isfinite(candidate.time_ms.median)


def time_as_measured(timing: Timing) -> Measurement:
    """Median ± median absolute deviation, in ms; without an interval where a single run cannot have a spread."""
    if timing.frames < 2 or not math.isfinite(timing.mad):
        return Measurement(timing.median, unit="ms")
    return Measurement(timing.median, timing.median - timing.mad, timing.median + timing.mad, "ms")


def fault_name(finding: Finding) -> str:
    return printable(finding.fault).replace("_", " ")


def fault_status(finding: Finding) -> str:
    if finding.corrected:
        return "corrected as asked"
    return "cannot be corrected" if finding.fault in _LOST else "not corrected"


def remedy(findings: Sequence[Finding]) -> str:
    """The option that corrects them all, also those that were corrected; "" where it would change nothing."""
    mendable = [finding for finding in findings if finding.fault not in _LOST]
    if all(finding.corrected for finding in mendable):
        return ""
    return "--register " + ",".join(dict.fromkeys(printable(finding.fault) for finding in mendable))


def masked_words(candidate: Candidate) -> list[str]:
    """What is left out for it, the most first: "80 unsupported material glass"."""
    counts = sorted(candidate.masked.items(), key=lambda item: -item[1])
    return [f"{count:,} {printable(reason)}" for reason, count in counts if count]


def compared_pixels(candidates: Sequence[Candidate]) -> str:
    """How many pixels are compared: one number, since all engines are compared over the same ones."""
    counts = [candidate.pixels for candidate in candidates]
    return " to ".join(f"{count:,}" for count in sorted({min(counts), max(counts)}))


def not_finite(candidate: Candidate) -> str:
    """ "3 pixels are not finite"; "" for none."""
    count = candidate.nonfinite
    return f"{count:,} {'pixel is' if count == 1 else 'pixels are'} not finite" if count else ""
