"""Ambient visibility on the device: what it costs, where it takes part, and scenes whose answer is known."""

from itertools import pairwise

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.scenes import shapes
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Material, Shape, Texture

from ..sphere_occlusion import hidden_by_quadrature, hidden_by_sphere
from .small_scenes import WHITE, camera, facing, image, moved, renderer, scene_of
from .test_costs import counted

BALL = Shape("ball", shapes.sphere(0.4, segments=16), WHITE, moved(z=0.6))
SKY = scene_of(facing(WHITE), BALL, radiance=(1, 1, 1))
SCREEN_SPACE = ("ssao", "gtao")


def visibility(device, scene, name, size=(64, 64), **knobs):
    """(H, W, 3) of an effect, and the points."""
    capture = renderer(device, scene, size, Choice(use=(name,), settings={name: knobs})).capture()
    return capture.frame["environment_visibility"], capture.points


@pytest.mark.parametrize("name", SCREEN_SPACE)
@pytest.mark.parametrize(("blur", "passes"), [("none", 1), ("bilateral", 2)])
def test_it_costs_its_passes_where_it_is_asked_for_and_nothing_else(name, blur, passes):
    """A program, a texture and a draw for each pass; and the buffer of the visibility, its program and draw."""
    choice = Choice(use=(name,), settings={name: {"blur": blur}})
    plain, used = counted(SKY), counted(SKY, choice, frames=2)
    for what in ("shaders", "textures"):
        assert used[1][what] - plain[1][what] == passes + 1
    assert used[2] - plain[2] == passes + 1
    for scene in (scene_of(facing(WHITE), radiance=(1, 1, 1)), scene_of(facing(WHITE), BALL)):
        assert counted(scene, choice) == counted(scene)


@pytest.mark.parametrize("name", SCREEN_SPACE)
def test_it_is_taken_only_where_it_is_asked_for(name):
    plain = compile_plan(SKY, effects())
    assert plain.effect_of("environment_visibility") is None
    assert f"--use {name}" in plain.why_absent(name)
    baked = Material("baked", occlusion_texture=Texture(image([[100]])))
    textured = scene_of(facing(baked), BALL, radiance=(1, 1, 1))
    for scene, other in ((SKY, None), (textured, "occlusion_map")):
        assert compile_plan(scene, effects()).effect_of("environment_visibility") == other
        chosen = compile_plan(scene, effects(), Choice(use=(name,)))
        assert chosen.effect_of("environment_visibility") == name


@pytest.mark.parametrize("resolution", ["full", "half"])
@pytest.mark.parametrize("name", SCREEN_SPACE)
def test_points_that_were_drawn_give_what_was_drawn(device, name, resolution):
    """The screen places follow the sub-pixel offset, also that of points that are handed in."""
    there = renderer(device, load("torus"), (48, 32), Choice(use=(name,), settings={name: {"resolution": resolution}}))
    drawn = there.capture((0.2, -0.3))
    other = there.capture((-0.4, 0.1)).frame["environment_visibility"]
    again = there.shade(drawn.points).frame["environment_visibility"]
    found = drawn.frame["environment_visibility"]
    # The offset of points that are handed in is found from float32 positions: a place within rounding of a pixel's
    # edge may be looked up in the next one.
    assert np.mean(np.abs(again - found).max(axis=2) > 1e-6) < 0.01
    assert np.mean(np.abs(other - found).max(axis=2) > 1e-6) > 0.1


@pytest.mark.parametrize("lens", [{"ymag": 1.0}, {"yfov": 0.7}])
@pytest.mark.parametrize("name", SCREEN_SPACE)
def test_a_plane_is_not_hidden_by_itself(device, name, lens):
    """Seen at an angle of 45°, with a ball far beyond the radius.

    A place is compared with what the pixel's centre shows, half a pixel aside: SSAO needs a bias of a pixel.
    """
    far = Shape("ball", shapes.sphere(0.05, segments=8), WHITE, moved(x=3.0, z=0.05))
    scene = scene_of(facing(WHITE, 10, 10), far, view=camera((0, -2, 2), **lens), radiance=(1, 1, 1))
    found, points = visibility(device, scene, name, radius=0.3, **({"bias": 0.05} if name == "ssao" else {}))
    plane = points.shape == 0
    assert plane.sum() > 2000
    np.testing.assert_allclose(found[plane], 1.0, atol=2e-3)


