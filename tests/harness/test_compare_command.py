"""`lightmeter compare` as a user runs it, on the simplest scene."""

import io
import json
import shutil
import subprocess
import sys
from contextlib import redirect_stdout
from pathlib import Path

import numpy as np
import pytest

from lightmeter.cli import main

SIZE = ("--size", "32x24", "--spp", "8")

KEYS = {
    "schema": int,
    "scene": str,
    "size": list,
    "device": dict,
    "reference": dict,
    "frame": dict,
    "effects": list,
    "closure": dict,
    "left_out": list,
    "nonfinite": dict,
}
"""Keys that other tools read (design, section 6); more may come, none may go."""


@pytest.fixture(scope="module")
def compared(shared_store, tmp_path_factory) -> tuple[str, Path]:
    """The plane, compared: what was printed, and the folder that was written."""
    folder, printed = tmp_path_factory.mktemp("compared"), io.StringIO()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(printed):
        patch.chdir(folder)
        patch.setenv("LIGHTMETER_STORE", str(shared_store))
        assert main(["compare", "plane", *SIZE, "-o", "out"]) == 0
    return printed.getvalue(), folder / "out"


def test_the_report_and_all_that_belongs_to_it_is_written(compared):
    printed, out = compared
    assert f"report: {Path('out') / 'report.html'}" in printed
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "<html" in page
    heatmaps = {path.name for path in (out / "heatmaps").glob("*.png")}
    assert {"frame.flip.png", "frame.rms.png", "frame.signed.png", "cook_torrance.rms.png"} <= heatmaps
    assert {path.name for path in out.iterdir()} == {"report.html", "results.json", "heatmaps", "layers.exr"}


def test_the_layers_hold_what_the_report_shows(compared):
    from lightmeter.scenes.image_files.reading import read_image

    layers = compared[1] / "layers.exr"
    tested = read_image(layers, layer="frame.tested")
    truth = read_image(layers, layer="frame.truth")
    assert tested.shape == (24, 32, 3)
    assert np.abs(tested.mean() / truth.mean() - 1) < 0.05
    assert np.array_equal(read_image(layers), tested)


def test_results_have_the_keys_that_must_stay(compared):
    document = json.loads((compared[1] / "results.json").read_text())
    assert {key: type(document[key]) for key in KEYS} == KEYS
    assert document["schema"] == 1
    assert document["size"] == [32, 24]
    assert {"spp", "batches", "seconds", "cached"} <= document["reference"].keys()
    assert {"median", "mad", "frames"} <= document["frame"]["time_ms"].keys()
    assert document["frame"]["time_ms"]["frames"] >= 20
    for metrics in (document["frame"]["metrics"], document["closure"]["metrics"]):
        assert all({"value", "low", "high"} <= metric.keys() for metric in metrics.values())
    assert {"value", "low", "high"} <= document["closure"]["bias"].keys()
    for effect in document["effects"]:
        assert {"effect", "terms", "knobs", "metrics", "time_ms", "share"} <= effect.keys()
    assert all({"what", "why"} <= item.keys() for item in document["left_out"])
    assert {"frame", "effects"} <= document["nonfinite"].keys()


def test_json_on_stdout_is_the_results_file(run, tmp_path):
    found = run("compare", "plane", *SIZE, "-o", "out", "--json")
    assert found.code == 0
    assert found.out == (tmp_path / "out" / "results.json").read_text(encoding="utf-8")


def test_a_choice_of_effects_and_knobs_is_taken(run):
    words = ("--set", "supersampling.grid=2", "--without", "narkowicz", "--use", "gamma_22")
    found = run("compare", "plane", *SIZE, *words, "-o", "out", "--json")
    effects = {effect["effect"]: effect["knobs"] for effect in found.json["effects"]}
    assert effects["supersampling"]["grid"] == 2
    assert "gamma_22" in effects
    assert "narkowicz" not in effects
    left_out = {item["what"]: item["why"] for item in found.json["left_out"]}
    assert left_out["narkowicz"] == "left out as asked"


