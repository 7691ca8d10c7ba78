"""The camera and the lights of a scene that brings none."""

import numpy as np
import pytest

from lightmeter.scenes import framing, shapes
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Material, Mesh, Shape


def ball(place=(0.0, 0.0, 0.0), radius=1.0) -> Shape:
    matrix = np.eye(4)
    matrix[:3, 3] = place
    return Shape("ball", shapes.sphere(radius), Material(), matrix)


@pytest.mark.parametrize("radius", [1e-3, 1.0, 500.0])
def test_the_framed_camera_sees_the_whole_ball_and_little_else(radius):
    place = np.array([3.0, -2.0, 7.0]) * radius
    camera = framing.framed_camera([ball(tuple(place), radius)])
    local = (ball(tuple(place), radius).world.positions - camera.position) @ camera.matrix[:3, :3]
    seen = np.abs(local[:, :2] / -local[:, 2:]).max() / np.tan(camera.yfov / 2)
    assert 0.85 < seen < 1
    assert camera.near < -local[:, 2].max() and -local[:, 2].min() < camera.far
    assert camera.near > 0 and camera.far / camera.near < 1e3
    np.testing.assert_allclose(np.linalg.det(camera.matrix[:3, :3]), 1)


def test_a_scene_without_size_still_gets_a_camera():
    point = Shape("p", Mesh(np.zeros((3, 3)), [[0, 1, 2]]), Material())
    for nothing in ([], [point]):
        assert np.isfinite(framing.framed_camera(nothing).matrix).all()


def test_look_at_keeps_up_and_copes_with_a_look_straight_down():
    matrix = framing.look_at((0, 0, 5), (0, 0, 0))
    np.testing.assert_allclose(matrix[:3, :3], np.eye(3), atol=1e-12)
    down = framing.look_at((0, 5, 0), (0, 0, 0))
    np.testing.assert_allclose(down[:3, 2], [0, 1, 0])
    np.testing.assert_allclose(down[:3, :3] @ down[:3, :3].T, np.eye(3), atol=1e-12)
    with pytest.raises(ValueError, match="target"):
        framing.look_at((1, 1, 1), (1, 1, 1))


def test_the_rig_gives_a_surface_that_faces_the_key_about_its_reflectance():
    """E from both lights and the environment is about π, so that a diffuse surface's radiance is its albedo."""
    camera = framing.framed_camera([ball()])
    lights, environment = framing.default_lights(camera)
    normal = -np.array(lights[0].direction)
    irradiance = np.pi * np.array(environment.radiance)
    for light in lights:
        assert np.linalg.norm(light.direction) == pytest.approx(1)
        irradiance += np.array(light.irradiance) * max(0, -normal @ light.direction)
    np.testing.assert_allclose(irradiance, np.pi, rtol=0.06)
    assert irradiance.mean() == pytest.approx(np.pi, rel=0.03)


def test_the_rig_turns_with_the_camera():
    camera = framing.framed_camera([ball()])
    (key, fill), _ = framing.default_lights(camera)
    local = camera.matrix[:3, :3].T @ np.array(key.direction)
    assert local[0] > 0 and local[1] < 0 and local[2] < 0  # from the upper left behind the viewer
    assert (camera.matrix[:3, :3].T @ np.array(fill.direction))[0] < 0


def test_rigid_drops_scale_and_refuses_what_has_no_direction():
    turned = framing.look_at((1, 2, 3), (4, 4, 4))
    np.testing.assert_allclose(framing.rigid(turned @ np.diag([2, 3, 4, 1.0]), ""), turned, atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(framing.rigid(np.diag([-1, 1, 1, 1.0]), "")[:3, :3]), 1)
    for bad in (np.diag([1, 1, 0, 1.0]), np.full((4, 4), np.nan), np.diag([1, 0, 1, 1.0])):
        with pytest.raises(SceneError, match="direction"):
            framing.rigid(bad, "camera")


def test_clipping_distances_hold_everything_in_front():
    near, far = framing.clipping_distances([ball((0, 0, -5))], np.eye(4))
    assert 3.9 < near < 4 and 6 < far < 6.1
    near, far = framing.clipping_distances([ball(radius=3)], np.eye(4))  # the camera is inside
    assert 0 < near < 1e-3 and far > 3
    assert framing.clipping_distances([], np.eye(4)) == (0.01, 100.0)