def error_under_a_ball(device, height, slices, steps, radius=0.4):
    """GTAO less the closed form, on a plane around a ball with its centre at that height, seen from straight above."""
    ball = Shape("ball", shapes.sphere(radius, segments=128), WHITE, moved(z=height))
    scene = scene_of(facing(WHITE, 12, 12), ball, view=camera((0, 0, 5)), radiance=(1, 1, 1))
    knobs = {"radius": 20.0, "falloff": 0.0, "blur": "none", "specular_occlusion": "same"}
    found, points = visibility(device, scene, "gtao", (128, 128), slices=slices, steps=steps, **knobs)
    aside = np.linalg.norm(points.position[..., :2], axis=2)
    around = (points.shape == 0) & (aside > 1.1 * radius)
    distance = np.hypot(aside[around], height)
    return found[around, 0] - (1 - hidden_by_sphere(distance, height / distance, radius))


def test_the_closed_form_for_a_sphere_holds():
    """The grid's cells at the rim of sphere and disk are half in: 1200 a side leave a few parts in ten thousand."""
    for distance, cosine in ((1.5, 0.9), (1.5, 0.0), (2.0, 0.3), (2.0, -0.2), (1.1, -0.4)):
        exact = hidden_by_sphere(np.array(distance), np.array(cosine), 1.0)
        assert hidden_by_quadrature(distance, cosine, 1.0) == pytest.approx(exact, abs=3e-4)


def test_gtao_converges_to_the_closed_form_around_a_dome(device):
    """Half a ball on a plane, from above: a height field, and all of it is seen, so GTAO has nothing to guess.

    The midpoint rule over slices and the highest of so many places have errors of second order: twice as many of both
    leave a quarter. So what the last doubling leaves is a third of the error before at most, or it converges elsewhere.
    """
    errors = [np.sqrt(np.mean(error_under_a_ball(device, 0.0, s, 4 * s) ** 2)) for s in (2, 4, 8, 16)]
    assert errors[0] > 0.02
    for before, after in pairwise(errors):
        assert after < before / 2.5
    assert errors[-1] < errors[-2] / 3


def test_gtao_takes_what_lies_under_a_ball_for_hidden(device):
    """A ball in the air is no height field: light that comes in under it is lost, whatever the number of slices."""
    error = error_under_a_ball(device, 0.7, 16, 64)
    assert error.mean() < -0.02
    assert np.percentile(error, 99) < 0.01


@pytest.mark.parametrize("choice", ["same", "none", "lagarde", "cone"])
def test_specular_occlusion_is_of_the_mirrored_part_alone(device, choice):
    """A Lambert surface has none: every choice gives the same. A mirror has nothing else: `none` leaves it bright."""
    ball = Shape("ball", shapes.sphere(0.4, segments=32), WHITE, moved(z=0.4))
    for material in (WHITE, Material("mirror", (1, 1, 1), metallic=1.0, roughness=0.3)):
        scene = scene_of(facing(material), ball, radiance=(1, 1, 1))
        found, points = visibility(device, scene, "gtao", specular_occlusion=choice)
        same, _ = visibility(device, scene, "gtao", specular_occlusion="same")
        card = points.shape == 0
        if material is WHITE or choice == "same":
            np.testing.assert_allclose(found[card], same[card], atol=1e-4)
        elif choice == "none":
            np.testing.assert_allclose(found[card], 1.0, atol=1e-4)
        else:
            assert np.abs(found - same)[card].max() > 0.05


@pytest.mark.parametrize("resolution", ["full", "half"])
def test_a_blur_within_surfaces_leaves_a_plate_bright_above_its_dark_surroundings(device, resolution):
    """The mean over all of 4 × 4 pixels takes the ground's darkness onto the plate."""
    plate = Shape("plate", shapes.box(0.8, 0.8, 0.2), WHITE, moved(z=0.1))
    scene = scene_of(facing(WHITE), plate, radiance=(1, 1, 1))
    least = {}
    for blur in ("bilateral", "box4"):
        found, points = visibility(device, scene, "gtao", blur=blur, resolution=resolution)
        least[blur] = found[(points.shape == 1) & (points.normal[..., 2] > 0.9)].min()
    assert least["bilateral"] > 0.99
    assert least["box4"] < 0.95