def test_only_the_oracles_that_the_plan_needs_are_evaluated(run, monkeypatch):
    """The plane has one light and nothing else: no shadow, no environment, no second bounce, no texture."""
    from lightmeter import truth

    asked, recall = [], truth.recall

    def record(store, term, *args, **options):
        asked.append(term)
        return recall(store, term, *args, **options)

    monkeypatch.setattr(truth, "recall", record)
    assert run("compare", "plane", *SIZE, "-o", "out", "--no-store").code == 0
    assert set(asked) == {"direct"}


def test_no_other_oracle_is_even_imported(shared_store, tmp_path):
    """As a user runs it, in a process of its own."""
    source = (
        "import json, sys\n"
        "from lightmeter.cli import main\n"
        f"code = main({['compare', 'plane', *SIZE, '-o', str(tmp_path / 'out'), '--no-store']!r})\n"
        "prefix = 'lightmeter.groundtruth.oracles.'\n"
        "names = [name.removeprefix(prefix) for name in sys.modules if name.startswith(prefix)]\n"
        "print(json.dumps([code, sorted(names)]))\n"
    )
    done = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=False, timeout=120)
    code, names = json.loads(done.stdout.splitlines()[-1])
    assert code == 0, done.stderr
    assert set(names) <= {"direct", "coverage", "tone", "encode"}
    assert done.stderr == ""


def test_a_saved_reference_gives_the_same_numbers(run, compared):
    assert run("reference", "plane", *SIZE, "-o", "truth").code == 0
    found = run("compare", "plane", *SIZE, "-o", "out", "--reference", "truth", "--json")
    assert found.code == 0
    traced = json.loads((compared[1] / "results.json").read_text())
    assert found.json["frame"]["metrics"] == traced["frame"]["metrics"]
    assert traced["reference"]["cached"] is False
    assert found.json["reference"]["cached"] is True


def damage_nothing(folder):
    shutil.rmtree(folder)


def damage_cut(folder):
    path = next(folder.glob("*.exr"))
    path.write_bytes(path.read_bytes()[:-200])


def damage_bit(folder):
    path = next(folder.glob("*.exr"))
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)


def damage_missing(folder):
    next(folder.glob("*.exr")).unlink()


def damage_swapped(folder):
    first, second = sorted(folder.glob("*.exr"))[:2]
    shutil.copy(first, second)


def damage_manifest(folder):
    (folder / "manifest.json").write_text("{")


def damage_climbing(folder):
    path = folder / "manifest.json"
    manifest = json.loads(path.read_text())
    files = list(manifest["files"].items())
    manifest["files"] = dict([("../" + files[0][0], files[0][1]), *files[1:]])
    path.write_text(json.dumps(manifest))


@pytest.mark.parametrize(
    ("damage", "named"),
    [
        (damage_nothing, "manifest.json is missing"),
        (damage_cut, "batch-"),
        (damage_bit, "batch-"),
        (damage_missing, "is missing"),
        (damage_swapped, "batch-"),
        (damage_manifest, "manifest.json"),
        (damage_climbing, "plain file name"),
    ],
)
def test_a_damaged_reference_folder_is_refused_with_its_fault(run, refused, tmp_path, damage, named):
    assert run("reference", "plane", *SIZE, "-o", "truth").code == 0
    damage(tmp_path / "truth")
    message = refused("compare", "plane", *SIZE, "-o", "out", "--reference", "truth")
    assert named in message
    assert "lightmeter reference" in message or damage is damage_climbing


def test_a_reference_of_something_else_is_refused(run, refused):
    assert run("reference", "plane", *SIZE, "-o", "truth").code == 0
    assert "another scene" in refused("compare", "posts", *SIZE, "-o", "out", "--reference", "truth")
    message = refused("compare", "plane", "--size", "24x32", "--spp", "8", "-o", "out", "--reference", "truth")
    assert "--size 32x24" in message


def test_a_scene_file_is_compared_like_one_of_the_library(run, tmp_path):
    from lightmeter.scenes import library

    shutil.copy(library.path("plane"), tmp_path / "mine.toml")
    found = run("compare", "mine.toml", *SIZE, "--json")
    assert found.code == 0
    assert found.json["scene"] == "mine"
    assert (tmp_path / "lightmeter-out" / "mine" / "report.html").exists()
