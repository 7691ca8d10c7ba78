"""Which truth is asked for, from the words to what is rendered."""

import json
from dataclasses import replace

import pytest

from lightmeter import holding
from lightmeter.commands.gate import _under
from lightmeter.failures import UsageError
from lightmeter.limits import read_rules
from lightmeter.options import Budget
from lightmeter.reports.results import Reference
from lightmeter.reports.truth_words import truth_words
from lightmeter.scenes.load import load
from lightmeter.truth import Truth

LIMITS = """
[defaults]
truth = "{defaults}"

[[limit]]
scene = "plane"
metric = "flip"
max = 0.5

[[limit]]
scene = "plane"
metric = "flip"
max = 0.5
truth = "{own}"
"""


@pytest.fixture
def rules(tmp_path):
    def read(defaults: str, own: str):
        (tmp_path / "lightmeter.toml").write_text(LIMITS.format(defaults=defaults, own=own))
        return read_rules(tmp_path / "lightmeter.toml").limits

    return read


def test_a_limit_s_truth_goes_before_the_defaults(rules):
    usual, own = rules("multiscatter", "single")
    assert (usual.conditions.scattering, own.conditions.scattering) == ("multiscatter", "single")
    assert (usual.variant, own.variant) == ("", "not truth multiscatter")
    with pytest.raises(ValueError, match="single"):
        rules("multi", "single")


def test_another_truth_on_the_command_line_is_another_case(rules):
    usual, own = (_under(limit, "multiscatter") for limit in rules("single", "multiscatter"))
    assert usual.conditions == own.conditions
    assert usual.variant == own.variant == "truth multiscatter"
    assert _under(own, "single").conditions == replace(own.conditions, scattering="single")


def test_conditions_of_an_unknown_truth_are_refused():
    assert holding.conditions(truth="multiscatter").scattering == "multiscatter"
    with pytest.raises(UsageError, match=r"no 'multi'.*multiscatter"):
        holding.conditions(truth="multi")


def test_an_unknown_truth_is_a_usage_error(run):
    found = run("compare", "plane", "--truth", "multi")
    assert found.code == 2
    assert "multiscatter" in found.err


def test_a_reference_is_of_the_truth_asked_for_and_no_other_takes_it(run, refused, tmp_path):
    folder = tmp_path / "truth"
    made = run("reference", "plane", "--size", "4x4", "--spp", "8", "--truth", "multiscatter", "-o", folder, "--json")
    assert made.json["truth"] == "multiscatter"
    assert json.loads((folder / "manifest.json").read_text())["truth"] == "multiscatter"
    message = refused("compare", "plane", "--size", "4x4", "--reference", folder, "--no-shares")
    assert "expected the truth 'single', got 'multiscatter'" in message


def test_punctual_lights_have_a_closed_form_in_one_truth_only():
    """Where every batch is another, the first must not stand for all."""
    scene = load("control")
    assert not Truth(scene, (4, 4), Budget(8)).is_sampled(0)
    assert Truth(scene, (4, 4), Budget(8), scattering="multiscatter").is_sampled(0)


def test_only_the_unusual_truth_is_said_in_headers():
    assert truth_words(Reference(64, 8, 1.0, False)) == ""
    assert truth_words(Reference(64, 8, 1.0, False, "multiscatter")).startswith(" · truth multiscatter: all bounces")
