"""The sky that is drawn behind everything, against the definition."""

import numpy as np
import pytest

from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Environment, Image, Scene
from lightmeter.scenes.optics import environment as optics

from .ray_casting import rays
from .small_scenes import renderer

SIZE = (48, 32)


def sky(camera: Camera, rotation: float = 0.4) -> Scene:
    texels = np.random.default_rng(3).uniform(0, 1, (9, 17, 3)).astype(np.float32)
    texels[4, 9] = 1000.0  # a sun, which rounded weights would show
    return Scene("sky", (), camera, environment=Environment((1.0, 0.5, 2.0), Image(texels), rotation))


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.3, -0.2)])
@pytest.mark.parametrize("target", [(1.0, 0.2, 0.3), (-1.0, -0.5, 0.4), (0.1, 3.0, 0.2)])
def test_every_pixel_looks_where_the_definition_says(device, target, offset):
    camera = Camera("c", look_at((0.0, 0.0, 0.0), target), yfov=1.2)
    scene = sky(camera)
    made = renderer(device, scene, SIZE).capture(offset, terms=False).points.emission
    _, towards = rays(camera, SIZE, offset)
    unit = (towards / np.linalg.norm(towards, axis=-1, keepdims=True)).reshape(-1, 3).T
    exact = optics.radiance(scene.environment, unit).T.reshape(made.shape)
    # A float32 direction is off by some 2⁻²² of a radian, GLSL's atan by up to 4096 · 2⁻²⁴ · π. A map of 17 columns
    # turns a radian into 17/2π texels, and a texel into a step of 1000, in both directions: 4.2 at most. A mistake of
    # half a texel would be off by 500.
    assert np.abs(made - exact).max() < 1000 * 2 * 17 / (2 * np.pi) * (2**-22 + 4096 * 2**-24 * np.pi)
    assert np.median(np.abs(made - exact) / exact) < 1e-4


def test_parallel_rays_all_look_the_same_way(device):
    camera = Camera("c", look_at((0.0, 0.0, 0.0), (1.0, 0.3, 0.2)), ymag=1.0)
    made = renderer(device, sky(camera), SIZE).capture((0.0, 0.0), terms=False).points.emission
    assert np.ptp(made.reshape(-1, 3), axis=0).max() == 0
    forward = -camera.matrix[:3, 2][:, None]
    np.testing.assert_allclose(made[0, 0], optics.radiance(sky(camera).environment, forward)[:, 0], rtol=1e-2)


def test_a_constant_environment_needs_no_texture(device):
    camera = Camera("c", look_at((0.0, 0.0, 0.0), (1.0, 0.3, 0.2)), yfov=1.0)
    before = device.counts["textures"]
    renderer(device, Scene("s", (), camera, environment=Environment((1.0, 1.0, 1.0))), SIZE)
    plain = device.counts["textures"] - before
    renderer(device, sky(camera), SIZE)
    assert device.counts["textures"] - before - plain > plain
