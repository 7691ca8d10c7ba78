"""`lightmeter compare --candidate …` as a user runs it."""

import json
import sys

import numpy as np
import pytest

from lightmeter.reports.image_files import write_channels, write_exr
from lightmeter.scenes.image_files.reading import read_image

from .frames import channels, own_renderer, write_own_frame

SIZE = ("--size", "32x32", "--spp", "8")
ENGINE = """
import sys
from lightmeter.reports.image_files import write_exr
import numpy
path, width, height, kind = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
image = numpy.full((height, width, 3), 0.25, numpy.float32)
if kind == "nan":
    image[3, 4] = numpy.nan
if kind == "tiny":
    image = image[:1, :1]
if kind == "elsewhere":
    path = path + ".other"
if kind == "fail":
    sys.exit("no display")
write_exr(path, image)
"""


@pytest.fixture
def engine(tmp_path):
    """A command line that renders grey, or misbehaves."""
    (tmp_path / "engine.py").write_text(ENGINE)
    return lambda kind: f"{kind}={sys.executable} {tmp_path / 'engine.py'} {{exr}} {{w}} {{h}} {kind}"


def found(tmp_path, out="out"):
    return json.loads((tmp_path / out / "results.json").read_text())


def test_our_own_frame_handed_back_has_the_identical_numbers(run, tmp_path):
    assert run("compare", "torus", *SIZE, "-o", "first", "--no-shares").code == 0
    ran = run("compare", "torus", *SIZE, "-o", "out", "--no-shares", "--candidate", "again=first/layers.exr")
    assert ran.code == 0, ran.err
    results = found(tmp_path)
    ours, again = results["candidates"]
    assert (ours["name"], again["name"]) == ("lightmeter", "again")
    frame = found(tmp_path, "first")["frame"]["metrics"]
    assert len(again["metrics"]) > 10
    for name, measured in again["metrics"].items():
        assert measured == ours["metrics"][name] == frame[name], name
    assert again["findings"] == []
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "again" in page
    tested = read_image(tmp_path / "out" / "layers.exr", layer="again.tested")
    assert np.array_equal(tested, read_image(tmp_path / "first" / "layers.exr"))


def test_a_command_gets_the_scene_and_its_frame_is_measured(run, tmp_path, engine):
    ran = run("compare", "plane", *SIZE, "-o", "out", "--candidate-command", engine("grey"))
    assert ran.code == 0, ran.err
    grey = found(tmp_path)["candidates"][1]
    truth = read_image(tmp_path / "out" / "layers.exr", layer="frame.truth")
    assert grey["metrics"]["bias"]["value"] == pytest.approx(0.25 - float(truth.mean()), abs=1e-6)
    assert grey["time_whole"]
    kept = tmp_path / "out" / "candidates"
    assert {"scene.gltf", "camera.json"} <= {path.name for path in (kept / "scene").iterdir()}
    assert (kept / "grey" / "frame.exr").is_file()


@pytest.mark.parametrize(
    ("kind", "said"),
    [("tiny", "got 1×1"), ("elsewhere", "there is no image"), ("fail", "exit code 1; its last output: no display")],
)
def test_a_command_that_gives_no_frame_is_told_at_once(refused, engine, kind, said):
    assert said in refused("compare", "plane", *SIZE, "--candidate-command", engine(kind))


def test_one_that_fails_does_not_stop_the_others(run, tmp_path, engine):
    both = ("--candidate-command", engine("fail"), "--candidate-command", engine("grey"))
    ran = run("compare", "plane", *SIZE, "-o", "out", *both)
    assert ran.code == 2
    assert "no display" in ran.err
    results = found(tmp_path)
    assert [one["name"] for one in results["candidates"]] == ["lightmeter", "grey"]
    assert results["failed_candidates"][0]["name"] == "fail"


def test_what_is_not_finite_is_counted_and_fails_its_metrics(run, tmp_path, engine):
    ran = run("compare", "plane", *SIZE, "-o", "out", "--candidate-command", engine("nan"))
    assert ran.code == 0, ran.err
    nan = found(tmp_path)["candidates"][1]
    assert nan["nonfinite"] == 1
    assert nan["metrics"]["rmse"]["value"] == "NaN"


