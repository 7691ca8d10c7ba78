"""What one renderer baked serves another of the same plan."""

import numpy as np
import pytest

from lightmeter.realtime.baking import Baking
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load


@pytest.mark.parametrize(
    ("scene", "effect", "knobs"),
    [
        ("corner", "baked_occlusion", {"directions": 8, "map": 32}),
        ("mirrors", "static_cube_map", {"size": 16}),
        ("cornell-box", "irradiance_probes", {"spacing": 1.0, "size": 4}),
    ],
)
def test_a_frame_is_the_same_with_what_another_renderer_baked(monkeypatch, scene, effect, knobs):
    device = Device()
    plan = compile_plan(load(scene), effects(), Choice(use=(effect,), settings={effect: knobs}))
    first = Renderer(device, plan, (16, 12))
    image = first.render().radiance
    monkeypatch.setattr(Baking, "of", lambda self, effect, bake: self._kept[effect])  # baking anew is a KeyError
    second = Renderer(device, plan, (16, 12), first.baking)
    del first
    assert effect in second.baking.milliseconds
    assert image.any() and np.array_equal(second.render().radiance, image)
