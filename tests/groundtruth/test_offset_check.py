"""What float32 still does to a scene in its own frame: what is wrong is found, and what is sound is not accused."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth import offset_check
from lightmeter.groundtruth.frame import Frame
from lightmeter.groundtruth.offset_check import OffsetCheck, check_offset, is_far
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene, Shape
from lightmeter.scenes.moving import moved, scaled

from .small_scenes import WHITE, rectangle

AWAY = np.array([1.0, 0.3, -1.0])
SIZE = (24, 24)


def through_a_telescope(distance: float) -> Scene:
    """A Cornell box seen from so many metres away, with a card beneath the camera, all of it far from the origin."""
    box = load("cornell-box")
    matrix = box.camera.matrix.copy()
    matrix[:3, 3] = np.mean(box.bounds, axis=0) + distance * matrix[:3, 2]
    x, y, z = matrix[:3, 3]
    card = Shape("card", rectangle((x - 0.5, y - 1, z + 0.5), (1, 0, 0), (0, 0, -1)), WHITE)
    camera = replace(box.camera, matrix=matrix, yfov=2 * np.arctan(0.35 / distance))
    return moved(replace(box, camera=camera, shapes=(*box.shapes, card)), 1e6 * AWAY)


@pytest.mark.parametrize("distance", [300.0, 1e4])
def test_what_is_seen_far_from_everything_near_is_found(distance):
    """The frame's origin is at the card, and rays in the box start 3 cm or 90 cm off their surfaces: of a box of 56 cm
    the one is some, the other all. The one shows in a coarser frame too, the other only about the box."""
    found = check_offset(through_a_telescope(distance), SIZE)
    assert not found.holds, found
    assert found.reach == pytest.approx(1e6, rel=1e-3)
    assert "1e+06 m from the origin" in found.words


def test_each_of_the_other_frames_finds_what_is_wrong(monkeypatch):
    """In place of one of them is the world's, with 9 cm at a kilometre: 12 % of a Cornell box, of which a third is laid
    to the truth where the frame is meant to be the coarser one."""
    scene = moved(load("cornell-box"), 1e3 * AWAY)
    frame, about = Frame.of(scene), Frame.about
    world = -frame.origin * frame.scale  # the world's origin, in the frame
    for number, (low, high) in enumerate([(0.1, 0.15), (0.1 / 3, 0.15 / 3)]):
        asked = []

        def elsewhere(frame, point, number=number, asked=asked):
            asked.append(point)
            return Frame(np.zeros(3)) if len(asked) == 1 + number else about(frame, np.zeros(3))

        monkeypatch.setattr(Frame, "about", elsewhere)
        found = check_offset(scene, SIZE)
        assert low < found.difference < high, found
        assert not found.holds
    middle, away = asked
    assert np.abs(middle).max() < np.abs(world).max() / 100
    # Four times as far as the middle one of what is seen, and the metre that the offset has there.
    np.testing.assert_allclose(middle - away, 3 * (1 + np.abs(middle).max()))


@pytest.mark.parametrize(
    ("name", "distance", "size"),
    [
        ("cornell-box", 0.0, 1.0),
        ("cornell-box", 1e6, 1.0),
        ("cornell-box", 0.0, 2.0**-10),
        ("torus", 1e3, 1e-3),
        ("torus", 0.0, 1024.0),
    ],
)
def test_a_sound_scene_holds(name, distance, size):
    found = check_offset(moved(scaled(load(name), size), distance * AWAY), (32, 16))
    assert found.holds, found
    assert found.low < 0.1 * offset_check.TOLERANCE


def test_what_needs_no_check():
    scene = load("posts")
    assert not is_far(scene)
    assert is_far(moved(scene, 1e4 * AWAY))
    assert is_far(scaled(scene, 2.0**-10))
    assert not is_far(replace(moved(scene, 1e4 * AWAY), shapes=()))


def test_a_black_scene_and_one_that_is_not_finite(monkeypatch):
    from lightmeter.groundtruth import reference

    scene = load("torus")
    assert check_offset(replace(scene, lights=(), environment=None), (8, 8)).holds
    assert check_offset(replace(moved(scene, 1e4 * AWAY), shapes=()), (8, 8)).holds

    def render(world, size, spp, seed, batch):
        broken = world.frame.is_world
        return np.full((size[1], size[0], 3), np.nan if broken else 1.0, np.float32)

    monkeypatch.setattr(reference, "render_batch", render)
    found = check_offset(scene, (8, 8))
    assert not found.holds
    assert np.isnan(found.difference)


def test_tolerance():
    assert OffsetCheck(0.5, 0.01, 1.0).holds
    assert not OffsetCheck(0.5, 0.011, 1.0).holds


def test_a_moved_scene_is_the_same_scene():
    scene = load("cornell-box")
    by = np.array([64.0, -8.0, 0.5])  # exact in float32 for these scenes' coordinates to 1e-5
    there = moved(scene, by)
    for a, b in zip(scene.shapes, there.shapes, strict=True):
        np.testing.assert_allclose(b.world.positions - by, a.world.positions, atol=1e-5)
    np.testing.assert_array_equal(there.camera.position, scene.camera.position + by)
    np.testing.assert_array_equal(there.camera.matrix[:3, :3], scene.camera.matrix[:3, :3])
    lit = load("posts")
    for a, b in zip(lit.lights, moved(lit, by).lights, strict=True):
        if hasattr(a, "position"):
            np.testing.assert_allclose(np.subtract(b.position, a.position), by)
        else:
            assert a == b
