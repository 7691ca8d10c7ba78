"""A reference that fails its own checks: every command that makes one says so."""

import json

import pytest

from lightmeter.truth import Truth

DOUBT = "the reference is not to be trusted: it fails its own checks"


@pytest.fixture(params=["", DOUBT], ids=["trusted", "doubted"])
def doubt(request, monkeypatch) -> str:
    """What the truth says of itself."""
    monkeypatch.setattr(Truth, "doubt", request.param)
    return request.param


def test_a_reference_says_what_is_doubtful_of_it(run, doubt):
    words = ("reference", "plane", "--size", "16x16", "--spp", "8", "-o", "out")
    assert run(*words, "--json").json["doubt"] == doubt
    found = run(*words)
    assert found.code == 0
    assert [line for line in found.err.splitlines() if "trusted" in line] == ([f"lightmeter: {doubt}"] if doubt else [])


def test_a_sweep_says_so_in_the_table_the_document_and_the_page(run, doubt, tmp_path):
    words = ("sweep", "plane", "narkowicz", "--knob", "prescale=0.6", "--size", "16x16", "--spp", "8", "--curve", "0")
    found = run(*words, "-o", "out")
    assert found.code == 0, found.err
    document = json.loads((tmp_path / "out" / "sweep.json").read_text())
    page = (tmp_path / "out" / "sweep.html").read_text()
    assert (DOUBT in document["notes"]) == (DOUBT in " ".join(found.out.split())) == (DOUBT in page) == bool(doubt)
