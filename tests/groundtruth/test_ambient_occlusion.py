"""Ambient visibility and classical ambient occlusion against closed forms."""

import numpy as np
import pytest

from lightmeter.groundtruth.ambient_occlusion import ambient_occlusion
from lightmeter.groundtruth.oracles import environment_visibility
from lightmeter.groundtruth.world import World
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Environment, Scene, Shape

from ..sphere_occlusion import hidden_by_sphere
from .noise import assert_mean
from .small_scenes import WHITE, floor, looking, placed, points_at, rectangle

DOWN = looking((0, 4, 0), (0, 0, 0), ymag=1.0, up=(0, 0, -1))
SKY = Environment((1.0, 1.0, 1.0))


@pytest.mark.parametrize("height", [0.7, 0.0, -0.2])
def test_a_plane_around_a_sphere_that_the_horizon_cuts(height):
    """Both truths are the closed form: over an even sky a Lambert surface's ratio is the open share of directions.

    The ball is a polyhedron of 256 segments with its corners on the sphere: its outline lacks at most
    1 − cos²(π/128) of its area, 6e-4 of what it hides.
    """
    radius = 0.5
    ball = Shape("ball", shapes.sphere(radius, 256), WHITE, placed(y=height))
    world = World.of(Scene("ball", (Shape("floor", floor(8), WHITE), ball), DOWN, environment=SKY))
    x = np.array([0.6, 0.8, 1.5])
    points = points_at(np.stack([x, 0 * x, 0 * x], axis=1), (0, 1, 0), (0.3, 1, 0.2))
    distance = np.hypot(x, height)
    hidden = hidden_by_sphere(distance, height / distance, radius)
    term = [environment_visibility.evaluate(world, points, spp=4096, batch=b)[0, 0, :, 0] for b in range(8)]
    open_share = [ambient_occlusion(world, points, spp=4096, batch=b)[0] for b in range(8)]
    for batches in (term, open_share):
        assert_mean(np.stack(batches), 1 - hidden, slack=6e-4 * hidden.max(), half_width=4e-3)


def test_a_wall_counts_as_far_as_the_radius():
    """Directions that meet an endless wall within R, at the distance d, are a cap of half angle acos(d/R) around its
    normal, half of it below the horizon: what a sphere would hide whose sine is that."""
    wall = Shape("wall", rectangle((-1, -50, 50), (0, 0, -100), (0, 100, 0)), WHITE)
    world = World.of(Scene("wall", (Shape("floor", floor(60), WHITE), wall), DOWN, environment=SKY))
    points = points_at([[0, 0, 0]], (0, 1, 0), (0.3, 1, 0.2))
    for radius in (0.9, 1.2, 2.0, 4.0):
        batches = np.stack([ambient_occlusion(world, points, radius, spp=4096, batch=b)[0] for b in range(8)])
        sine = np.sqrt(max(1 - 1 / radius**2, 0))
        hidden = hidden_by_sphere(np.array(1 / sine), np.array(0.0), 1.0) if sine else 0.0
        assert_mean(batches, 1 - hidden, half_width=4e-3)


@pytest.mark.parametrize("radius", [0.0, -1.0, float("nan")])
def test_a_radius_is_positive(radius):
    world = World.of(Scene("floor", (Shape("floor", floor(8), WHITE),), DOWN))
    with pytest.raises(ValueError, match="radius of ambient occlusion"):
        ambient_occlusion(world, points_at([[0, 0, 0]], (0, 1, 0), (0, 1, 0)), radius)
