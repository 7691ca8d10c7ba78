"""A scene of one's own beside its copies: where its frame depends on its size, the knob in metres is named."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.graph import Choice
from lightmeter.reports.stiff_results import SAME
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.stiff import chosen
from lightmeter.scenes.stiff.copies import copies
from lightmeter.stiff_scenes import examine

SCENE = "corner"


def test_the_knob_in_metres_is_named():
    cases = {name: replace(case, size=(12, 12)) for name, case in copies(SCENE).items()}
    asked = {name: case for name, case in cases.items() if name in (SCENE, f"{SCENE} large")}
    choice = Choice(use=("gtao",), settings={"gtao": {"radius": 0.5}})
    same, large = examine(asked, cases, choice=choice, words=" --use gtao")
    assert large.frame_changed > SAME
    assert large.blame[0][0] == "gtao"
    assert large.lengths == ("gtao.radius = 0.5 m",)
    assert large.commands == (f"lightmeter stress --scenes {SCENE} --use gtao",)
    assert same.commands == (*large.commands, f"lightmeter compare {SCENE} --size 12x12 --use gtao")


def test_a_copy_far_away_is_whole():
    """A thousand times its reach away, float32 has 24 − 10 bits, less one for the power of two, for what is seen."""
    scenes = {name: case.scene() for name, case in copies(SCENE).items()}
    near, far = scenes[SCENE], scenes[f"{SCENE} far"]
    reach = np.abs(np.stack([*near.bounds, near.camera.position])).max()
    shift = far.camera.position[0] - near.camera.position[0]
    assert 1024 * reach <= shift <= 2048 * reach


def test_what_is_no_scene_is_named():
    assert list(chosen([SCENE, "small"]))[:2] == ["small", SCENE]
    with pytest.raises(SceneError, match=r"missing\.toml"):
        chosen(["missing.toml"])
