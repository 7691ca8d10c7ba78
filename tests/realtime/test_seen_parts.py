"""Of a shadow map just what the frame looks up is drawn, and the frame does not know."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.projection import projection_matrix, view_matrix
from lightmeter.realtime.renderer import Renderer
from lightmeter.realtime.shadows.passes import ShadowPasses
from lightmeter.realtime.shadows.seen import looked_up, seen_solid
from lightmeter.realtime.shadows.views import shadow_views
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, DirectionalLight, PointLight, SpotLight
from lightmeter.scenes.moving import moved, scaled
from lightmeter.scenes.stiff.case import room
from lightmeter.scenes.stiff.materials import MIRROR

SIZE = (24, 16)
LIGHTS = (
    PointLight("above", (1.0, 2.5, 1.0), (1.0, 1.0, 1.0)),
    PointLight("within", (0.3, 0.4, 1.2), (1.0, 1.0, 1.0)),
    PointLight("at the eye", (0.0, 1.5, 4.0), (1.0, 1.0, 1.0)),
    DirectionalLight("sun", (-0.6, -0.64, -0.48), (1.0, 0.95, 0.9)),
    SpotLight("spot", (-2.0, 2.0, 2.0), (0.6, -0.6, -0.53), (9.0, 9.0, 9.0), inner=0.2, outer=0.7),
)
CAMERAS = (
    room().camera,
    Camera("down", look_at((0.5, 3.0, 0.2), (0.0, 0.0, 0.0)), yfov=0.3),
    Camera("along", look_at((-2.9, 0.2, 0.0), (3.0, 0.3, -0.4)), yfov=1.2, near=0.5, far=3.0),
    Camera("parallel", look_at((2.0, 2.0, 2.0), (0.0, 0.5, 0.0)), ymag=0.7),
)


@pytest.mark.parametrize("camera", CAMERAS, ids=lambda camera: camera.name)
def test_the_part_holds_all_that_is_seen_and_little_more(camera):
    scene = replace(room(), camera=camera, lights=LIGHTS)
    low, high = scene.bounds
    points = np.random.default_rng(0).uniform(low, high, (100_000, 3))
    points[:50_000, 1] = np.repeat([0.0, 1.0], 25_000)
    homogeneous = np.column_stack([points, np.ones(len(points))])
    clip = homogeneous @ (projection_matrix(camera, SIZE) @ view_matrix(camera)).T
    seen = homogeneous[(np.abs(clip[:, :3]) <= clip[:, 3:]).all(axis=1)]
    wide, tight = 0.0, 0.0
    for light in LIGHTS:
        views = shadow_views(scene, light, 256, 2)
        parts = looked_up(seen_solid(scene, SIZE), views, 256, 0)
        for matrix, part in zip(views.matrices, parts, strict=True):
            place = seen @ matrix.T
            place = place[(np.abs(place[:, :2]) <= place[:, 3:]).all(axis=1) & (place[:, 3] > 0)]
            wide += 0 if part is None else part[2] * part[3]
            if len(place):
                texels = (place[:, :2] / place[:, 3:] + 1) / 2 * 256
                assert (texels >= part[:2]).all() and (texels <= np.add(part[:2], part[2:])).all()
                tight += float(np.prod(np.ptp(texels, axis=0)))
    # A pixel of 16 wider on all sides is 1.27 times the area, and 100,000 points do not reach into every corner.
    assert wide < 2 * tight


def test_the_part_holds_what_float32_makes_of_places_far_away():
    """A shader multiplies a rounded position with a rounded matrix; here, of what is seen at the very edges."""
    here, away = replace(room(), lights=LIGHTS), np.array([1e6, 0.0, 1e6])
    far = moved(here, away)
    edges = seen_solid(here, (2400, 1600)).edges.reshape(-1, 3)
    middle = edges.mean(axis=0)
    inner = middle + 0.99 * (edges - middle) + away  # without the thickness that the solid is given
    seen = np.column_stack([inner, np.ones(len(inner))]).astype(np.float32)
    for light in far.lights:
        views = shadow_views(far, light, 256, 2)
        parts = looked_up(seen_solid(far, (2400, 1600)), views, 256, 0)
        for matrix, part in zip(views.matrices, parts, strict=True):
            place = seen @ matrix.astype(np.float32).T
            place = place[(np.abs(place[:, :2]) <= place[:, 3:]).all(axis=1) & (place[:, 3] > 0)]
            texels = (place[:, :2] / place[:, 3:] + 1) / 2 * 256
            assert not len(place) or ((texels >= part[:2]).all() and (texels <= np.add(part[:2], part[2:])).all())


def frames(monkeypatch, scene, use: str, near_by: bool, beside: tuple[str, ...] = ()):
    """The frame and a capture aside from the pixels' centres, from maps that hold only what is drawn into them now."""
    monkeypatch.setattr(ShadowPasses, "near_by", near_by)
    draw = ShadowPasses.draw

    def spoilt(self, light):
        self.map(self.views(light)).framebuffer.clear(depth=0.0)  # all in the dark
        draw(self, light)

    with monkeypatch.context() as patch:
        patch.setattr(ShadowPasses, "draw", spoilt)
        plan = compile_plan(scene, effects(), Choice(use=(use, *beside), settings={use: {"resolution": 128}}))
        renderer = Renderer(Device(), plan, SIZE)
        captured = renderer.capture((0.49, -0.49)).visibility
        parts = [part for light in plan.lights_of(use) for part in renderer._passes[use].own.parts(light)]
        drawn = sum(0 if part is None else part[2] * part[3] for part in parts) / (128**2 * len(parts))
        return renderer.render().radiance, captured, drawn


@pytest.mark.parametrize("use", ["shadow_map", "cascaded_shadow_map", "moment_shadow_map", "exponential_shadow_map"])
@pytest.mark.parametrize("place", ["here", "far", "small"])
def test_a_frame_is_the_same_to_the_bit(monkeypatch, use, place):
    lights = LIGHTS[3:4] if use == "cascaded_shadow_map" else LIGHTS
    scene = replace(room(), lights=lights)
    scene = {"here": scene, "far": moved(scene, np.array([1e6, 0, 0])), "small": scaled(scene, 2.0**-10)}[place]
    part, whole = (frames(monkeypatch, scene, use, near_by) for near_by in (True, False))
    np.testing.assert_array_equal(part[0], whole[0])
    for light, visibility in whole[1].items():
        np.testing.assert_array_equal(part[1][light], visibility)
    assert whole[2] == 1
    if place == "here" and lights is LIGHTS:  # cascades are fitted to what is seen
        assert part[2] < 0.5


def test_what_is_seen_from_elsewhere_has_the_whole_map(monkeypatch):
    """The ball's cube map shows the floor around it, and the camera little but the ball."""
    scene = replace(room(ball=MIRROR), lights=LIGHTS[:1], camera=CAMERAS[1])
    part, whole = (
        frames(monkeypatch, scene, "shadow_map", near_by, ("dynamic_cube_map",)) for near_by in (True, False)
    )
    np.testing.assert_array_equal(part[0], whole[0])


def test_points_that_are_stored_in_few_bits_may_lie_elsewhere():
    plan = compile_plan(room(), effects(), Choice(use=("packed_surface",)))
    assert plan.stored()
    own = Renderer(Device(), plan, SIZE)._passes["shadow_map"].own
    assert set(own.parts(0)) == {(0, 0, own.resolution, own.resolution)}
