"""What errors of ambient visibility become in JSON, in words, and in rows of the page."""

import dataclasses
import json
from pathlib import Path

import pytest

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.ambient_content import ambient_content, ambient_line
from lightmeter.reports.html import write_report
from lightmeter.reports.results import AmbientError
from lightmeter.reports.results_json import ResultsError, from_json, to_json

from .report_page import needs_chromium, open_report
from .synthetic_pairs import make_pairs, make_results
from .test_attribution_words import printed

METRICS = {"rmse": Measurement(0.25, 0.24, 0.26), "relative_bias": Measurement(0.4, 0.38, 0.42)}
ERRORS = (
    AmbientError("gtao", "term", None, METRICS),
    AmbientError("gtao", "occlusion", 0.5, METRICS),
    AmbientError("gtao", "occlusion", None, METRICS),
)


def test_they_come_back_as_they_were():
    results = dataclasses.replace(make_results(), ambient=ERRORS)
    assert from_json(to_json(results)).ambient == ERRORS
    document = json.loads(to_json(results))
    document["ambient"][1]["radius"] = "far"
    with pytest.raises(ResultsError, match=r"ambient\[1\].radius"):
        from_json(json.dumps(document))


def test_in_words():
    whose, line = ambient_line(ERRORS)
    assert whose == "gtao against"
    assert [part.rsplit(" 0.25", 1)[0] for part in line.split(", ")] == [
        "occluded over unoccluded radiance (the term)",
        "open directions within 0.5 m",
        "open directions",
    ]
    assert any(
        said.startswith("gtao against: ") for said in printed(dataclasses.replace(make_results(), ambient=ERRORS))
    )
    assert ambient_content(()) is None
    assert [row["cells"][0]["value"] for row in ambient_content(ERRORS)["rows"]] == ["0.250"] * 3


@needs_chromium
def test_the_section_is_there_where_there_is_ambient_visibility(page, tmp_path: Path):
    open_report(page, write_report(tmp_path, dataclasses.replace(make_results(32), ambient=ERRORS), make_pairs(32)))
    section = "document.querySelector('[aria-labelledby=ambient-title]')"
    assert page.evaluate(f"{section}.querySelectorAll('tbody tr').length") == 3
    assert "open directions within 0.5 m" in page.evaluate(f"{section}.innerText")
