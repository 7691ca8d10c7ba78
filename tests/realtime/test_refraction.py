"""Techniques for dielectric solids: slabs and balls in closed form, a furnace, the plan."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.scenes import shapes
from lightmeter.scenes.glass import glass
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Environment, Image, Material, Shape
from lightmeter.scenes.optics import dielectric
from lightmeter.scenes.optics import environment as optics

from .small_scenes import camera, moved, renderer, scene_of

TECHNIQUES = ("refraction_one_interface", "refraction_two_interfaces", "refraction_bounces")
SLOPE = np.array([0.3, 0.5, -0.2])
"""Of an environment that is 1 + SLOPE·direction."""


def shown(device, solid: Shape, environment: Environment, name: str, frame=(24, 24), **settings):
    """What a technique gives, (n, 3), and the points, where the solid is seen."""
    scene = replace(scene_of(solid, view=camera()), environment=environment)
    made = renderer(device, scene, frame, Choice(use=(name,), settings={name: settings})).capture()
    points = made.points
    seen = points.hit & (np.sum(points.normal * points.view, axis=-1) > 0.05)
    return made.frame["transmission"][seen].astype(np.float64), points.at(seen)


def sloped(height: int = 128) -> Environment:
    """The sloped environment as a map."""
    u, v = np.meshgrid((np.arange(2 * height) + 0.5) / (2 * height), (np.arange(height) + 0.5) / height)
    directions = np.stack(optics.direction_at(u.ravel(), v.ravel(), 0.0))
    texels = (1 + SLOPE @ directions).reshape(height, 2 * height, 1)
    return Environment((1.0, 1.0, 1.0), Image(np.repeat(texels, 3, axis=2).astype(np.float32)))


@pytest.mark.parametrize("bounces", [1, 2, 5])
def test_a_slab_seen_straight_on(device, bounces):
    """Orders of reflection inside, one after another: (1 − R)² aᵏ⁺¹ Rᵏ; float32 and depth maps leave 1e-5."""
    left, ior = np.array([0.6, 1.0, 0.5]), 1.5
    slab = Shape("slab", shapes.box(1.8, 1.8, 0.4), glass("glass", ior, tuple(left), 0.4))
    r = ((ior - 1) / (ior + 1)) ** 2
    orders = [(1 - r) ** 2 * left ** (k + 1) * r**k for k in range(bounces)]
    expected = {
        "refraction_one_interface": np.ones(3),
        "refraction_two_interfaces": r + (1 - r) * left,
        "refraction_bounces": r + sum(orders),
    }
    for name in TECHNIQUES:
        settings = {"bounces": bounces} if name == "refraction_bounces" else {}
        made, points = shown(device, slab, Environment((1.0, 1.0, 1.0)), name, **settings)
        front = points.normal[:, 2] > 0.9
        np.testing.assert_allclose(made[front], np.broadcast_to(expected[name], made[front].shape), atol=1e-5)


def sphere_traced(points, ior: float, bounces: int) -> np.ndarray:
    """(n,) float64: the sloped environment in a ball about the origin, by its own equation."""
    n, v = points.normal.astype(np.float64).T, points.view.astype(np.float64).T
    n = n / np.linalg.norm(n, axis=0)

    def around(direction):
        return 1 + SLOPE @ direction

    c = np.sum(n * v, axis=0)
    share = dielectric.reflectance(c, ior)
    total = share * around(2 * c * n - v)
    inside, weight = dielectric.refracted(n, v, c, ior), 1 - share
    for _ in range(bounces):
        n = n - 2 * np.sum(n * inside, axis=0) * inside  # the chord's other end, of a ball of radius 1
        c = np.sum(n * inside, axis=0)
        mirrored = dielectric.reflectance(c, 1 / ior)
        total += weight * (1 - mirrored) * around(dielectric.refracted(-n, -inside, c, 1 / ior))
        inside, weight = inside - 2 * c * n, weight * mirrored
    return total


@pytest.mark.parametrize(("ior", "bounces"), [(1.5, 1), (1.5, 4), (2.417, 3)])
def test_a_ball_is_as_its_equation_says(device, ior, bounces):
    """Planes are interpolated between texels π/4/size apart: of second order in that, 4e-6 of the radius, at each wall.

    What is seen changes by |SLOPE| a radian; at grazing incidence a wall's error is magnified, by 1/0.05 at most.
    The ball's chords are within (2π/256)²/8 of its equation, and its interpolated normals likewise. At a face's edge
    the lookup stops half a texel short, which turns the normal by π/4/size, and what is refracted by ior as much.
    """
    ball = Shape("ball", shapes.sphere(0.9, segments=256, rings=128), glass("clear", ior))
    made, points = shown(device, ball, sloped(), "refraction_bounces", bounces=bounces, size=512)
    allowed = np.linalg.norm(SLOPE) * bounces * ((2 * np.pi / 256) ** 2 / 8 + (np.pi / 2 / 512) ** 2 / 8) / 0.05
    allowed += np.linalg.norm(SLOPE) * bounces * ior * np.pi / 4 / 512
    assert allowed < 1e-2
    assert np.abs(made[:, 0] - sphere_traced(points, ior, bounces)).max() <= allowed


def test_what_is_seen_through_a_ball_is_upside_down(device):
    """Through its middle straight on; above the middle what lies below."""
    ball = Shape("ball", shapes.sphere(0.9, segments=128, rings=64), glass("clear", 1.5))
    for name in ("refraction_two_interfaces", "refraction_bounces"):
        made, points = shown(device, ball, sloped(), name, frame=(25, 25))
        above = (points.position[:, 1] > 0.2) & (points.position[:, 1] < 0.4) & (np.abs(points.position[:, 0]) < 0.1)
        below = points.position[:, 1] < -0.2
        below &= (points.position[:, 1] > -0.4) & (np.abs(points.position[:, 0]) < 0.1)
        assert made[above].mean() < made[below].mean() - 0.1


@pytest.mark.parametrize("name", TECHNIQUES[:2])
def test_clear_glass_is_invisible_in_a_furnace(device, name):
    """Mirrored and refracted light are shares of one, whatever the directions."""
    ball = Shape("ball", shapes.sphere(0.9, segments=48, rings=24), glass("clear", 1.7))
    made, _ = shown(device, ball, Environment((1.0, 1.0, 1.0)), name)
    np.testing.assert_allclose(made, 1.0, atol=4 * 2.0**-23)


@pytest.mark.parametrize("name", TECHNIQUES)
def test_surfaces_around_stand_before_the_environment(device, name):
    """A black wall behind a slab: straight through it is seen, in the mirror the white sky before it is."""
    slab = Shape("slab", shapes.box(1.0, 1.0, 0.4), glass("clear", 1.5))
    wall = Shape("wall", shapes.box(40.0, 40.0, 0.1), Material("black", (0.0, 0.0, 0.0), specular=0.0), moved(z=-2.0))
    scene = replace(scene_of(slab, wall, view=camera()), environment=Environment((1.0, 1.0, 1.0)))
    r = 0.04
    mirrored = {"scene": r + (r * (1 - r) ** 2 if name == "refraction_bounces" else 0), "environment": 1.0}
    for around, expected in mirrored.items():
        choice = Choice(use=(name,), settings={name: {"around": around}})
        made = renderer(device, scene, (24, 24), choice).capture()
        front = (made.points.ior > 0) & (made.points.normal[..., 2] > 0.9)
        # Two of four bounces leave by the front and two by the back; what is kept inside is 0.04³ at most.
        np.testing.assert_allclose(made.frame["transmission"][front], expected, atol=2e-4)


def test_a_solid_alone_bakes_no_surroundings(device):
    ball = Shape("ball", shapes.sphere(0.9, segments=16, rings=8), glass("clear", 1.7))
    scene = scene_of(ball, view=camera(), radiance=(1.0, 1.0, 1.0))
    for name in TECHNIQUES:
        baked = renderer(device, scene, (8, 8), Choice(use=(name,))).baking.milliseconds
        assert set(baked) == ({name} if name == "refraction_bounces" else set())


def test_what_the_last_bounce_mirrors_is_lost(device):
    ball = Shape("ball", shapes.sphere(0.9, segments=48, rings=24), glass("clear", 1.7))
    means = [
        shown(device, ball, Environment((1.0, 1.0, 1.0)), "refraction_bounces", bounces=b)[0].mean() for b in (1, 2, 6)
    ]
    assert means[0] < means[1] < means[2] <= 1 + 1e-6 and means[2] > 0.999


def test_who_needs_it():
    known = effects()
    gem = compile_plan(load("gem"), known)
    assert [step.writes[0] for step in gem.steps] == ["transmission", "tone", "encode"]
    assert "only mirrors and refracts" in gem.why_absent("split_sum")
    plan = compile_plan(load("glass-ball"), known)
    assert plan.effect_of("transmission") == "refraction_bounces"
    none = compile_plan(load("torus"), known)
    assert none.why_absent("refraction_bounces") == "the scene has no dielectric solids"
    dark = compile_plan(replace(load("glass-ball"), environment=None), known)
    assert dark.why_absent("refraction_bounces") == "the scene has no environment for its solids to show"
    assert "transmission" in dark.not_approximated
