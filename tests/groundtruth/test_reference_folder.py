"""A reference as a folder: it comes back whole, or says what is wrong."""

import json
from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth import folder
from lightmeter.groundtruth.batches import collect, series
from lightmeter.groundtruth.content import scene_key
from lightmeter.groundtruth.folder import ReferenceFolderError
from lightmeter.scenes.model import Environment, Scene, Shape
from lightmeter.scenes.shapes.forms import Sphere
from lightmeter.scenes.true_surface import true_surface

from .small_scenes import WHITE, floor, looking

SCENE = Scene(
    "room",
    (Shape("floor", floor(), WHITE),),
    looking((0, 1, 2), (0, 0, 0), yfov=0.8),
    environment=Environment((1, 1, 1)),
)
BALL = Sphere(0.5)


@pytest.fixture
def saved(tmp_path):
    images = list(np.random.default_rng(0).random((8, 6, 10, 3)).astype(np.float32))
    reference = collect(images, series(SCENE, (10, 6), 32, 4), 12.5, 0)
    size = folder.save(tmp_path / "truth", SCENE, reference)
    assert size == sum(p.stat().st_size for p in (tmp_path / "truth").iterdir())
    return tmp_path / "truth", reference


def test_it_comes_back(saved):
    path, reference = saved
    told = []
    again = folder.load(path, SCENE, (10, 6), told.append)
    np.testing.assert_array_equal(again.batches, reference.batches)
    assert (again.spp, again.seed, again.seconds, again.key) == (32, 4, 12.5, reference.key)
    assert told == []
    assert len(folder.load(path, replace(SCENE, name="renamed")).batches) == 8


def test_of_the_true_surface_and_of_the_surface_as_given_one_does_not_stand_for_the_other(saved, tmp_path):
    _, reference = saved
    ball = replace(SCENE, shapes=(Shape("ball", BALL.mesh(8), WHITE, form=BALL),))
    true = true_surface(ball)
    folder.save(tmp_path / "given", ball, replace(reference, scene_key=scene_key(ball)))
    folder.save(tmp_path / "true", true, replace(reference, scene_key=scene_key(true)))
    with pytest.raises(ReferenceFolderError, match=r"the true one.*lightmeter reference room --true-surface -o"):
        folder.load(tmp_path / "given", true)
    with pytest.raises(ReferenceFolderError, match=r"no effect draws another.*`--use`.*lightmeter reference room -o"):
        folder.load(tmp_path / "true", ball)
    assert len(folder.load(tmp_path / "given", ball).batches) == len(folder.load(tmp_path / "true", true).batches) == 8


def test_another_scene_size_or_version_is_told(saved):
    path, _ = saved
    with pytest.raises(ReferenceFolderError, match=r"another scene.*lightmeter reference room -o"):
        folder.load(path, replace(SCENE, max_depth=2))
    with pytest.raises(
        ReferenceFolderError, match=r"expected 20 × 6 pixels, got 10 × 6.*--size 10x6`.*`lightmeter .* --size 20x6`$"
    ):
        folder.load(path, SCENE, (20, 6))
    manifest = json.loads((path / "manifest.json").read_text())
    (path / "manifest.json").write_text(json.dumps(manifest | {"versions": "mitsuba 2"}))
    told = []
    folder.load(path, SCENE, None, told.append)
    assert "mitsuba 2" in told[0]


def test_a_reference_of_the_other_truth_is_refused(saved, tmp_path):
    path, reference = saved
    assert json.loads((path / "manifest.json").read_text())["truth"] == "single"
    with pytest.raises(
        ReferenceFolderError,
        match=r"expected the truth 'multiscatter', got 'single'.*`lightmeter .* --truth multiscatter`$",
    ):
        folder.load(path, SCENE, scattering="multiscatter")
    folder.save(tmp_path / "other", SCENE, replace(reference, scattering="multiscatter"))
    with pytest.raises(ReferenceFolderError, match="expected the truth 'single', got 'multiscatter'"):
        folder.load(tmp_path / "other", SCENE)
    assert folder.load(tmp_path / "other", SCENE, scattering="multiscatter").scattering == "multiscatter"


def test_a_reference_from_before_there_was_a_choice_is_of_the_usual_truth(saved):
    path, _ = saved
    manifest = json.loads((path / "manifest.json").read_text())
    del manifest["truth"]
    (path / "manifest.json").write_text(json.dumps(manifest))
    assert folder.load(path, SCENE).scattering == "single"


def test_damage_is_named(saved, capfd):
    path, _ = saved
    file = path / "batch-0002.exr"
    content = file.read_bytes()
    file.write_bytes(content[:200] + b"\0" + content[201:])
    with pytest.raises(ReferenceFolderError, match=r"batch-0002\.exr is damaged"):
        folder.load(path, SCENE)
    file.write_bytes((path / "batch-0003.exr").read_bytes())
    with pytest.raises(ReferenceFolderError, match="is not the file"):
        folder.load(path, SCENE)
    file.unlink()
    with pytest.raises(ReferenceFolderError, match="is missing"):
        folder.load(path, SCENE)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"schema": 99}, "schema: expected 1, got 99"),
        ({"spp": "many"}, "spp is missing or of the wrong type"),
        ({"size": [10]}, "size: expected two numbers"),
        ({"size": [10, 10**9]}, "size: expected two numbers"),
        ({"batches": 9}, "expected 9 batches, got 8"),
        ({"files": {"../a.exr": "0", "b": "1"}, "batches": 2}, "not a plain file name"),
    ],
)
def test_a_lying_manifest_is_refused(saved, change, message):
    path, _ = saved
    manifest = json.loads((path / "manifest.json").read_text())
    (path / "manifest.json").write_text(json.dumps(manifest | change))
    with pytest.raises(ReferenceFolderError, match=message):
        folder.load(path, SCENE)


def test_no_manifest_or_no_json(saved, tmp_path):
    path, _ = saved
    with pytest.raises(ReferenceFolderError, match="is missing"):
        folder.load(tmp_path / "elsewhere", SCENE)
    (path / "manifest.json").write_bytes(b"{\xff")
    with pytest.raises(ReferenceFolderError, match="cannot be read"):
        folder.load(path, SCENE)
    (path / "manifest.json").write_text("[" * 100000)
    with pytest.raises(ReferenceFolderError, match="is not JSON"):
        folder.load(path, SCENE)
