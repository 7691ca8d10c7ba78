"""A scene a thousand kilometres from the origin is judged as any other; with a wrong truth nothing is decided."""

import pytest

SCENE = """
name = "far"
[camera]
position = [{x}, 1.5, {z}]
target = [{x}, 0.3, 0]
yfov = {yfov}
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
[[shapes]]
type = "plane"
width = 1
depth = 1
translate = [{x}, 0, {z}]
"""
HERE = {"x": 0, "z": 4, "yfov": 40}
FAR = HERE | {"x": 1e6}
TELESCOPE = FAR | {"z": 4000, "yfov": 0.04}
"""Rays start 36 cm off a ball of 60, for the origin is at what lies under the telescope."""
LIMITS = """
[defaults]
size = "16x16"
spp = 16
[[limit]]
scene = "far.toml"
metric = "rmse"
max = 100
"""


@pytest.mark.parametrize(
    ("scene", "status"), [(HERE, "PASS"), (FAR, "PASS"), (TELESCOPE, "UNDECIDED")], ids=["here", "far", "telescope"]
)
def test_a_gate(run, tmp_path, scene, status):
    (tmp_path / "far.toml").write_text(SCENE.format(**scene))
    (tmp_path / "lightmeter.toml").write_text(LIMITS)
    found = run("gate")
    assert found.code == 0
    assert f"1 {status}" in found.out
    said = " ".join((found.out + found.err).split())
    assert ("the reference is not to be trusted: in a scene" in said) == (status == "UNDECIDED")
    assert run("gate", "--strict").code == (3 if status == "UNDECIDED" else 0)


def test_a_comparison_says_so(run, tmp_path):
    (tmp_path / "far.toml").write_text(SCENE.format(**TELESCOPE))
    notes = run("compare", "far.toml", "--size", "16x16", "--spp", "16", "--json", "-o", "out").json["notes"]
    assert any("1e+06 m from the origin" in note for note in notes)
