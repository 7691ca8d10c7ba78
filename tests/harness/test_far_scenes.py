"""A scene a thousand kilometres from the origin: its reference is wrong, and nothing is decided on it."""

import pytest

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
