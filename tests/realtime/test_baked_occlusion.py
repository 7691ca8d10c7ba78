"""Ambient occlusion baked into vertices: what is baked, where it is drawn, what it costs."""

import numpy as np
import pytest

from lightmeter.realtime.device import Device
from lightmeter.realtime.effect import EffectError
from lightmeter.realtime.effects.baked_occlusion.dividing import baked_arrays, division
from lightmeter.realtime.effects.baked_occlusion.sky import directions
from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Material, Shape, Texture

from ..sphere_occlusion import hidden_by_sphere
from .small_scenes import WHITE, camera, facing, image, moved, renderer, scene_of
from .test_costs import counted

BALL = Shape("ball", shapes.sphere(0.4, segments=32), WHITE, moved(z=0.6))
SKY = scene_of(facing(WHITE), BALL, radiance=(1, 1, 1))


def baked(device, scene, size=(64, 64), **knobs):
    """(H, W) of the first channel, the points and the renderer."""
    settings = {"baked_occlusion": {"specular_occlusion": "same"} | knobs}
    there = renderer(device, scene, size, Choice(use=("baked_occlusion",), settings=settings))
    capture = there.capture()
    return capture.frame["environment_visibility"][..., 0], capture.points, there


def test_directions_are_even():
    """Their mean vanishes, and so do the second moments but for a third on the diagonal."""
    found = directions(256)
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1, atol=1e-12)
    np.testing.assert_allclose(found.mean(axis=0), 0, atol=2e-3)
    np.testing.assert_allclose(found.T @ found / 256, np.eye(3) / 3, atol=2e-3)


@pytest.mark.parametrize("parts", [1, 2, 5])
def test_a_triangle_s_parts_fill_it_once_and_face_its_way(parts):
    weights, pieces = division(parts)
    corners = (weights @ np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))[pieces]
    edges = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.det(edges) / 2
    np.testing.assert_allclose(areas, 0.5 / parts**2, rtol=1e-12)
    assert len(pieces) == parts**2 and weights.min() >= 0


def test_a_spacing_that_is_too_small_says_so():
    with pytest.raises(EffectError, match=r"baked_occlusion.spacing: 1e-05 m .* take .* m or more"):
        baked_arrays(shapes.plane(2.0, 2.0), 1e-5, texcoords=False)


def test_a_plane_around_a_ball_is_baked_to_the_closed_form(device):
    """Of 256 directions in the hemisphere, 0.16 apart, the ball's edge (a cap of 29° at most: 3.0 around) cuts 19
    cells, each in or out: √19/2 cells of 1/256, weighted with up to 2·cos θ: 1.5 %. Vertices 5 cm apart and the maps'
    texels of 2 cm move a point by less than a tenth of its distance from the ball."""
    ball = Shape("ball", shapes.sphere(0.4, segments=64), WHITE, moved(z=0.7))
    scene = scene_of(facing(WHITE, 4, 4), ball, view=camera((0, 0, 5)), radiance=(1, 1, 1))
    found, points, _ = baked(device, scene, spacing=0.05, directions=512, map=256)
    aside = np.linalg.norm(points.position[..., :2], axis=2)
    around = (points.shape == 0) & (aside > 0.45)
    distance = np.hypot(aside[around], 0.7)
    error = found[around] - (1 - hidden_by_sphere(distance, 0.7 / distance, 0.4))
    assert np.sqrt(np.mean(error**2)) < 0.02
    assert abs(error.mean()) < 0.01
    assert hidden_by_sphere(distance, 0.7 / distance, 0.4).max() > 0.1


def test_it_is_baked_once_and_timed_apart(device):
    _, _, there = baked(device, SKY, directions=16, map=64)
    assert list(there.baking.milliseconds) == ["baked_occlusion"]
    before = there.device.counts["draws"]
    there.draw()
    assert there.device.counts["draws"] - before < 16


def test_points_that_were_drawn_give_what_was_drawn(device):
    knobs = {"directions": 16, "map": 64, "spacing": 0.2}
    there = renderer(
        device, load("torus"), (48, 32), Choice(use=("baked_occlusion",), settings={"baked_occlusion": knobs})
    )
    drawn = there.capture((0.2, -0.3))
    there.capture((-0.4, 0.1))
    again = there.shade(drawn.points).frame["environment_visibility"]
    # The offset is found from float32 positions, to 1e-5 of a pixel: at a silhouette another triangle may be seen.
    off = np.abs(again - drawn.frame["environment_visibility"]).max(axis=2) > 1e-3
    assert off.mean() < 0.01


def test_a_mask_s_holes_are_open(device):
    """What is seen through a hole has its own share; and the hole lets the sky through."""
    holes = image([[[255, 255, 255, 0]]])
    grid = Material("holes", base_color_texture=Texture(holes, srgb=True), alpha_mode="mask")
    above = Shape("above", shapes.rectangle(1.0, 1.0), grid, moved(z=0.3))
    scene = scene_of(facing(WHITE), above, radiance=(1, 1, 1))
    found, points, _ = baked(device, scene, directions=32, map=64, spacing=0.2)
    assert (points.shape[8:-8, 8:-8] == 0).all()
    np.testing.assert_allclose(found[8:-8, 8:-8], 1.0, atol=1e-5)


def test_it_costs_a_draw_for_each_shape_where_it_is_asked_for_and_nothing_else():
    """Beside the baking (a program, a depth map): a program, a texture and its depth; a buffer and its program.

    A draw for each shape and one for the visibility.
    """
    knobs = {"baked_occlusion": {"directions": 8, "map": 32}}
    choice = Choice(use=("baked_occlusion",), settings=knobs)
    plain, used = counted(SKY), counted(SKY, choice)
    assert used[1]["shaders"] - plain[1]["shaders"] == 1 + 1 + 1
    assert used[1]["textures"] - plain[1]["textures"] == 1 + 2 + 1
    there = renderer(Device(), SKY, (16, 16), choice)
    before = there.device.counts["draws"]
    there.draw()
    assert there.device.counts["draws"] - before == len(SKY.shapes) + len(SKY.shapes) + 1 + 1 + 1 + 2
    for scene in (scene_of(facing(WHITE), radiance=(1, 1, 1)), scene_of(facing(WHITE), BALL)):
        assert counted(scene, choice) == counted(scene)
