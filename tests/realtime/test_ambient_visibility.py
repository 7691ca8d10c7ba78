"""Ambient visibility on the device: what it costs, where it takes part, and scenes whose answer is known."""

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.scenes import shapes
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Material, Shape, Texture

from .small_scenes import WHITE, camera, facing, image, moved, renderer, scene_of
from .test_costs import counted

BALL = Shape("ball", shapes.sphere(0.4, segments=16), WHITE, moved(z=0.6))
SKY = scene_of(facing(WHITE), BALL, radiance=(1, 1, 1))
SCREEN_SPACE = ("ssao",)


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

    A place is compared with what the pixel's centre shows, half a pixel aside: SSAO needs a bias of a pixel's depth, 4 cm.
    """
    far = Shape("ball", shapes.sphere(0.05, segments=8), WHITE, moved(x=3.0, z=0.05))
    scene = scene_of(facing(WHITE, 10, 10), far, view=camera((0, -2, 2), **lens), radiance=(1, 1, 1))
    found, points = visibility(device, scene, name, radius=0.3, **({"bias": 0.05} if name == "ssao" else {}))
    plane = points.shape == 0
    assert plane.sum() > 2000
    np.testing.assert_allclose(found[plane], 1.0, atol=2e-3)
