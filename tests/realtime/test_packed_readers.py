"""Effects that read the G-buffer at other pixels, or in passes of their own, find places that are stored as depths."""

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load


@pytest.mark.parametrize(
    ("scene", "name", "knobs"),
    [
        ("corner", "ssao", {}),
        ("corner", "gtao", {}),
        ("mirrors", "screen_space_reflections", {"march": "hierarchical"}),
        ("cornell-box", "screen_space_indirect", {}),
        ("cornell-box", "virtual_lights", {"tile": 4, "lights": 64}),
    ],
)
def test_places_stored_as_depths_are_found(device, scene, name, knobs):
    """A float holds a depth to 6e-8 of it, which moves a place by far less than a pixel: only what hangs on a
    comparison may change, at few pixels. A reader that is not told where a depth's pixel lies errs by 12 % of the mean.
    """

    def frame(**packed):
        settings = {name: knobs} | packed
        plan = compile_plan(load(scene), effects(), Choice(use=(name, *packed), settings=settings))
        return Renderer(device, plan, (48, 48)).render().radiance

    floats = frame()
    depths = frame(packed_surface={"position": "depth", "depth_encoding": "reversed", "depth_bits": 32})
    assert np.abs(depths - floats).mean() < 0.01 * floats.mean()
