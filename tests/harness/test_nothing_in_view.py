"""A camera that sees no surface: nothing to shade, nothing to ask an oracle, and no error."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.comparison import compare
from lightmeter.options import Budget
from lightmeter.realtime.graph import Choice
from lightmeter.scenes.load import load


@pytest.mark.parametrize(
    ("name", "use"),
    [("torus", ("gtao",)), ("cornell-box", ("screen_space_reflections",)), ("tessellation", ("gouraud",))],
)
def test_a_camera_that_looks_away_compares_what_is_behind_everything(name, use):
    scene = load(name)
    matrix = scene.camera.matrix @ np.diag([-1.0, 1.0, -1.0, 1.0])  # turned round,
    matrix[:3, 3] *= 100  # and out of whatever it was in
    away = replace(scene, camera=replace(scene.camera, matrix=matrix))
    results = compare(away, (8, 8), Budget(8), choice=Choice(use=use)).results
    assert results.frame.metrics["rmse"].value == pytest.approx(0, abs=1e-6)
    shading = [effect for effect in results.effects if not {"tone", "encode"} & set(effect.terms)]
    assert shading
    for effect in shading:
        assert effect.metrics["rmse"].value == pytest.approx(0, abs=1e-6), effect.effect
