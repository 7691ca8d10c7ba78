"""Real-time `direct` against its oracle, at the same points: the two sides' own code, light by light."""

import numpy as np
import pytest

from lightmeter.groundtruth.oracles import direct
from lightmeter.groundtruth.world import World
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load

from ..realtime.direct_definition import EPS, bound, exact_direct, inputs_of


@pytest.fixture(scope="module")
def grid():
    """The metalness × roughness grid without shadows: scene, world, capture."""
    scene = load("metal-rough-grid")
    plan = compile_plan(scene, effects(), Choice(without=("shadow_map",)))
    return scene, World.of(scene), Renderer(Device(), plan, (128, 128)).capture((0.13, -0.27))


@pytest.mark.parametrize("light", [0, 1, 2], ids=["point", "spot", "directional"])
def test_every_light_is_its_oracle_to_rounding(grid, light):
    """The oracle is evaluated in double precision from float32 inputs and stored in float32: one rounding more."""
    scene, world, seen = grid
    oracle = direct.evaluate(world, seen.points, light)
    hit = seen.points.hit
    inputs = inputs_of(seen.points, scene.lights[light])
    value = exact_direct(scene.lights[light], *inputs)
    allowed = bound(scene.lights[light], inputs, value) + EPS * np.abs(value)
    to_light = inputs[0] - inputs[1] * (light != 2)
    to_light = to_light / np.linalg.norm(to_light, axis=0)
    # Where float32 cannot tell the sign of n·l or n·v, either branch is right.
    clear = np.all([np.abs(np.sum(inputs[2] * d, axis=0)) >= 16 * EPS for d in (inputs[3], to_light)], axis=0)
    difference = np.abs(seen.direct[light][hit].T.astype(np.float64) - oracle[hit].T)
    assert clear.mean() > 0.999
    assert (oracle[hit] > 0).mean() > 0.1
    assert (difference[:, clear] <= allowed[:, clear]).all()
