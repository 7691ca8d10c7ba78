"""`lightmeter gate`: limits that hold, fail, cannot be decided, and limits that make no sense."""

import shutil
import xml.etree.ElementTree as ET

import pytest

DEFAULTS = '[defaults]\nsize = "16x16"\nspp = 16\n'


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


UNDECIDED = of_plane("rmse", "max = 1e-6")
"""The plane's frame is all but perfect: no reference of 16 samples tells its error from this."""


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


def test_an_undecided_limit_warns_or_with_strict_stops(run, write):
    write(HOLDS, UNDECIDED)
    found = run("gate")
    assert found.code == 0
    assert "UNDECIDED" in found.out
    assert "1 of 2 limits undecided" in found.err
    assert run("gate", "--strict").code == 3
    write(UNDECIDED, FAILS)
    assert run("gate", "--strict").code == 1


def test_json_and_junit_tell_the_same(run, write, tmp_path):
    write(HOLDS, FAILS, UNDECIDED)
    found = run("gate", "--json", "--junit", "reports/junit.xml")
    assert found.code == found.json["exit"] == 1
    assert (found.json["passed"], found.json["failed"], found.json["undecided"]) == (1, 1, 1)
    assert [v["status"] for v in found.json["verdicts"]] == ["PASS", "FAIL", "UNDECIDED"]
    assert found.json["verdicts"][1] | {"of": "narkowicz", "metric": "nrmse", "max": 1e-9} == found.json["verdicts"][1]
    suite = ET.parse(tmp_path / "reports" / "junit.xml").getroot()
    assert (suite.get("tests"), suite.get("failures"), suite.get("skipped")) == ("3", "1", "1")
    names = [case.get("name") for case in suite.iter("testcase")]
    assert names == ["plane/frame/relative_bias", "plane/narkowicz/nrmse", "plane/frame/rmse"]


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


def test_a_scene_is_drawn_once_per_setting(run, write, monkeypatch):
    from lightmeter.realtime import renderer

    rendered, render = [], renderer.Renderer.render

    def record(self):
        rendered.append(self.size)
        return render(self)

    monkeypatch.setattr(renderer.Renderer, "render", record)
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
    assert sorted(rendered) == [(16, 12), (16, 16), (16, 16)]
    names = [v["scene"] for v in found.json["verdicts"]]
    assert names.count("plane") == 3
    assert names.count("plane [supersampling.grid=2]") == 2
    assert names.count("plane [16x12]") == 1


def test_limits_on_one_thing_share_its_batches_and_no_other_oracle_runs(run, write, monkeypatch):
    from lightmeter.groundtruth import oracles
    from lightmeter.truth import Truth

    asked, batch = [], Truth.reference_batch
    monkeypatch.setattr(Truth, "reference_batch", lambda self, n, spp: asked.append((n, spp)) or batch(self, n, spp))
    monkeypatch.setattr(oracles, "find", None)
    write(of_plane("rmse", "max = 0.5"), of_plane("flip", "max = 0.9"), of_plane("rmse", "max = 0.5", 'of = "srgb"'))
    assert run("gate", "--no-store").code == 0
    assert asked == [(n, 1) for n in range(8)]


def test_reports_are_written_where_asked(run, write, tmp_path):
    write(HOLDS)
    assert run("gate", "-o", "out").code == 0
    assert (tmp_path / "out" / "plane" / "report.html").exists()
    assert not (tmp_path / "lightmeter-out").exists()


