"""Virtual lights inside a sphere, where every bounce has a closed form; and what stands between them and a point.

Inside a unit sphere cos θ·cos θ'/d² is 1/4 between any two points. So a light of flux Φ inside it, of whatever kind,
gives a radiance of ρ²·Φ/(4π²) after one bounce, and ρ times as much more after each further one. Every virtual light
gives the same, wherever it is: the sum is exact for any number of them.
"""

import math

import numpy as np
import pytest

from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Mesh, PointLight, Shape, SpotLight

from .small_scenes import camera, facing, moved, renderer, scene_of

GREY = Material("grey", (0.5, 0.5, 0.5), specular=0.0)
LAMP = PointLight("lamp", (0.1, 0.2, 0.0), (math.pi, math.pi, math.pi))
SPOT = SpotLight("spot", (0.0, 0.3, 0.1), (0.6, 0.0, -0.8), (2.0, 2.0, 2.0), inner=0.3, outer=0.6)
SEGMENTS = 48
FLATNESS = (math.pi / SEGMENTS) ** 2
"""How much nearer a facet's middle is than its corners, relative: half of it on each of two ends, twice for squares."""


def inside_out(mesh: Mesh) -> Mesh:
    """The mesh, its fronts turned inwards; without vertex normals."""
    return Mesh(mesh.positions, mesh.triangles[:, ::-1])


def ball(*others: Shape, lights=(), material=GREY):
    """The inside of a sphere, seen from beside its middle."""
    wall = Shape("wall", inside_out(shapes.sphere(1.0, SEGMENTS)), material)
    return scene_of(wall, *others, view=camera((0.0, 0.0, 0.4), (0.0, 0.0, -1.0), yfov=1.0), lights=lights)


def indirect(device, scene, size=(24, 24), **knobs) -> np.ndarray:
    """What the effect gives, (H, W, 3)."""
    settings = {"virtual_lights": {"clamp": 0.0, "resolution": 64, **knobs}}
    choice = Choice(use=("virtual_lights",), settings=settings)
    return renderer(device, scene, size, choice).capture().frame["indirect"]


def glowing(double_sided=False) -> Shape:
    """A small emissive square in the middle: π·L·A from each side."""
    material = Material("glow", (0.0, 0.0, 0.0), specular=0.0, emissive=(50.0, 50.0, 50.0), double_sided=double_sided)
    return Shape("glow", shapes.rectangle(0.1, 0.1), material, moved(y=-0.2, z=0.5))


CASES = {
    "point": (ball(lights=(LAMP,)), 4 * math.pi**2),
    "spot": (
        ball(lights=(SPOT,)),
        2 * 2 * math.pi * ((1 - math.cos(0.3)) + (math.cos(0.3) - math.cos(0.6)) / 3),
    ),
    "emissive": (ball(glowing()), math.pi * 50 * 0.01),
    "two-sided": (ball(glowing(double_sided=True)), 2 * math.pi * 50 * 0.01),
    "two lights": (ball(lights=(LAMP, SPOT)), None),
}
CASES["two lights"] = CASES["two lights"][0], CASES["point"][1] + CASES["spot"][1]


@pytest.mark.parametrize("case", CASES)
def test_in_a_sphere_one_bounce_is_its_closed_form(device, case):
    """Mean and spread: points near a virtual light see its facet at an angle that the sphere does not have."""
    scene, flux = CASES[case]
    expected = 0.25 * flux / (4 * math.pi**2)
    # A spot's falloff is summed over 64 cosines by midpoints; where the ramp ends its slope changes.
    slack = 4 * FLATNESS + (0.01 if "spot" in case or case == "two lights" else 0.0)
    found = indirect(device, scene, lights=64)
    assert np.median(found) == pytest.approx(expected, rel=slack)


def test_a_second_bounce_adds_its_closed_form(device):
    """Points all over the sphere receive ρ·Φ/(4π) each, wherever they are."""
    once, twice = (indirect(device, ball(lights=(LAMP,)), lights=64, bounces=n) for n in (1, 2))
    assert np.median(once) == pytest.approx(0.25, rel=4 * FLATNESS)
    assert np.median(twice - once) == pytest.approx(0.125, rel=8 * FLATNESS)