def test_layers_have_the_errors_that_our_effects_have(run, tmp_path):
    """The buffers are the same, so the errors are: one light, so that an effect is one layer."""
    write_own_frame(tmp_path / "frame.exr", own_renderer("torus", (32, 32)))
    ran = run("compare", "torus", *SIZE, "-o", "out", "--candidate", "frame.exr")
    assert ran.code == 0, ran.err
    results = found(tmp_path)
    layers = {layer["layer"]: layer for layer in results["candidates"][1]["layers"]}
    own = {effect["effect"]: effect["metrics"] for effect in results["effects"]}
    for layer, effect in (("direct.0", "cook_torrance"), ("visibility.0", "shadow_map")):
        for metric in ("rmse", "nrmse", "relative_bias", "flip"):
            assert layers[layer]["metrics"][metric] == own[effect][metric], (layer, metric)
    # Normals are written in float32: 2⁻²⁴ of a unit vector is 3.4e-6°, and normalising adds two roundings a component.
    assert layers["normal"]["metrics"]["rmse"]["value"] < 3 * 2 * np.degrees(2.0**-24)
    # Depth of at most 16 m in float32.
    assert layers["depth"]["metrics"]["rmse"]["value"] < 16 * 2.0**-23
    # constant_ambient gives two terms, which are two layers and two players here.
    shared = results["candidates"][1]["attribution"]
    players = {player["name"]: player["share"]["mse"]["value"] for player in shared["players"]}
    theirs = {player["name"]: player["share"]["mse"]["value"] for player in results["attribution"]["players"]}
    assert sum(players.values()) + shared["residual"]["mse"]["value"] == pytest.approx(
        results["attribution"]["total"]["mse"]["value"], rel=1e-9
    )
    # The same buffers: shadows explain as much, but for the partners that the players have.
    assert players["visibility"] == pytest.approx(theirs["shadow_map"], abs=0.02 * sum(map(abs, theirs.values())))


def test_layers_that_do_not_add_up_to_the_frame_get_no_shares(run, tmp_path):
    image = np.full((32, 32, 3), 0.25, np.float32)
    write_channels(tmp_path / "a.exr", channels("", image) | channels("direct.0", image))
    assert run("compare", "torus", *SIZE, "-o", "out", "--candidate", "a.exr").code == 0
    one = found(tmp_path)["candidates"][1]
    assert one["attribution"] is None
    assert "away from the frame" in " ".join(one["notes"])


def test_a_layer_of_what_the_scene_lacks_is_refused(refused, tmp_path):
    image = np.full((32, 32, 3), 0.25, np.float32)
    write_channels(tmp_path / "a.exr", channels("", image) | channels("direct.7", image))
    assert "light 7, and torus has 1" in refused("compare", "torus", *SIZE, "--candidate", "a.exr")


def test_masked_pixels_are_counted_and_hide_what_is_wrong_there(run, tmp_path):
    """A frame that is wrong on one object alone is as good as ours once that object is not judged."""
    renderer = own_renderer("torus", (32, 32))
    image = renderer.render().radiance.copy()
    on_torus = renderer.capture(terms=False).points.shape == 1
    image[on_torus] = 1e6
    write_exr(tmp_path / "wrong.exr", image)
    (tmp_path / "wrong.json").write_text('{"unsupported": {"objects": ["torus"], "background": true}}')
    ran = run("compare", "torus", *SIZE, "-o", "out", "--no-shares", "--candidate", "wrong.exr")
    assert ran.code == 0, ran.err
    ours, wrong = found(tmp_path)["candidates"]
    assert wrong["masked"]["object torus is not supported by the engine"] == on_torus.sum()
    assert ours["pixels"] == wrong["pixels"] == 32 * 32 - sum(wrong["masked"].values())
    for name, measured in wrong["metrics"].items():
        assert measured["value"] == ours["metrics"][name]["value"], name


def test_a_name_that_the_scene_lacks_is_refused(refused, tmp_path):
    write_exr(tmp_path / "a.exr", np.ones((32, 32, 3), np.float32))
    (tmp_path / "a.json").write_text('{"unsupported": {"materials": ["trous"]}}')
    assert "did you mean 'torus'" in refused("compare", "torus", *SIZE, "--candidate", "a.exr")


def test_a_display_image_gets_display_metrics_alone(run, tmp_path):
    assert run("compare", "plane", *SIZE, "-o", "first", "--no-shares").code == 0
    write_exr(tmp_path / "shown.exr", np.clip(read_image(tmp_path / "first" / "layers.exr"), 0, 1))
    words = ("--candidate", "shown.exr", "--transfer", "gamma22")
    assert run("compare", "plane", *SIZE, "-o", "out", "--no-shares", *words).code == 0
    one = found(tmp_path)["candidates"][1]
    assert "flip" in one["metrics"]
    assert "rmse" not in one["metrics"]


def test_a_fault_is_named_and_corrected_only_when_asked(run, tmp_path):
    """A frame mirrored left to right, of a scene that is not its own mirror image."""
    size = ("--size", "64x64", "--spp", "8")
    image = own_renderer("torus", (64, 64)).render().radiance
    write_exr(tmp_path / "mirrored.exr", image[:, ::-1])
    for register, corrected in ((), False), (("--register", "flip"), True):
        words = ("-o", "out", "--no-shares", "--candidate", "mirrored.exr", *register)
        ran = run("compare", "torus", *size, *words)
        assert ran.code == 0, ran.err
        ours, theirs = found(tmp_path)["candidates"]
        assert [(one["fault"], one["corrected"]) for one in theirs["findings"]] == [("flip", corrected)]
        assert (theirs["metrics"]["rmse"] == ours["metrics"]["rmse"]) == corrected
        assert "mirrored" in ran.out
