"""The environment's map on the truth's side: its light, its densities, and what it puts on a plane."""

import math

import numpy as np
import pytest

from lightmeter.groundtruth.environment_map import MapEmitter
from lightmeter.groundtruth.oracles import environment as oracle
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.variant import mi
from lightmeter.groundtruth.world import World
from lightmeter.scenes.model import Environment, Image, Scene, Shape
from lightmeter.scenes.optics import environment as optics

from .small_scenes import WHITE, floor, looking, points_at

LANES = 1 << 18


def noise(peak: float = 1.0) -> Environment:
    texels = np.random.default_rng(5).uniform(0.1, 1, (9, 18, 3)).astype(np.float32)
    texels[2, 4] = peak
    texels[6] = 0.0  # a dark row
    return Environment((1.0, 2.0, 0.5), Image(texels), 0.9)


def lanes():
    rng = mi.PCG32(size=LANES, initstate=3)
    return rng.next_float32(), rng.next_float32()


@pytest.mark.parametrize("peak", [1.0, 50_000.0])
def test_drawn_directions_integrate_the_map(peak):
    env = noise(peak)
    emitter = MapEmitter(env, 10.0)
    direction, density = emitter.sample(*lanes())
    values = (emitter.radiance(direction) / density).numpy().astype(np.float64)
    exact = _integral(env)
    slack = 5 * values.std(axis=1) / math.sqrt(LANES)
    assert (np.abs(values.mean(axis=1) - exact) < slack).all(), (values.mean(axis=1), exact, slack)
    assert (
        slack < 0.02 * exact
    ).all()  # it draws where the light is: evenly drawn the peak's noise would be 20 times that


def _integral(env: Environment) -> np.ndarray:
    """∫ L dω on a grid of 8 × 8 points a texel; bilinear radiance times sin θ: the midpoint rule is off by 1e-4."""
    height, width = (8 * n for n in env.map.texels.shape[:2])
    u, v = (np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height
    uu, vv = np.meshgrid(u, v)
    d = np.array(optics.direction_at(uu.ravel(), vv.ravel(), env.rotation))
    weight = np.sin(np.pi * vv.ravel()) * 2 * np.pi**2 / (width * height)
    return optics.radiance(env, d) @ weight


def test_the_density_is_that_of_the_draw():
    emitter = MapEmitter(noise(100.0), 10.0)
    direction, density = emitter.sample(*lanes())
    ratio = (emitter.density(direction) / density).numpy()
    # A direction within rounding of a patch's edge may be taken for the neighbour's: some 1e-5 of the lanes.
    assert np.mean(np.abs(ratio - 1) > 1e-3) < 1e-3
    around = mi.warp.square_to_uniform_sphere(mi.Point2f(*lanes()))
    total = 4 * math.pi * emitter.density(around).numpy().astype(np.float64)
    assert abs(total.mean() - 1) < 5 * total.std() / math.sqrt(LANES)


def test_lookup_is_the_definition():
    env = noise()
    around = mi.warp.square_to_uniform_sphere(mi.Point2f(*lanes()))
    found = MapEmitter(env, 10.0).radiance(around).numpy()
    np.testing.assert_allclose(found, optics.radiance(env, around.numpy().astype(np.float64)), atol=2e-5)


def test_the_reference_sees_the_map_behind_everything():
    """A camera in the open: a pixel's mean is the definition's, averaged over 64 places of it."""
    camera = looking((0, 0, 0), (1, 0.3, 0.5), yfov=1.0)
    scene = Scene("open", (), camera, environment=noise())
    found = render_batch(World.of(scene), (6, 4), 1024, 1)
    n = 16
    places = (np.arange(n) + 0.5) / n
    x, y = np.meshgrid((np.arange(6)[:, None] + places).ravel(), (np.arange(4)[:, None] + places).ravel())
    right, up, back = camera.matrix[:3, :3].T
    half = math.tan(0.5)
    d = (2 * x / 6 - 1)[..., None] * half * 6 / 4 * right + (1 - 2 * y / 4)[..., None] * half * up - back
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    exact = optics.radiance(scene.environment, d.reshape(-1, 3).T).T.reshape(4, n, 6, n, 3).mean(axis=(1, 3))
    # 1,024 samples in a pattern; radiance varies by less than 2 within a pixel, plain sampling would be off by 0.06 σ.
    np.testing.assert_allclose(found, exact, atol=5 * 0.6 / math.sqrt(1024) + 0.01)


def test_a_diffuse_plane_reflects_its_irradiance_over_pi():
    """Oracle and path tracer against ∫ L cos θ dω / π, with a sun in the map."""
    env = noise(2000.0)
    height, width = (16 * n for n in env.map.texels.shape[:2])
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    d = np.array(optics.direction_at(u.ravel(), v.ravel(), env.rotation))
    weight = np.sin(np.pi * v.ravel()) * 2 * np.pi**2 / (width * height) * np.maximum(d[1], 0)
    exact = optics.radiance(env, d) @ weight / math.pi
    scene = Scene(
        "plane", (Shape("floor", floor(50), WHITE),), looking((0, 3, 0.1), (0, 0, 0), yfov=0.3), environment=env
    )
    world = World.of(scene)
    points = points_at(np.zeros((64, 3)), (0, 1, 0), (0, 1, 0))
    b = oracle.evaluate(world, points, spp=256).reshape(-1, 3).astype(np.float64)
    traced = render_batch(world, (8, 8), 256, 2).reshape(-1, 3).astype(np.float64)
    for found in (b, traced):
        slack = 5 * found.std(axis=0) / 8 + 1e-3 * exact
        assert (np.abs(found.mean(axis=0) - exact) < slack).all(), (found.mean(axis=0), exact, slack)
        assert (slack < 0.05 * exact).all()
