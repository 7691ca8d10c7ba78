"""The reference and the oracles against closed forms (design, section 8)."""

import math

import numpy as np
import pytest

from lightmeter.groundtruth.oracles import direct, environment, environment_visibility, visibility
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.world import World
from lightmeter.scenes import shapes
from lightmeter.scenes.model import (
    DirectionalLight,
    Environment,
    Material,
    PointLight,
    Scene,
    Shape,
    SpotLight,
)

from .noise import assert_mean
from .small_scenes import WHITE, floor, hollow_sphere, inside_out, looking, placed, points_at, rectangle

DOWN = looking((0, 4, 0), (0, 0, 0), ymag=1.0, up=(0, 0, -1))


def batches_of(scene: Scene, size=(16, 16), spp=256, count=12) -> np.ndarray:
    """(K, 3): means over the image."""
    world = World.of(scene)
    return np.stack([render_batch(world, size, spp, 1, b).mean(axis=(0, 1), dtype=float) for b in range(count)])


@pytest.mark.parametrize("albedo", [0.2, 0.5, 0.8])
def test_a_closed_furnace_shines_with_emission_over_one_minus_albedo(albedo):
    """Every point sees emission everywhere, so it holds for flat facets too, whatever the shape."""
    material = Material(base_color=(albedo,) * 3, specular=0, emissive=(1.0, 0.5, 2.0))
    box = Shape("box", inside_out(shapes.box(1, 1, 1)), material)
    camera = looking((0.1, 0.05, 0), (0.3, 0.2, -1), yfov=math.radians(90))
    expected = np.array([1.0, 0.5, 2.0]) / (1 - albedo)
    got = batches_of(Scene("furnace", (box,), camera))
    assert_mean(got, expected, half_width=0.02)


def test_the_white_metal_furnace_loses_nothing_but_what_single_scattering_loses():
    """One bounce: L = Le·(1 + a) with a the albedo; at most 2, and above Lambert's of the published mean loss."""
    material = Material(metallic=1, roughness=1, emissive=(1, 1, 1))
    box = Shape("box", inside_out(shapes.box(1, 1, 1)), material)
    camera = looking((0, 0, 0.4), (0, 0, -1), yfov=math.radians(2))
    got = batches_of(Scene("furnace", (box,), camera, max_depth=2))
    # Seen along the normal: 1 − ln 2; within 1° of it the albedo changes by less than 1e-4.
    assert_mean(got, 2 - math.log(2), slack=1e-4, half_width=2e-3)


@pytest.mark.parametrize(
    ("max_depth", "emission", "expected"), [(-1, 0.5, 1.0), (2, 0.5, 0.75), (-1, 0.0, 1.0), (2, 0.0, 0.5)]
)
def test_inside_a_unit_sphere_of_albedo_one_half(max_depth, emission, expected):
    """Emission 0.5, or a point light of intensity π at the centre.

    With the light, facets lie at cos(h) or more from the centre, h = π/128·√2/2·… at their corners: the irradiance
    I·cos θ/d² lies within cos(h)…1/cos²(h) of π, 1.3e-3 for 128 segments. Emission needs no round ball, and a coarse
    one keeps clear of Mitsuba's ray offset (1.8e-4 here), which is no longer small beside what fine facets rise over
    each other: 128 segments lose 1.2e-4 by it.
    """
    lights = () if emission else (PointLight("centre", (0, 0, 0), (math.pi,) * 3),)
    material = Material(base_color=(0.5,) * 3, specular=0, emissive=(emission,) * 3)
    segments = 16 if emission else 128
    got = batches_of(hollow_sphere(material, segments, lights=lights, max_depth=max_depth))
    assert_mean(got, expected, slack=0 if emission else 1.3e-3, half_width=5e-3)


def floor_world(**scene) -> World:
    return World.of(Scene("floor", (Shape("floor", floor(8), WHITE),), DOWN, **scene))


def test_the_irradiance_of_punctual_lights_on_a_plane():
    """ρ/π·I·cos θ/d², in double precision down to the G-buffer's float32: 1e-6."""
    spot = SpotLight("spot", (0, 2, 0), (0, -1, 0), (3, 2, 1), math.radians(20), math.radians(40))
    lights = (PointLight("point", (0.5, 2, -0.25), (10, 5, 1)), spot, DirectionalLight("sun", (1, -2, 0.5), (3, 3, 3)))
    world = floor_world(lights=lights)
    x = np.linspace(-2, 2, 41)
    positions = np.stack([x, 0 * x, 0.3 * x], axis=1)
    points = points_at(positions, (0, 1, 0), (0.3, 1, 0.2))
    exact = positions.astype(np.float32).astype(float)

    offset = np.array(lights[0].position) - exact
    distance = np.linalg.norm(offset, axis=1)
    expected = np.array(lights[0].intensity) / np.pi * (offset[:, 1] / distance**3)[:, None]
    np.testing.assert_allclose(direct.evaluate(world, points, 0)[0], expected, rtol=1e-6)

    offset = np.array(spot.position) - exact
    distance = np.linalg.norm(offset, axis=1)
    cosine = offset[:, 1] / distance
    ramp = np.clip((cosine - math.cos(spot.outer)) / (math.cos(spot.inner) - math.cos(spot.outer)), 0, 1)
    expected = np.array(spot.intensity) / np.pi * (ramp**2 * cosine / distance**2)[:, None]
    np.testing.assert_allclose(direct.evaluate(world, points, 1)[0], expected, rtol=1e-6, atol=1e-9)

    sun = 3 / np.pi * 2 / math.sqrt(1 + 4 + 0.25)
    np.testing.assert_allclose(direct.evaluate(world, points, 2)[0], sun, rtol=1e-6)
    for light in range(3):
        a, b = visibility.evaluate(world, points, light)
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("height", [-0.05, -0.001, 0.02])
def test_points_beside_their_triangle_are_lit_where_they_are_and_shadowed_as_it_is(height):
    """A position in few bits: the distance to the light is its own, the floor does not hide the light."""
    lamp = PointLight("point", (0.5, 2, -0.25), (10, 5, 1))
    world = floor_world(lights=(lamp,))
    positions = np.stack([np.linspace(-2, 2, 21), np.full(21, height), np.zeros(21)], axis=1)
    offset = np.array(lamp.position) - positions.astype(np.float32).astype(float)
    expected = np.array(lamp.intensity) / np.pi * (offset[:, 1] / np.linalg.norm(offset, axis=1) ** 3)[:, None]
    shadowed, unshadowed = visibility.evaluate(world, points_at(positions, (0, 1, 0), (0.3, 1, 0.2)), 0)
    np.testing.assert_allclose(unshadowed[0], expected, rtol=1e-6)
    np.testing.assert_array_equal(shadowed, unshadowed)


