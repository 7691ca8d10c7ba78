"""Which definition of a rough surface an engine follows."""

import numpy as np
import pytest

from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.definitions import follows, told_apart
from lightmeter.comparison import compare
from lightmeter.groundtruth.batch_file import write
from lightmeter.metrics.measurement import Measurement
from lightmeter.options import Budget
from lightmeter.reports.candidate_words import definition_words
from lightmeter.reports.results_json import from_json, to_json
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Material, Scene, Shape
from lightmeter.truth import Truth


def measured(low: float, high: float) -> dict[str, Measurement]:
    return {"rmse": Measurement((low + high) / 2, low, high)}


def test_only_intervals_that_are_apart_decide():
    assert follows({"single": measured(1, 2), "multiscatter": measured(3, 4)}) == "single"
    assert follows({"single": measured(3, 4), "multiscatter": measured(1, 2)}) == "multiscatter"
    assert follows({"single": measured(1, 3), "multiscatter": measured(2, 4)}) == ""
    assert follows({"single": {"rmse": Measurement(1)}, "multiscatter": measured(2, 4)}) == ""


def test_flip_decides_where_there_is_no_radiance_or_fireflies_leave_it_open():
    near, far = ({"flip": Measurement(x, x - 0.01, x + 0.01)} for x in (0.1, 0.2))
    assert follows({"single": far, "multiscatter": near}) == "multiscatter"
    assert follows({"single": measured(0, 9) | far, "multiscatter": measured(0, 9) | near}) == "multiscatter"
    assert follows({"single": measured(1, 2) | far, "multiscatter": measured(3, 4) | near}) == "single"


def test_pixels_tell_truths_apart_beyond_their_noise_alone():
    rng = np.random.default_rng(0)
    one, other = (rng.normal(1, 0.1, (8, 40, 50, 3)) for _ in range(2))
    other[:, :, :25] += 0.5
    where = told_apart({"one": one, "other": other})
    assert where[:, :25].all()
    assert where[:, 25:].mean() < 0.02
    assert not told_apart({"one": one, "other": one}).any()


def test_both_needs_a_candidate(refused):
    assert "--truth both: candidates are held against both" in refused("compare", "posts", "--truth", "both")


@pytest.fixture(scope="module")
def rough() -> Scene:
    """A rough metal ball in a grey environment and parallel light."""
    matrix = np.eye(4)
    matrix[2, 3] = 3
    ball = Shape("ball", shapes.sphere(1.0, 24), Material(base_color=(0.9, 0.9, 0.9), metallic=1, roughness=0.9))
    sun = DirectionalLight("sun", (-0.5, -0.5, -1), (2, 2, 2))
    return Scene("rough", (ball,), Camera("camera", matrix, yfov=0.9), (sun,), Environment((0.5, 0.5, 0.5)))


def test_path_traced_frames_follow_the_definition_that_they_were_made_by(rough, tmp_path):
    """Frames of both truths with random numbers of their own; each is told, and the truths are told apart."""
    size, candidates = (24, 24), []
    for name in ("single", "multiscatter"):
        frame = Truth(rough, size, Budget(64), scattering=name).path_traced(256, 3)
        write(tmp_path / f"{name}.exr", {"": frame}, {})
        candidates.append(Candidate(name, "file", str(tmp_path / f"{name}.exr")))
    found = compare(rough, size, Budget(256), shares=False, candidates=candidates, against="multiscatter").results
    assert {one.name: one.follows for one in found.candidates} == {
        "lightmeter": "single",
        "single": "single",
        "multiscatter": "multiscatter",
    }
    assert found.reference is not None and found.reference.truth == "single"
    assert any("single and multiscatter can be told apart in" in note for note in found.notes)
    assert definition_words(found.candidates[2]).startswith("follows multiscatter: RMSE ")
    again = from_json(to_json(found))
    assert [one.truths for one in again.candidates] == [one.truths for one in found.candidates]
