"""A scene a thousand kilometres from the origin: its reference is wrong, that is said, and nothing is decided on it."""

import json

import pytest

from lightmeter.truth import Truth

SCENE = """
name = "far"
[camera]
position = [{x}, 1.5, 4]
target = [{x}, 0.3, 0]
yfov = 40
[environment]
radiance = [0.3, 0.3, 0.3]
[[lights]]
type = "point"
position = [{x}, 3, 1]
intensity = 10
[[shapes]]
type = "plane"
translate = [{x}, 0, 0]
[[shapes]]
type = "sphere"
radius = 0.3
translate = [{x}, 0.3, 0]
"""
LIMITS = """
[defaults]
size = "16x16"
spp = 16
[[limit]]
scene = "far.toml"
metric = "rmse"
max = 100
"""


@pytest.mark.parametrize(("x", "status"), [(1e6, "UNDECIDED"), (0, "PASS")])
def test_a_gate(run, tmp_path, x, status):
    (tmp_path / "far.toml").write_text(SCENE.format(x=x))
    (tmp_path / "lightmeter.toml").write_text(LIMITS)
    found = run("gate")
    assert found.code == 0
    assert f"1 {status}" in found.out
    said = " ".join((found.out + found.err).split())
    assert ("the reference is not to be trusted: 1e+06 m from the origin" in said) == (status == "UNDECIDED")
    assert run("gate", "--strict").code == (3 if status == "UNDECIDED" else 0)


def test_a_comparison_says_so(run, tmp_path):
    (tmp_path / "far.toml").write_text(SCENE.format(x=1e6))
    notes = run("compare", "far.toml", "--size", "16x16", "--spp", "16", "--json", "-o", "out").json["notes"]
    assert any("1e+06 m from the origin" in note for note in notes)


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
