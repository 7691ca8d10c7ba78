"""Environment maps: which direction a texel stands for, and what a file may hold."""

import numpy as np
import pytest

from lightmeter.reports.image_files import write_exr
from lightmeter.scenes.environments import as_seen, environment_from
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Environment, Image
from lightmeter.scenes.optics import environment as optics

SHAPE = '\n[[shapes]]\nname = "ball"\ntype = "sphere"\nradius = 1\n'

RNG = np.random.default_rng(7)


def directions(count: int = 500) -> np.ndarray:
    v = RNG.normal(size=(3, count))
    return v / np.linalg.norm(v, axis=0)


def marked(column: int, row: int, width: int = 16, height: int = 8) -> Environment:
    """A map with one bright texel."""
    texels = np.zeros((height, width, 3), np.float32)
    texels[row, column] = 1
    return Environment((1.0, 1.0, 1.0), Image(texels))


@pytest.mark.parametrize(
    ("looks", "u", "v"),
    [
        ((1, 0, 0), 0.5, 0.5),
        ((0, 0, 1), 0.75, 0.5),
        ((0, 0, -1), 0.25, 0.5),
        ((0, 1, 0), None, 0.0),
        ((0, -1, 0), None, 1.0),
    ],
)
def test_where_the_axes_lie(looks, u, v):
    found_u, found_v = optics.coordinates(np.array(looks, float)[:, None], 0.0)
    assert found_v[0] == pytest.approx(v, abs=1e-12)
    if u is not None:
        assert found_u[0] == pytest.approx(u, abs=1e-12)


def test_a_direction_goes_to_the_map_and_back():
    d = directions()
    back = optics.direction_at(*optics.coordinates(d, 0.8), 0.8)
    np.testing.assert_allclose(back, d, atol=1e-12)


def test_turning_is_anticlockwise_as_seen_from_above():
    """What was seen along +X is, after a quarter turn anticlockwise from above, along −Z (Y up, right-handed)."""
    east = np.array([[1.0], [0.0], [0.0]])
    north = np.array([[0.0], [0.0], [-1.0]])
    still = Environment((1, 1, 1), Image(RNG.uniform(0, 1, (8, 16, 3)).astype(np.float32)))
    turned = Environment((1, 1, 1), still.map, np.pi / 2)
    np.testing.assert_allclose(optics.radiance(turned, north), optics.radiance(still, east), atol=1e-12)


def test_a_texels_centre_has_its_value_and_the_seam_is_none():
    env = marked(0, 3)
    u, v = 0.5 / 16, 3.5 / 8
    centre = np.array(optics.direction_at(np.array([u]), np.array([v]), 0.0))
    assert optics.radiance(env, centre)[0, 0] == pytest.approx(1.0)
    across = np.array(optics.direction_at(np.array([1 - 0.25 / 16]), np.array([v]), 0.0))  # a quarter beyond the seam
    assert optics.radiance(env, across)[0, 0] == pytest.approx(0.25)


def test_the_mean_is_over_the_sphere():
    env = Environment((2.0, 1.0, 0.5), Image(RNG.uniform(0, 1, (32, 64, 3)).astype(np.float32)))
    n = 400_000
    z, phi = RNG.uniform(-1, 1, n), RNG.uniform(0, 2 * np.pi, n)
    r = np.sqrt(1 - z * z)
    sampled = optics.radiance(env, np.stack([r * np.cos(phi), z, r * np.sin(phi)]))
    # Five standard errors; the rows' weights are those of their centres, off by O(1/32²) of the spread.
    slack = 5 * sampled.std(axis=1) / np.sqrt(n) + 1e-3
    assert (np.abs(sampled.mean(axis=1) - env.mean) < slack).all()


def test_a_map_as_it_is_seen_has_rotation_and_factor_in_it():
    still = Environment((2.0, 1.0, 1.0), Image(RNG.uniform(0, 1, (8, 16, 3)).astype(np.float32)), 2 * np.pi * 3 / 16)
    baked = Environment((1.0, 1.0, 1.0), Image(as_seen(still, (1, 1))))
    d = directions()
    np.testing.assert_allclose(optics.radiance(baked, d), optics.radiance(still, d), atol=1e-6)


def test_a_scene_file_names_its_map(tmp_path):
    write_exr(tmp_path / "sky.exr", np.full((4, 8, 3), 0.5, np.float32))
    (tmp_path / "a.toml").write_text('[environment]\nmap = "sky.exr"\nrotate = 90\nradiance = 2\n' + SHAPE)
    found = load(tmp_path / "a.toml").environment
    assert found.mean == pytest.approx((1.0, 1.0, 1.0))
    assert found.rotation == pytest.approx(np.pi / 2)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[environment]\nmap = "no.exr"', "cannot be read"),
        ('[environment]\nmap = "../sky.exr"', "out of the scene's folder"),
        ("[environment]\nrotate = 90", "a radiance, a map or both"),
        ("[environment]\nradiance = 1\nrotate = 90", "there is none"),
        ('[environment]\nmap = "bad.exr"', "2 negative, 1 infinite, 1 NaN, the first at column 1, row 0"),
        ('[environment]\nmap = "tiny.exr"', "too small"),
    ],
)
def test_maps_that_make_no_sense(tmp_path, text, said):
    (tmp_path / "scene").mkdir()
    write_exr(tmp_path / "sky.exr", np.ones((4, 8, 3), np.float32))
    write_exr(tmp_path / "scene" / "bad.exr", bad_texels())
    write_exr(tmp_path / "scene" / "tiny.exr", np.ones((1, 1, 3), np.float32))
    path = tmp_path / "scene" / "a.toml"
    path.write_text(text + SHAPE)
    with pytest.raises(SceneError) as raised:
        load(path)
    assert said in str(raised.value)


def bad_texels() -> np.ndarray:
    texels = np.full((4, 8, 3), 0.5, np.float32)
    texels[0, 1, 0], texels[2, 2, 1], texels[3, 3, 2], texels[1, 7, 0] = -1, -2, np.inf, np.nan
    return texels


def test_clamping_is_told(tmp_path):
    path, notes = write_exr(tmp_path / "bad.exr", bad_texels()), []
    env = environment_from(path, clamp=True, note=notes.append)
    assert "2 negative, 1 infinite, 1 NaN texels of 32" in notes[0]
    assert env.map.texels[0, 1, 0] == 0
    assert env.map.texels[3, 3, 2] == 0.5
    assert np.isfinite(env.map.texels).all()