def test_interleaved_sampling_finds_the_same(device):
    """Each pixel's part of the lights counts for all of them: in the sphere any part gives the whole."""
    whole, shared = (indirect(device, ball(lights=(LAMP,)), lights=64, tile=tile) for tile in (1, 4))
    assert np.median(shared) == pytest.approx(np.median(whole), rel=4 * FLATNESS)


def test_the_diffuse_base_alone_is_all_of_a_surface_without_specular(device):
    whole, diffuse = (indirect(device, ball(lights=(LAMP,)), lights=16, lobes=lobes) for lobes in ("all", "diffuse"))
    # GGX of F0 = F90 = 0 is 0, and (1 − F) is 1: the same products in another order.
    np.testing.assert_allclose(diffuse, whole, rtol=16 * 2.0**-23)


def behind_a_screen():
    """A red wall that is lit, and a grey one that a screen hides it from."""
    red = Material("red", (0.9, 0.1, 0.1), specular=0.0)
    black = Material("black", (0.0, 0.0, 0.0), specular=0.0, double_sided=True)
    turn = np.diag([-1.0, 1.0, -1.0, 1.0])
    lit = Shape("lit", shapes.rectangle(2.0, 2.0), red, moved(z=1.0) @ turn)
    screen = Shape("screen", shapes.rectangle(6.0, 6.0), black, moved(z=0.5))
    lamp = PointLight("lamp", (0.0, 0.0, 0.75), (1.0, 1.0, 1.0))
    view = camera((0.0, 0.0, 0.4), (0.0, 0.0, 0.0), yfov=1.0)
    return scene_of(facing(GREY, 4.0, 4.0), lit, screen, view=view, lights=(lamp,))


def test_maps_keep_light_behind_a_screen(device):
    """Without them all of it leaks through: the whole picture should be black."""
    leaking, dark = (indirect(device, behind_a_screen(), lights=64, visibility=v) for v in ("none", "maps"))
    assert leaking[..., 0].min() > 0.01
    assert dark.max() == 0


def test_maps_hide_nothing_where_everything_sees_everything(device):
    """In the sphere; a facet's own plane is where bias and resolution could shadow it."""
    free, mapped = (indirect(device, ball(lights=(LAMP,)), lights=64, visibility=v) for v in ("none", "maps"))
    assert np.median(mapped) == pytest.approx(np.median(free), rel=0.02)
    assert (mapped <= free * (1 + 1e-5)).all()


def test_light_comes_from_sides_that_the_camera_does_not_see(device):
    """From a shelf's top to the wall above it, seen from below: who faces whom is the lamp's matter."""
    shelf = Shape("shelf", shapes.plane(1.0, 0.5), GREY, moved(y=0.5, z=0.8))
    lamp = PointLight("lamp", (0.0, 1.0, 0.8), (1.0, 1.0, 1.0))
    view = camera((0.0, 0.0, 2.0), (0.0, 1.0, 0.0), yfov=1.2)
    scene = scene_of(facing(GREY, 6.0, 6.0), shelf, view=view, lights=(lamp,))
    assert indirect(device, scene, lights=64).max() > 0.01


def test_a_clamp_only_takes_light_away(device):
    scene = ball(lights=(LAMP,))
    free, clamped, dim = (indirect(device, scene, lights=64, clamp=clamp) for clamp in (0.0, 0.1, 0.5))
    assert (clamped <= free * (1 + 1e-5)).all() and (dim <= clamped * (1 + 1e-5)).all()
    assert dim.mean() < 0.9 * free.mean()


def test_it_costs_nothing_where_nothing_shines_or_nothing_scatters(device):
    plain = scene_of(facing(GREY), lights=(LAMP,))
    dark = ball()
    for scene, why in ((plain, "one flat shape"), (dark, "no lights")):
        plan = renderer(device, scene, choice=Choice(use=("virtual_lights",))).plan
        assert "virtual_lights" not in plan.effects
        assert any(why in item.why for item in plan.left_out), plan.left_out
