"""The measured frame against the definition: `direct` in float64 at the captured points, and the composition.

The bound is derived in `direct_definition.py`.
"""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.scenes.model import DirectionalLight, SpotLight

from .direct_definition import EPS, bound, exact_direct, inputs_of
from .small_scenes import renderer


@pytest.fixture(scope="module")
def grid(device):
    """The metalness × roughness grid, without shadows, and what was captured of it."""
    plan = compile_plan(load("metal-rough-grid"), effects(), Choice(without=("shadow_map",)))
    maker = Renderer(device, plan, (160, 160))
    return plan.scene, maker, maker.capture((0.17, -0.31))


@pytest.fixture(scope="module")
def ranged(device):
    """The same grid under lights whose ranges end among the spheres."""
    scene = load("metal-rough-grid")
    point, spot, _ = scene.lights
    scene = replace(scene, lights=(replace(point, range=7.5), replace(spot, range=6.4)))
    maker = Renderer(device, compile_plan(scene, effects(), Choice(without=("shadow_map",))), (96, 96))
    return scene, maker.capture()


@pytest.mark.parametrize("index", [0, 1])
def test_a_range_is_the_definition_to_rounding(ranged, index):
    """Within the range and beyond it; the grid is cut in two."""
    scene, seen = ranged
    light = scene.lights[index]
    inputs = inputs_of(seen.points, light)
    value = exact_direct(light, *inputs)
    got = seen.direct[index][seen.points.hit].T.astype(np.float64)
    facing = exact_direct(replace(light, range=None), *inputs) > 0
    assert 0.1 < (value[facing] > 0).mean() < 0.9
    _, normal, view = inputs[1:4]
    to_light = inputs[0] - inputs[1]
    to_light = to_light / np.linalg.norm(to_light, axis=0)
    unclear = np.any([np.abs(np.sum(normal * d, axis=0)) < 16 * EPS for d in (view, to_light)], axis=0)
    assert (np.abs(got - value) <= bound(light, inputs, value))[:, ~unclear].all()
    assert (got[(value == 0) & ~unclear] == 0).all()


@pytest.mark.parametrize("index", [0, 1, 2])
def test_direct_is_the_definition_to_rounding(grid, index, record_property):
    scene, _, seen = grid
    light = scene.lights[index]
    inputs = inputs_of(seen.points, light)
    value = exact_direct(light, *inputs)
    allowed = bound(light, inputs, value)
    got = seen.direct[index][seen.points.hit].T.astype(np.float64)
    _, normal, view = inputs[1:4]
    to_light = inputs[0] - inputs[1] * (not isinstance(light, DirectionalLight))
    to_light = to_light / np.linalg.norm(to_light, axis=0)
    unclear = np.any([np.abs(np.sum(normal * d, axis=0)) < 16 * EPS for d in (view, to_light)], axis=0)
    share = np.abs(got - value)[:, ~unclear] / allowed[:, ~unclear]
    record_property("share_of_the_bound", float(share.max()))
    assert (value > 0).mean() > (0.1 if index == 1 else 0.4)
    assert unclear.mean() < 1e-3
    assert share.max() <= 1
    # The bound is itself small: in the mean it would hide no convention mistake.
    assert allowed.mean() < 2e-3 * value.mean()
    error = np.abs(got - value).mean() / value.mean()
    record_property("mean_error", float(error))
    assert error < 2e-5


def test_a_cone_a_thousandth_narrower_would_be_noticed(grid):
    """The bound is tight enough to tell."""
    scene, _, seen = grid
    light = scene.lights[1]
    inputs = inputs_of(seen.points, light)
    value = exact_direct(light, *inputs)
    allowed = bound(light, inputs, value)
    narrower = SpotLight(light.name, light.position, light.direction, light.intensity, light.inner, light.outer * 0.999)
    assert (np.abs(exact_direct(narrower, *inputs) - value) > allowed).mean() > 0.01


@pytest.mark.parametrize("name", ["metal-rough-grid", "posts", "cornell-box", "torus", "control"])
def test_captured_terms_compose_to_the_frame(device, name):
    """The frame adds one product per step in float32: n additions and products, each half an ulp of the running sum."""
    maker = renderer(device, load(name), (64, 64))
    frame, seen = maker.render(), maker.capture()
    total = seen.points.emission.astype(np.float64)
    for light, direct in seen.direct.items():
        total += direct.astype(np.float64) * seen.visibility.get(light, 1.0)
    total += seen.frame.get("environment", 0.0) * np.asarray(seen.frame.get("environment_visibility", 1.0), np.float64)
    total += seen.frame.get("indirect", 0.0)
    steps = len(seen.direct) * 2 + 3
    assert np.isfinite(frame.radiance).all()
    assert np.abs(frame.radiance - total).max() <= steps * EPS * np.abs(total).max()
    assert (np.abs(frame.radiance - total) <= steps * EPS * np.abs(total) + 1e-12).all()


@pytest.mark.parametrize(
    "choice", [Choice(), Choice(use=("gamma_22", "hill")), Choice(use=("reinhard",)), Choice(without=("narkowicz",))]
)
def test_the_display_transform_is_the_device_s_to_eight_bit_rounding(device, choice):
    """Half a code for rounding, and what float32's pow may move it by: below 0.01 of a code."""
    scene = load("posts")
    scene = replace(scene, camera=replace(scene.camera, exposure=-0.7))
    maker = renderer(device, scene, (96, 96), choice)
    frame = maker.render()
    codes = display_transform(maker.plan)(frame.radiance.astype(np.float64)) * 255
    assert np.abs(frame.display - codes).max() <= 0.5 + 0.01
    assert np.ptp(frame.display) > 100


def test_supersampling_is_the_mean_of_its_offsets(device):
    """n × n samples: the mean of the frames that single offsets give, to n² roundings."""
    maker = renderer(device, load("torus"), (48, 48), Choice(settings={"supersampling": {"grid": 2}}))
    whole = maker.render().radiance.astype(np.float64)
    single = renderer(device, load("torus"), (48, 48))
    total = np.zeros_like(whole)
    for offset in maker.offsets:
        seen = single.capture(tuple(offset))
        total += seen.points.emission
        for light, direct in seen.direct.items():
            total += direct.astype(np.float64) * seen.visibility.get(light, 1.0)
        for term in ("environment", "indirect"):
            total += seen.frame.get(term, 0.0)
    assert len(maker.offsets) == 4
    assert np.abs(whole - total / 4).max() < 16 * EPS * total.max()
