"""`lightmeter gate`: limits that hold, fail, cannot be decided, and limits that make no sense."""

import shutil
import xml.etree.ElementTree as ET

import pytest

DEFAULTS = '[defaults]\nsize = "16x16"\nspp = 8\n'


@pytest.fixture
def write(tmp_path):
    """Writes lightmeter.toml: small defaults, and a [[limit]] for each text."""

    def call(*limits: str, defaults: str = DEFAULTS) -> None:
        text = defaults + "".join(f"[[limit]]\n{limit}\n" for limit in limits)
        (tmp_path / "lightmeter.toml").write_text(text)

    return call


def of_plane(metric: str, bound: str, more: str = "") -> str:
    return f'scene = "plane"\nmetric = "{metric}"\n{bound}\n{more}'


HOLDS = of_plane("relative_bias", "max = 0.5")
FAILS = of_plane("nrmse", "max = 1e-9", 'of = "narkowicz"')


@pytest.fixture
def undecided(run, write) -> str:
    """A limit in the middle of the interval: at the value itself."""
    write(HOLDS)
    (verdict,) = run("gate", "--json").json["verdicts"]
    return of_plane("relative_bias", f"max = {abs(verdict['value'])!r}")


def test_limits_that_hold(run, write):
    write(HOLDS, of_plane("flip", "max = 0.5"), of_plane("ssim", "min = 0.5"), of_plane("psnr", "min = 10"))
    found = run("gate")
    assert found.code == 0
    assert "4 PASS, 0 FAIL, 0 UNDECIDED" in found.out
    assert found.err == ""


def test_a_limit_that_fails(run, write):
    write(HOLDS, FAILS)
    found = run("gate")
    assert found.code == 1
    assert "1 PASS, 1 FAIL" in found.out


def test_an_undecided_limit_warns_or_with_strict_stops(run, write, undecided):
    write(HOLDS, undecided)
    found = run("gate")
    assert found.code == 0
    assert "UNDECIDED" in found.out
    assert "1 of 2 limits undecided" in found.err
    assert run("gate", "--strict").code == 3
    write(undecided, FAILS)
    assert run("gate", "--strict").code == 1


def test_json_and_junit_tell_the_same(run, write, undecided, tmp_path):
    write(HOLDS, FAILS, undecided)
    found = run("gate", "--json", "--junit", "reports/junit.xml")
    assert found.code == found.json["exit"] == 1
    assert (found.json["passed"], found.json["failed"], found.json["undecided"]) == (1, 1, 1)
    assert [v["status"] for v in found.json["verdicts"]] == ["PASS", "FAIL", "UNDECIDED"]
    assert found.json["verdicts"][1] | {"of": "narkowicz", "metric": "nrmse", "max": 1e-9} == found.json["verdicts"][1]
    suite = ET.parse(tmp_path / "reports" / "junit.xml").getroot()
    assert (suite.get("tests"), suite.get("failures"), suite.get("skipped")) == ("3", "1", "1")
    names = [case.get("name") for case in suite.iter("testcase")]
    assert names == ["plane/frame/relative_bias", "plane/narkowicz/nrmse", "plane/frame/relative_bias"]


def test_a_pattern_finds_scenes_beside_the_file(run, write, tmp_path, monkeypatch):
    from lightmeter.scenes import library

    (tmp_path / "scenes").mkdir()
    for name in ("one", "two"):
        shutil.copy(library.path("plane"), tmp_path / "scenes" / f"{name}.toml")
    (tmp_path / "scenes" / "notes.txt").write_text("no scene")
    write(HOLDS.replace('"plane"', '"scenes/*"'))
    found = run("gate", "--json")
    assert [v["scene"] for v in found.json["verdicts"]] == ["scenes/one.toml", "scenes/two.toml"]
    assert len(run("gate", "scenes/two.toml", "--json").json["verdicts"]) == 1
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    found = run("gate", "--config", "../lightmeter.toml", "../scenes/two.toml", "--json")
    assert [v["scene"] for v in found.json["verdicts"]] == ["../scenes/two.toml"]


def test_a_scene_is_compared_once_per_setting(run, write, monkeypatch):
    from lightmeter import gating

    compared, compare = [], gating.compare

    def record(scene, size, *args, **options):
        compared.append((scene.name, size))
        return compare(scene, size, *args, **options)

    monkeypatch.setattr(gating, "compare", record)
    knob = "set = { supersampling.grid = 2 }"
    same_knob = 'set = { "supersampling.grid" = 2 }'
    write(
        HOLDS,
        of_plane("flip", "max = 1"),
        of_plane("flip", "max = 1", knob),
        of_plane("ssim", "min = 0", same_knob),
        of_plane("flip", "max = 1", 'size = "16x12"'),
        of_plane("delta_e_2000", "max = 9", 'of = "cook_torrance"'),
    )
    found = run("gate", "--json")
    assert found.code == 0, found
    assert sorted(compared) == [("plane", (16, 12)), ("plane", (16, 16)), ("plane", (16, 16))]
    names = [v["scene"] for v in found.json["verdicts"]]
    assert names.count("plane") == 3
    assert names.count("plane [supersampling.grid=2]") == 2
    assert names.count("plane [16x12]") == 1