def test_a_frame_that_is_not_finite_fails(run, write, monkeypatch):
    """A NaN is a failure, never UNDECIDED, whatever the limit."""
    from dataclasses import replace

    import numpy as np

    from lightmeter import cases

    class Broken(cases.Renderer):
        def render(self):
            frame = super().render()
            radiance = frame.radiance.copy()
            radiance[3, 4] = np.nan
            return replace(frame, radiance=radiance)

    monkeypatch.setattr(cases, "Renderer", Broken)
    write(HOLDS, of_plane("flip", "max = 1"), of_plane("psnr", "min = 0"))
    found = run("gate", "--json")
    assert found.code == 1
    assert {(v["status"], v["value"]) for v in found.json["verdicts"]} == {("FAIL", "NaN")}
    assert "row 3, column 4" in found.json["verdicts"][0]["message"]
    assert {v["samples"] for v in found.json["verdicts"]} == {0}


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
    "seconds of one": (of_plane("flip", "max = 1", "seconds = 1"), "unknown key 'seconds'"),
    "three bounds": (of_plane("flip", "max = 1\nregression = 0.1"), "max, min and regression"),
    "regression of 0": (of_plane("flip", "regression = 0"), "above 0"),
    "region's key": (of_plane("flip", "max = 1", 'region = { objet = "x" }'), "'object'"),
    "two regions": (of_plane("flip", "max = 1", 'region = { object = "x", material = "y" }'), "one of"),
    "background": (of_plane("flip", "max = 1", "region = { background = true }"), "background = false"),
    "object": (of_plane("flip", "max = 1", 'region = { object = "plane 1" }'), "'plane 0'"),
    "material": (of_plane("flip", "max = 1", 'region = { material = ["gray"] }'), "'grey'"),
    "ratio of the frame": (of_plane("time_ratio", "max = 1"), "effect's"),
    "ratio to itself": (of_plane("time_ratio", "max = 1", 'of = "srgb"\nto = "srgb"'), "itself"),
    "ratio to nothing": (of_plane("time_ratio", "max = 1", 'of = "srgb"\nto = "fram"'), "'frame'"),
    "ratio's regression": (of_plane("time_ratio", "regression = 0.1", 'of = "srgb"'), "not comparable"),
    "time's region": (of_plane("time_ratio", "max = 1", 'of = "srgb"\nregion = { background = false }'), "no region"),
    "milliseconds": (of_plane("time_ms", "max = 1"), 'device = "'),
    "time": (of_plane("time_rati", "max = 1"), "'time_ratio'"),
    "to": (of_plane("flip", "max = 1", 'to = "frame"'), "time_ratio"),
    "device": (of_plane("flip", "max = 1", 'device = "x"'), "time_ms"),
    "knob": (of_plane("flip", "max = 1", "set = { shadow_map.resoltion = 64 }"), "'resolution'"),
    "knob's value": (of_plane("flip", "max = 1", "set = { shadow_map.resolution = 1 }"), "[16, 8192]"),
    "knob's key": (of_plane("flip", "max = 1", "set = { resolution = 1 }"), "EFFECT.KNOB"),
    "only": (of_plane("flip", "max = 1", 'only = ["sgrb"]'), "'srgb'"),
    "toml": ("scene = ", "TOML"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_limit_that_makes_no_sense_is_refused_before_any_work(refused, write, monkeypatch, fault):
    from lightmeter.cases import Case

    monkeypatch.setattr(Case, "frame", None)
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
    (tmp_path / "lightmeter.toml").write_text("[budget]\nconfidense = 0.9\n")
    assert "'confidence'" in refused("gate")
    (tmp_path / "lightmeter.toml").write_text("[budget]\nconfidence = 1\n")
    assert "below 1" in refused("gate")
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
    assert "--seconds" in refused("gate", "--seconds", "0")
    assert "--confidence" in refused("gate", "--confidence", "1")
    assert "--markdown" in refused("gate", "--markdown", tmp_path)


def test_milliseconds_are_judged_on_their_device_alone(run, write):
    from lightmeter.device import device_digest
    from lightmeter.planning import this_device

    here = device_digest(this_device())
    write(of_plane("time_ms", "max = 1e6", f'device = "{here}"'), of_plane("time_ms", "max = 1e6", 'device = "other"'))
    found = run("gate", "--json", "--strict")
    first, second = found.json["verdicts"]
    assert (first["status"], first["unit"], first["pixels"]) == ("PASS", "ms", None)
    assert (second["status"], second["value"]) == ("UNDECIDED", None)
    assert "device other" in second["reason"] and here in second["reason"]
    assert found.code == 3


def test_a_ratio_of_times_is_one_of_paired_rounds(run, write):
    ratio = of_plane("time_ratio", "max = 1e3", 'of = "cook_torrance"\nto = "srgb"')
    write(ratio, of_plane("time_ratio", "max = 1e-6", 'of = "cook_torrance"'))
    found = run("gate", "--json")
    assert [(v["status"], v["samples"]) for v in found.json["verdicts"]] == [("PASS", 24), ("FAIL", 24)]
    assert "order statistics" in found.json["verdicts"][0]["message"] or found.json["verdicts"][0]["low"] > 0


def test_a_region_counts_its_pixels_alone(run, write, tmp_path):
    everywhere = 'scene = "posts"\nmetric = "rmse"\nmax = 9\nsize = "48x48"\nspp = 8\n'
    regions = ("background = false", 'object = "pole 4 cm"', 'material = ["steel", "wood"]')
    write(everywhere, *(f"{everywhere}region = {{ {region} }}\n" for region in regions))
    found = run("gate", "--json")
    assert found.code == 0, found
    verdicts = found.json["verdicts"]
    pixels = [v["pixels"] for v in verdicts]
    assert pixels[0] == 48 * 48 and 0 < pixels[2] < pixels[3] < pixels[1] < pixels[0]
    assert verdicts[2]["name"].endswith("rmse on object pole 4 cm")
    assert len({v["value"] for v in verdicts}) == 4


def test_a_region_out_of_sight_is_refused(refused, write):
    write('scene = "posts"\nmetric = "rmse"\nmax = 9\nsize = "1x1"\nregion = { object = "rail" }\n')
    message = refused("gate")
    assert "no pixel of posts is on object rail" in message and "limit[0]" in message


def test_a_baseline_from_missing_to_regressed(run, refused, write, tmp_path):
    """Missing, written, held; then a stored value that today's is worse than; then one of another device."""
    import json

    path = tmp_path / "lightmeter.baseline.json"
    write(of_plane("rmse", "regression = 0.5", 'of = "narkowicz"'))
    assert "--update" in refused("gate")
    found = run("gate", "--update")
    assert found.code == 0 and "plane/narkowicz/rmse: 0.003" in found.out and "(new" in found.out
    first = path.read_text()
    assert run("gate", "--update").code == 0
    assert path.read_text() == first
    assert list(json.loads(first)["values"]) == ["plane/narkowicz/rmse"]
    found = run("gate", "--json")
    assert found.json["verdicts"][0]["status"] == "PASS", found

    def store(**changes) -> None:
        document = json.loads(first)
        document["values"]["plane/narkowicz/rmse"] |= changes
        path.write_text(json.dumps(document))

    store(value=0.001, low=0.00099, high=0.00101)
    found = run("gate", "--json")
    assert (found.code, found.json["verdicts"][0]["status"]) == (1, "FAIL")
    store(value=0.002, low=0.0001, high=0.1)
    assert run("gate", "--json").json["verdicts"][0]["status"] == "UNDECIDED"
    store(device="elsewhere")
    found = run("gate", "--json")
    assert "device elsewhere" in found.json["verdicts"][0]["message"]
    assert "2 % more" in found.json["verdicts"][0]["message"]
    for damaged in ("{", "[]", first.replace('"schema": 1', '"schema": 9'), first.replace('"low"', '"lwo"')):
        path.write_text(damaged)
        assert "lightmeter.baseline.json" in refused("gate")
    write(HOLDS)
    assert "regression" in refused("gate", "--update")


def test_markdown_and_json_are_written_beside_each_other(run, write, tmp_path):
    from PIL import Image

    write(HOLDS, FAILS, UNDECIDED)
    found = run("gate", "--markdown", "out/comment.md", "--json-file", "out/gate.json")
    assert found.code == 1
    text = (tmp_path / "out" / "comment.md").read_text()
    assert text.startswith("### ❌ lightmeter: 1 failed, 1 undecided, 1 held")
    assert "plane/narkowicz" in text.split("<details>")[0]
    for name in ("comment.1.png", "comment.2.png"):
        assert f"![FLIP]({name})" in text
        with Image.open(tmp_path / "out" / name) as picture:
            assert picture.size == (160, 160)
    import json

    verdict = json.loads((tmp_path / "out" / "gate.json").read_text())["verdicts"][2]
    assert verdict["looks"] == 3 and verdict["samples"] == 16 and verdict["pixels"] == 256
    assert 0 < verdict["error"] < 0.001 / 2.9 and "larger spp" in verdict["reason"]