def polygon_irradiance(point, normal, corners) -> float:
    """Irradiance of a polygon of radiance 1 wholly above the horizon (Lambert 1760): ½ Σ θᵢ·(γᵢ·n)."""
    to = [np.subtract(c, point) / np.linalg.norm(np.subtract(c, point)) for c in corners]
    total = 0.0
    for a, b in zip(to, [*to[1:], to[0]], strict=True):
        cross = np.cross(a, b)
        total += math.acos(np.clip(a @ b, -1, 1)) * (cross / np.linalg.norm(cross)) @ normal
    return abs(total) / 2


def test_the_form_factor_of_a_rectangular_light():
    """Lambert's formula at points below, beside, and near a rectangle, and nothing behind it.

    Rays leave ε = 1500 · 2⁻²⁴ · (1 + max |p|) above the point (Mitsuba's offset), the density of the light's samples is
    that at the point: at height h it is off by up to 2 ε / h. The power heuristic's weight w changes by 2 w (1 − w) ≤ ½
    of that, so that the two strategies' weights add up to 1 but for ε / h. (Seen at h = 0.1: 4e-4 of 1.7e-3.)
    """
    lamp = Material(base_color=(0, 0, 0), specular=0, emissive=(2, 3, 4))
    corner, across, up = (-0.5, 1, -0.5), (1, 0, 0), (0, 0, 1)
    mesh = rectangle(corner, across, up)  # looks down
    scene = Scene("lamp", (Shape("floor", floor(8), WHITE), Shape("lamp", mesh, lamp)), DOWN)
    world = World.of(scene)
    positions = [(0, 0, 0), (1, 0, 0.5), (0.3, 0.9, 0.2), (2, 0.5, -1), (0, 1.5, 0)]
    points = points_at(positions, (0, 1, 0), (0.3, 1, 0.2))
    corners = [(-0.5, 1, -0.5), (0.5, 1, -0.5), (0.5, 1, 0.5), (-0.5, 1, 0.5)]
    irradiance = [polygon_irradiance(np.float32(p), np.array([0, 1, 0]), corners) for p in positions[:4]] + [0.0]
    expected = np.array(irradiance)[:, None] / np.pi * np.array([2, 3, 4])
    batches = np.stack([direct.evaluate(world, points, 0, spp=16384, batch=b)[0] for b in range(12)])
    offset = 1500 * 2**-24 * (1 + np.abs(positions).max(axis=1))
    height = np.array([1.0, 1.0, 0.1, 0.5, 1.0])
    assert_mean(batches, expected, slack=expected * (offset / height)[:, None], half_width=2e-3)
    both = np.stack([visibility.evaluate(world, points, 0, spp=256, batch=b)[:, 0] for b in range(4)])
    np.testing.assert_allclose(both[:, 0], both[:, 1], rtol=1e-6)


def test_the_ambient_visibility_of_a_plane_under_a_sphere():
    """1 − r²·h/d³ at lateral distance x, d² = x² + h², for a sphere wholly above the horizon.

    The ball is a polyhedron of 256 segments with its corners on the sphere: its outline lacks at most
    1 − cos(π/128)² of its area, 6e-4 of the form factor.
    """
    radius, height = 0.5, 1.25
    black = Material(base_color=(0, 0, 0), specular=0)
    ball = Shape("ball", shapes.sphere(radius, 256), black, placed(y=height))
    world = World.of(
        Scene("ball", (Shape("floor", floor(8), WHITE), ball), DOWN, environment=Environment((1.0, 2.0, 0.5)))
    )
    x = np.array([0, 0.4, 1, 2])
    points = points_at(np.stack([x, 0 * x, 0 * x], axis=1), (0, 1, 0), (0.3, 1, 0.2))
    blocked = radius**2 * height / np.hypot(x, height) ** 3
    batches = np.stack([environment_visibility.evaluate(world, points, spp=8192, batch=b)[:, 0] for b in range(12)])
    np.testing.assert_allclose(batches[:, 1], np.broadcast_to([1.0, 2.0, 0.5], (12, 4, 3)), rtol=1e-5)
    assert_mean(batches[:, 0, :, 0], 1 - blocked, slack=6e-4 * blocked.max(), half_width=1e-3)
    unoccluded = environment.evaluate(world, points, spp=16)[0]
    np.testing.assert_allclose(unoccluded, np.broadcast_to([1.0, 2.0, 0.5], (4, 3)), rtol=1e-5)