def test_reports_are_written_where_asked(run, write, tmp_path):
    write(HOLDS)
    assert run("gate", "-o", "out").code == 0
    assert (tmp_path / "out" / "plane" / "report.html").exists()
    assert not (tmp_path / "lightmeter-out").exists()


def test_a_frame_that_is_not_finite_fails(run, write, monkeypatch):
    """A NaN is a failure, never UNDECIDED, whatever the limit."""
    from dataclasses import replace

    import numpy as np

    from lightmeter import comparison

    class Broken(comparison.Renderer):
        def render(self):
            frame = super().render()
            radiance = frame.radiance.copy()
            radiance[3, 4] = np.nan
            return replace(frame, radiance=radiance)

    monkeypatch.setattr(comparison, "Renderer", Broken)
    write(HOLDS, of_plane("flip", "max = 1"), of_plane("psnr", "min = 0"))
    found = run("gate", "--json")
    assert found.code == 1
    assert {(v["status"], v["value"]) for v in found.json["verdicts"]} == {("FAIL", "NaN")}
    assert "row 3, column 4" in found.json["verdicts"][0]["message"]


FAULTS = {
    "scene": (HOLDS.replace('"plane"', '"plnae"'), "'plane'"),
    "pattern": (HOLDS.replace('"plane"', '"scenes/*.toml"'), "matches no scene file"),
    "file": (HOLDS.replace('"plane"', '"gone.toml"'), "gone.toml"),
    "absolute": (HOLDS.replace('"plane"', '"/nowhere/*.toml"'), "/nowhere"),
    "metric": (of_plane("flp", "max = 1"), "'flip'"),
    "effect": (of_plane("flip", "max = 1", 'of = "cook_torance"'), "'cook_torrance'"),
    "left out": (of_plane("flip", "max = 1", 'of = "shadow_map"'), "one flat shape"),
    "excluded": (of_plane("flip", "max = 1", 'of = "srgb"\nwithout = ["srgb"]'), "left out as asked"),
    "max of ssim": (of_plane("ssim", "max = 1"), "expected min"),
    "min of rmse": (of_plane("rmse", "min = 1"), "expected max"),
    "negative bias": (of_plane("bias", "max = -1"), "magnitude"),
    "both": (of_plane("flip", "max = 1\nmin = 0"), "either max or min"),
    "neither": (of_plane("flip", ""), "either max or min"),
    "nan": (of_plane("flip", "max = nan"), "finite"),
    "text": (of_plane("flip", 'max = "1"'), "number"),
    "unknown key": (of_plane("flip", "max = 1\nmetrc = 1"), "'metric'"),
    "no metric": ('scene = "plane"\nmax = 1', "metric"),
    "size": (of_plane("flip", "max = 1", 'size = "16"'), "WxH"),
    "spp": (of_plane("flip", "max = 1", "spp = 4"), "at least 8"),
    "budget": (of_plane("flip", "max = 1", "spp = 8\nseconds = 1"), "one of them"),
    "knob": (of_plane("flip", "max = 1", "set = { shadow_map.resoltion = 64 }"), "'resolution'"),
    "knob's value": (of_plane("flip", "max = 1", "set = { shadow_map.resolution = 1 }"), "[16, 8192]"),
    "knob's key": (of_plane("flip", "max = 1", "set = { resolution = 1 }"), "EFFECT.KNOB"),
    "only": (of_plane("flip", "max = 1", 'only = ["sgrb"]'), "'srgb'"),
    "toml": ("scene = ", "TOML"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_limit_that_makes_no_sense_is_refused_before_any_work(refused, write, monkeypatch, fault):
    from lightmeter import gating

    monkeypatch.setattr(gating, "compare", None)
    text, named = FAULTS[fault]
    write(HOLDS, text)
    message = refused("gate")
    assert named in message
    assert "lightmeter.toml" in message
    assert "limit[1]" in message or fault == "toml"


def test_files_that_are_no_limits_are_refused(refused, write, tmp_path):
    write()
    assert "no limit" in refused("gate")
    (tmp_path / "lightmeter.toml").write_text("[default]\n")
    assert "'defaults'" in refused("gate")
    (tmp_path / "lightmeter.toml").write_bytes(b"\xff\xfe")
    assert "TOML" in refused("gate")
    (tmp_path / "folder.toml").mkdir()
    assert "folder.toml" in refused("gate", "--config", "folder.toml")


def test_a_scene_without_a_limit_is_refused(refused, write):
    write(HOLDS)
    assert "'plane'" in refused("gate", "plne")
    assert "posts" in refused("gate", "posts")


def test_a_junit_file_that_cannot_be_is_found_before_the_work(refused, write, tmp_path):
    write(HOLDS)
    (tmp_path / "file").write_text("")
    assert "folder" in refused("gate", "--junit", tmp_path)
    assert "file" in refused("gate", "--junit", "file/junit.xml")
