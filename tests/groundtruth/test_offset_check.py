"""Scenes far from the origin, or small: the float32 breakdown is found, and what is sound is not accused."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth import offset_check
from lightmeter.groundtruth.offset_check import OffsetCheck, check_offset, is_far
from lightmeter.scenes import library
from lightmeter.scenes.load import load
from lightmeter.scenes.moving import moved, scaled

AWAY = np.array([1.0, 0.3, -1.0])
SIZE = (24, 24)


@pytest.mark.parametrize("name", ["torus", "cornell-box"])
def test_the_breakdown_far_from_the_origin_is_found(name):
    scene = load(name)
    differences = {}
    for distance in (1e5, 1e6):
        found = check_offset(moved(scene, distance * AWAY), SIZE)
        assert not found.holds, found
        assert found.reach == pytest.approx(distance, rel=1e-3)
        assert f"{found.reach:.3g} m from the origin" in found.words
        differences[distance] = found.difference
    assert min(differences.values()) > 0.1


def test_the_breakdown_of_a_small_scene_is_found():
    """0.1 mm is a tenth of the height of a Cornell box of a millimetre, and nothing to one of a kilometre."""
    scene = load("cornell-box")
    assert not is_far(scaled(scene, 2.0**10))
    small = scaled(scene, 2.0**-10)
    assert is_far(small)
    found = check_offset(small, SIZE)
    assert not found.holds, found
    assert "scale the scene up" in found.words


@pytest.mark.parametrize("name", ["torus", "cornell-box"])
def test_a_scene_at_the_origin_holds(name):
    """The camera is a few metres off the origin there, which costs two bits of 24."""
    found = check_offset(load(name), (48, 24))
    assert found.holds, found
    assert found.low < 0.1 * offset_check.TOLERANCE


def test_what_is_sound_costs_no_check():
    for name in library.names():
        assert not is_far(load(name)), name
    scene = load("posts")
    assert is_far(moved(scene, 1e4 * AWAY))
    assert not is_far(replace(moved(scene, 1e4 * AWAY), shapes=()))


def test_a_black_scene_and_one_that_is_not_finite(monkeypatch):
    from lightmeter.groundtruth import reference

    scene = load("torus")
    assert check_offset(replace(scene, lights=(), environment=None), (8, 8)).holds

    def render(world, size, spp, seed, batch):
        broken = world.scene is scene
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
