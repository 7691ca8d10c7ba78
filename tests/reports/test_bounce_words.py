"""What is said of the light that other surfaces scatter: read back as written, and in words."""

import dataclasses
import json

import pytest

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.bounce_content import bounce_content, bounce_line
from lightmeter.reports.page_content import page_content
from lightmeter.reports.results import BounceShare
from lightmeter.reports.results_json import ResultsError, from_json, to_json

from .synthetic_pairs import make_results

PART = Measurement(0.873, 0.861, 0.885, how="Σ")
ONE = BounceShare("virtual_lights", 1, PART, PART, PART, PART, Measurement(0.0123, 0.012, 0.0126, "W/sr/m²"))
ALL = dataclasses.replace(ONE, bounces=None)


def test_bounces_come_back_as_they_were() -> None:
    results = dataclasses.replace(make_results(), bounces=(ONE, ALL))
    assert from_json(to_json(results)) == results
    document = json.loads(to_json(results))
    document["bounces"][0]["bounces"] = "one"
    with pytest.raises(ResultsError, match=r"bounces\[0\].bounces: expected a whole number"):
        from_json(json.dumps(document))


def test_shares_are_told_in_percent() -> None:
    whose, line = bounce_line(ONE)
    assert whose == "virtual_lights against one bounce"
    assert line.startswith("recovered 87.3 % ± 1.2, energy 87.3 %")
    content = bounce_content((ONE, ALL))
    assert content is not None
    assert [row["truth"] for row in content["rows"]] == ["one bounce", "all bounces"]
    assert content["rows"][0]["cells"][0]["value"] == "87.3"


def test_there_is_no_section_without_them() -> None:
    assert bounce_content(()) is None
    assert page_content(make_results(), set())["bounces"] is None
