"""Several renderers in one process, as `gate` makes them: none may free what is another's."""

import numpy as np

from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load


def test_a_renderer_that_is_forgotten_takes_nothing_with_it(device):
    plan = compile_plan(load("plane"), effects())
    first = Renderer(device, plan, (16, 16)).render().radiance
    for _ in range(3):
        renderer = Renderer(Device(), plan, (16, 16))  # the one before is freed only now
        assert np.array_equal(renderer.render().radiance, first)
        assert np.array_equal(np.unique(renderer.capture().points.shape), [0])
