"""camera.json's matrices and pixel rule, against the ray caster and against what the renderer draws."""

import json

import numpy as np
import pytest

from lightmeter.scenes import shapes
from lightmeter.scenes.export import camera_document
from lightmeter.scenes.model import Shape

from .ray_casting import rays
from .small_scenes import WHITE, points, scene_of
from .test_camera_conventions import CAMERAS, SIZE, bound


def told(scene) -> dict:
    """camera.json as an engine reads it."""
    return json.loads(json.dumps(camera_document(scene, SIZE)))


def pixels(document: dict, world: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where world points (…, 3) land, (…, 2) pixels right and down, and z/w, as the conventions say."""
    camera, (width, height) = document["camera"], document["size"]
    point = np.concatenate([world, np.ones((*world.shape[:-1], 1))], axis=-1)
    matrix = np.array(camera["clip_from_camera"]) @ np.array(camera["camera_from_world"])
    x, y, z, w = np.moveaxis(point @ matrix.T, -1, 0)
    return np.stack([(1 + x / w) * width / 2, (1 - y / w) * height / 2], axis=-1), z / w


def centres() -> np.ndarray:
    """(H, W, 2): every pixel's centre."""
    row, column = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
    return np.stack([column + 0.5, row + 0.5], axis=-1)


@pytest.mark.parametrize("name", CAMERAS)
def test_points_along_a_pixels_ray_land_on_its_centre(name):
    view = CAMERAS[name]
    document = told(scene_of(view=view))
    origins, directions = rays(view, SIZE)
    forward, position = (np.array(document["camera"][key]) for key in ("forward", "position"))
    for depth in (view.near, 1.7, view.far):
        world = origins + depth * directions
        found, z = pixels(document, world)
        assert np.abs(found - centres()).max() < 1e-9
        assert np.abs((world - position) @ forward - depth).max() < 1e-12 * depth
        if depth != 1.7:
            assert np.abs(z - (-1 if depth == view.near else 1)).max() < 1e-9


@pytest.mark.parametrize("name", CAMERAS)
def test_what_a_pixel_shows_lands_on_its_centre(device, name):
    """The bound on a position (see `bound`) d moves its image by d/depth across and, within 45° of the axis, by as
    much again along it; half the height in pixels is `clip_from_camera`'s scale times that."""
    view = CAMERAS[name]
    mesh = shapes.box(0.9, 1.1, 0.7)
    scene = scene_of(Shape("it", mesh, WHITE), view=view)
    document, seen = told(scene), points(device, scene, SIZE)
    found, _ = pixels(document, seen.position[seen.hit].astype(np.float64))
    depth = (seen.position[seen.hit] - view.position) @ np.array(document["camera"]["forward"])
    nearest = depth.min() if view.yfov is not None else 1.0
    per_metre = document["camera"]["clip_from_camera"][1][1] * SIZE[1] / 2 / nearest
    assert seen.hit.sum() > 100
    assert np.abs(found - centres()[seen.hit]).max() <= 2 * bound(mesh, view) * per_metre < 0.01


@pytest.mark.parametrize("name", CAMERAS)
def test_the_matrices_say_what_the_numbers_say(name):
    camera = told(scene_of(view=CAMERAS[name]))["camera"]
    world_from_camera = np.array(camera["world_from_camera"])
    assert np.allclose(world_from_camera @ camera["camera_from_world"], np.eye(4), atol=1e-12)
    for key, column, sign in (("position", 3, 1), ("forward", 2, -1), ("up", 1, 1)):
        assert np.array_equal(camera[key], sign * world_from_camera[:3, column])
    scale = camera["clip_from_camera"][1][1]
    lens = np.tan(camera["yfov"] / 2) if camera["kind"] == "perspective" else camera["ymag"]
    assert scale == pytest.approx(1 / lens, rel=1e-12)
    assert camera["clip_from_camera"][0][0] == pytest.approx(scale / camera["aspect"], rel=1e-12)
    assert (camera["yfov"] is None) != (camera["ymag"] is None)
