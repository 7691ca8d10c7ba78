"""Dielectric solids in the truth: closed forms of slabs, a furnace, composition."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth.oracles import indirect, transmission
from lightmeter.groundtruth.primary import surface_points
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.world import World
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.glass import glass
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Camera, Environment, Scene, Shape
from lightmeter.scenes.moving import scaled

from .noise import assert_mean, assert_same_mean

UP = Camera("across", look_at((0, 0, 3), (0, 0, 0)), ymag=0.1, near=0.1, far=10)


def slab(ior: float, left: float) -> Scene:
    """A wide slab, 0.4 m thick, that leaves a share of white light, between white skies."""
    material = glass("glass", ior, (left, 1.0, 0.5), 0.4)
    return Scene(
        "slab", (Shape("slab", shapes.box(400.0, 400.0, 0.4), material),), UP, (), Environment((1.0, 1.0, 1.0))
    )


@pytest.mark.parametrize("ior", [1.5, 2.417])
def test_a_slab_seen_straight_on(ior):
    """All orders summed: R + (1−R)²a(1 + Ra)/(1 − R²a²), a the share that one crossing leaves (Stokes 1862)."""
    left = np.array([0.6, 1.0, 0.5])
    r = ((ior - 1) / (ior + 1)) ** 2
    expected = r + (1 - r) ** 2 * left * (1 + r * left) / (1 - (r * left) ** 2)
    world = World.of(slab(ior, 0.6))
    points = surface_points(world, (16, 16))
    found = np.stack([transmission.evaluate(world, points, spp=256, batch=b) for b in range(8)])
    truth = np.stack([render_batch(world, (16, 16), 256, 0, b) for b in range(8)])
    for made in (found, truth):
        assert_mean(made.mean(axis=(1, 2), dtype=np.float64), expected, half_width=8e-3)
    np.testing.assert_allclose(points.absorption[8, 8], -np.log(left) / 0.4, rtol=1e-6)


def test_clear_glass_is_invisible_in_a_furnace():
    """Whatever is mirrored and refracted, white from everywhere is white; only Russian roulette is noisy.

    Interpolated normals let some rays in that none lets out: 1.8e-3 of a ball of 32 segments (index 1.2), falling with
    the square of the segments' angle, 3e-5 here.
    """
    ball = Shape("ball", shapes.sphere(0.08, segments=256, rings=128), glass("clear", 1.7))
    world = World.of(Scene("furnace", (ball,), UP, (), Environment((1.0, 1.0, 1.0))))
    image = np.stack([render_batch(world, (24, 24), 32, 0, b) for b in range(8)])
    assert_mean(image.mean(axis=(1, 2, 3)), 1.0, slack=1e-4, half_width=1e-3)
    points = surface_points(world, (24, 24))
    assert points.hit.mean() > 0.3
    made = np.stack([transmission.evaluate(world, points, spp=32, batch=b)[points.hit] for b in range(8)])
    assert_mean(made.mean(axis=(1, 2)), 1.0, slack=1e-4, half_width=2e-3)


def test_a_scene_of_another_size_shows_the_same():
    """The smaller one is traced in a frame of its own; numbers are the same as lengths are powers of two apart."""
    scene = slab(1.5, 0.3)
    small = scaled(scene, 2.0**-12)
    means = [render_batch(World.of(one), (8, 8), 512, 0).mean(axis=(0, 1)) for one in (scene, small)]
    np.testing.assert_allclose(*means, atol=4 * 0.5 / np.sqrt(64 * 512))


def test_the_surfaces_around_and_the_solid_compose_to_the_reference():
    """Emission, the environment's light on what it reaches, light between surfaces, and the solid."""
    from lightmeter.groundtruth.oracles import environment_visibility

    scene = replace(load("glass-ball"), environment=Environment((1.0, 0.9, 0.8)))
    world, size, count = World.of(scene), (32, 24), 12
    ours, truth = [], []
    for b in range(count):
        offset = np.random.default_rng(b).random(2)
        points = surface_points(world, size, offset)
        how = {"spp": 16, "batch": b}
        image = points.emission + environment_visibility.evaluate(world, points, **how)[0]
        ours.append(
            (image + indirect.evaluate(world, points, **how) + transmission.evaluate(world, points, **how)).mean()
        )
        truth.append(render_batch(world, size, 32, 1, b).mean())
    ours, truth = np.array(ours, float), np.array(truth, float)
    error = np.sqrt((ours.var(ddof=1) + truth.var(ddof=1)) / count)
    assert error < 4e-3 * truth.mean()
    assert_same_mean(ours, truth)
