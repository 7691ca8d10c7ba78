"""Numbers as the report page's cells: texts with their tooltips, no markup."""

import math
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.metric_words import definition, label
from lightmeter.reports.results import Timing
from lightmeter.reports.significant import show_interval, show_number, show_value


def measured(measurement: Measurement) -> dict[str, Any]:
    """Value, interval, unit and the remarks that stand in its tooltip; `tail` is a second line."""
    remarks = [measurement.how]
    if measurement.floor is not None:
        remarks.append(f"noise floor {show_number(measurement.floor)}")
    if measurement.corrected is not None:
        remarks.append(f"corrected for noise {show_number(measurement.corrected)}")
    return {
        "value": show_value(measurement),
        "interval": show_interval(measurement),
        "unit": measurement.unit,
        "failed": math.isnan(measurement.value),  # an infinite PSNR is a perfect one
        "remarks": "; ".join(remark for remark in remarks if remark),
        "tail": "",
    }


def named(name: str) -> dict[str, str]:
    """A metric as a column's head."""
    return {"name": name, "label": label(name), "definition": definition(name)}


def timed(timing: Timing | None) -> dict[str, Any] | None:
    """Median and spread, in milliseconds; None where nothing was timed."""
    if timing is None:
        return None
    as_metric = Measurement(timing.median, timing.median - timing.mad, timing.median + timing.mad)
    spread = show_interval(as_metric) if math.isfinite(timing.mad) else ""
    return {
        "value": show_value(as_metric),
        "spread": spread,
        "failed": not math.isfinite(timing.median),
        "remarks": f"median over {timing.frames} frames, ± median absolute deviation",
    }


def terms_with_meaning(terms: tuple[str, ...]) -> list[dict[str, str]]:
    """Each term with the sentence that defines it; "" for a term that is not ours."""
    from lightmeter.scenes.terms import TERMS

    return [{"term": term, "meaning": TERMS[term].meaning if term in TERMS else ""} for term in terms]


def share_of_width(value: float, end: float) -> float:
    """`value` in percent of a bar's full length, which stands for `end`; 0 where there is nothing to draw."""
    return round(100 * min(1.0, max(0.0, value / end)), 2) if end > 0 and math.isfinite(value) else 0.0
