"""Which definition of a rough surface an engine follows."""

import numpy as np
import pytest

from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.definitions import follows
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


def test_a_display_image_is_judged_by_flip():
    near, far = ({"flip": Measurement(x, x - 0.01, x + 0.01)} for x in (0.1, 0.2))
    assert follows({"single": far, "multiscatter": near}) == "multiscatter"


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
    assert any("single and multiscatter are" in note and "apart" in note for note in found.notes)
    assert "against multiscatter: follows multiscatter" in definition_words(found.candidates[2])
    again = from_json(to_json(found))
    assert [one.truths for one in again.candidates] == [one.truths for one in found.candidates]
