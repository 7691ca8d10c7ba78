"""What is said of engines side by side, the same on the page and in the terminal."""

import math
from collections.abc import Sequence

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.metric_words import label
from lightmeter.reports.results import Candidate, Finding, LayerError, Timing
from lightmeter.reports.shown_names import printable
from lightmeter.reports.significant import show_measurement

COLUMNS = ("rmse", "flip", "ssim", "relative_bias")
LAYER_COLUMNS = ("rmse", "nrmse", "flip", "ssim", "relative_bias")
_LEFT_OUT = {"background": "--no-background"}
"""What leaves nothing to correct, since what is missing is not in the picture in another form: by which option the
pixels are left out instead."""


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
    return "corrected as asked" if finding.corrected else "not corrected"


def remedies(findings: Sequence[Finding]) -> list[tuple[str, str]]:
    """What can be done about those that were not corrected, and the option that does it.

    The option names what was corrected already too, so that it can be given in place of the one that was.
    """
    mendable = [finding for finding in findings if finding.fault not in _LEFT_OUT]
    found = []
    if not all(finding.corrected for finding in mendable):
        faults = ",".join(dict.fromkeys(printable(finding.fault) for finding in mendable))
        found.append(("to correct it before anything is measured", f"--register {faults}"))
    for finding in findings:
        if finding.fault in _LEFT_OUT and not finding.corrected:
            found.append((f"to leave out the {finding.fault}", _LEFT_OUT[finding.fault]))
    return found


def time_words(candidate: Candidate) -> str:
    """Who measured the time and what it holds; "" where there is none."""
    if candidate.time_ms is None:
        return ""
    return printable(candidate.time_how) or ("start-up and loading included" if candidate.time_whole else "")


def masked_words(candidate: Candidate) -> list[str]:
    """What is left out for it, the most first: "80 unsupported material glass"."""
    counts = sorted(candidate.masked.items(), key=lambda item: -item[1])
    return [f"{count:,} {printable(reason)}" for reason, count in counts if count]


def pixel_words(candidates: Sequence[Candidate], size: tuple[int, int]) -> str:
    """Over which pixels the engines, one at least, are compared: all of them over the same ones."""
    total = size[0] * size[1]
    counts = sorted({candidate.pixels for candidate in candidates})
    if counts == [total]:
        return f"over all {total:,} pixels"
    return f"over {' or '.join(f'{count:,}' for count in counts)} of {total:,} pixels, those that every engine supports"


def definition_words(candidate: Candidate) -> str:
    """Its errors against both truths and which of them it follows; "" where there was but one."""
    if not candidate.truths:
        return ""
    verdict = f"follows {candidate.follows}" if candidate.follows else "cannot tell which it follows"
    errors = []
    for metric in next(iter(candidate.truths.values())):
        each = [f"{show_measurement(found[metric])} against {truth}" for truth, found in candidate.truths.items()]
        errors.append(f"{label(metric)} {', '.join(each)}")
    return f"{verdict}: {'; '.join(errors)}"


def not_finite(candidate: Candidate) -> str:
    """ "3 pixels are not finite"; "" for none."""
    count = candidate.nonfinite
    return f"{count:,} {'pixel is' if count == 1 else 'pixels are'} not finite" if count else ""
