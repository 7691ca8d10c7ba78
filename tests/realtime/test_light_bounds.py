"""Lights with a range: the part of the picture that they are drawn in, and that nothing is missing beyond it."""

import math

import numpy as np
import pytest

from lightmeter.realtime.device import Device
from lightmeter.realtime.graph import Choice
from lightmeter.realtime.light_bounds import reached
from lightmeter.realtime.projection import projection_matrix, view_matrix
from lightmeter.realtime.shading import ShadingPass
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, DirectionalLight, PointLight, Shape, SpotLight

from .small_scenes import LAMP, WHITE, camera, renderer, scene_of

SIZE = (160, 90)
FLOOR = Shape("floor", shapes.plane(8, 8), WHITE)
ABOVE = camera((0.0, 4.0, 5.0), (0.0, 0.0, 0.0), yfov=0.8)


def light_at(position, reach) -> PointLight:
    return PointLight("light", tuple(map(float, position)), (1, 1, 1), reach)


def windows(view: Camera, points: np.ndarray) -> np.ndarray:
    """Where points between the clipping planes land, in pixels from the bottom left."""
    clip = np.column_stack([points, np.ones(len(points))]) @ (projection_matrix(view, SIZE) @ view_matrix(view)).T
    ahead = clip[(clip[:, 3] > 0) & (np.abs(clip[:, 2]) <= clip[:, 3])]
    return (ahead[:, :2] / ahead[:, 3:] + 1) / 2 * SIZE


@pytest.mark.parametrize("lens", [{"yfov": 1.2}, {"ymag": 2.0}], ids=["perspective", "orthographic"])
def test_the_rectangle_is_the_tightest_around_the_sphere(lens):
    """Against many points of the sphere, near and far, beside and around the camera.

    Within the picture each side is met by the sphere to a pixel of margin, one of rounding to whole pixels, and what
    4,096 points leave uncovered: 1/64 of the radius, squared, of its width.
    """
    rng = np.random.default_rng(2)
    normals = rng.normal(size=(4096, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    view = Camera("c", look_at((0.4, 0.2, 3.0), (0, 0, 0)), near=0.01, **lens)
    inside = empty = 0
    for _ in range(300):
        light = light_at(rng.uniform(-4, 4, 3), float(np.exp(rng.uniform(-4, 1.5))))
        found = reached(view, SIZE, light)
        landed = windows(view, np.array(light.position) + light.range * normals)
        seen = landed[((landed >= 0) & (landed < SIZE)).all(axis=1)]
        if found is None:
            assert len(seen) == 0
            empty += 1
            continue
        left, bottom, width, height = found
        assert left >= 0 and bottom >= 0 and left + width <= SIZE[0] and bottom + height <= SIZE[1]
        if len(seen):
            assert (seen >= (left, bottom)).all() and (seen <= (left + width, bottom + height)).all()
        around = math.dist(light.position, view.position) <= light.range and "yfov" in lens
        if around:
            assert found == (0, 0, *SIZE)
            inside += 1
        elif len(landed) == len(normals) and len(seen) == len(landed):
            slack = 2 + 0.01 * np.ptp(landed, axis=0)
            assert (landed.min(axis=0) - (left, bottom) <= slack).all()
            assert ((left + width, bottom + height) - landed.max(axis=0) <= slack).all()
    assert empty > 10 and (inside > 10 or "ymag" in lens)


def test_lights_without_an_end_reach_everything():
    for light in (
        LAMP,
        DirectionalLight("sun", (0, -1, 0), (1, 1, 1)),
        SpotLight("s", (0, 9, 0), (0, -1, 0), (1, 1, 1), 0.1, 0.2),
    ):
        assert reached(ABOVE, SIZE, light) == (0, 0, *SIZE)


def some_lights(reach) -> tuple:
    rng = np.random.default_rng(5)
    places = rng.uniform((-3, 0.2, -3), (3, 1.0, 3), (12, 3))
    points = [light_at(place, reach) for place in places]
    spots = [
        SpotLight("spot", tuple(map(float, place)), (0.0, -1.0, 0.0), (2, 1, 1), 0.5, 1.2, reach)
        for place in 0.5 + places[:4]
    ]
    return (*points, *spots)


@pytest.mark.parametrize("grid", [1, 2])
def test_what_is_drawn_within_the_rectangles_is_the_whole_picture(device, monkeypatch, grid):
    """Bit for bit what full-screen passes give, in the frame and in what is captured; shadows included."""
    ball = Shape("ball", shapes.sphere(0.4, 24), WHITE)
    scene = scene_of(FLOOR, ball, lights=some_lights(1.5), view=ABOVE)
    choice = Choice(settings={"supersampling": {"grid": grid}, "shadow_map": {"resolution": 64}})
    there = renderer(device, scene, SIZE, choice)
    frame, seen = there.render().radiance, there.capture((0.3, -0.4))
    drawn = [there._passes["cook_torrance"].part(step) for step in there.plan.steps if step.light is not None]
    monkeypatch.setattr(ShadingPass, "part", lambda _self, _step: (0, 0, *SIZE))
    whole = renderer(device, scene, SIZE, choice)
    assert np.array_equal(frame, whole.render().radiance) and frame.max() > 0
    full = whole.capture((0.3, -0.4))
    for light in full.direct:
        assert np.array_equal(seen.direct[light], full.direct[light])
        lit = full.direct[light].max(axis=-1) > 0
        assert np.array_equal(seen.visibility[light][lit], full.visibility[light][lit])
        assert set(np.unique(seen.visibility[light])) <= set(np.unique(full.visibility[light])) | {1.0}
    share = np.mean([0 if part is None else part[2] * part[3] / (SIZE[0] * SIZE[1]) for part in drawn])
    assert share < 0.35


def test_a_light_that_reaches_nothing_in_the_picture_costs_nothing():
    counts = []
    for lights in ((LAMP,), (LAMP, light_at((0, 0, 40), 2.0), light_at((60, 0, 0), 2.0))):
        device = Device()
        maker = renderer(device, scene_of(FLOOR, Shape("ball", shapes.sphere(0.4, 8), WHITE), lights=lights), (16, 16))
        maker.draw()
        counts.append(device.counts["draws"])
    assert counts[0] == counts[1]
