"""The built-in sky and studio: energies, directions, and how scenes and commands name them."""

import numpy as np
import pytest

from lightmeter.scenes import sky as daylight
from lightmeter.scenes.environments import BUILT_IN, built_in
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.load import load
from lightmeter.scenes.optics import environment as optics
from lightmeter.scenes.studio import BOXES, studio

HEIGHT = 128
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
BALL = '\n[[shapes]]\nname = "ball"\ntype = "sphere"\nradius = 1\n'


def directions_and_solid_angles(height: int):
    u, v = np.meshgrid((np.arange(2 * height) + 0.5) / (2 * height), (np.arange(height) + 0.5) / height)
    edges = np.cos(np.pi * np.arange(height + 1) / height)
    solid = np.repeat(((edges[:-1] - edges[1:]) * np.pi / height)[:, None], 2 * height, axis=1)
    return np.stack(optics.direction_at(u, v, 0.0)), solid


def sun_at(elevation: float) -> np.ndarray:
    up, away = np.sin(np.radians(elevation)), np.cos(np.radians(elevation))
    return np.array([away * np.cos(daylight.AZIMUTH), up, away * np.sin(daylight.AZIMUTH)])


@pytest.mark.parametrize(("elevation", "turbidity"), [(45.0, 3.0), (10.0, 2.0), (80.0, 8.0), (0.5, 10.0), (90.0, 2.0)])
@pytest.mark.parametrize("height", [HEIGHT, 512])
def test_the_sun_sends_what_the_air_leaves_of_it(elevation, turbidity, height):
    """However few texels it covers: its excess over the sky beside it, times their solid angles."""
    texels = daylight.sky(elevation, turbidity, height).texels.astype(np.float64)
    directions, solid = directions_and_solid_angles(height)
    cosine = np.tensordot(sun_at(elevation), directions, 1)
    above = directions[1] > 0
    near = (cosine > np.cos(daylight.SUN_ANGLE + 1.6 * np.pi / height)) & above
    ring = (cosine > np.cos(daylight.SUN_ANGLE + 5 * np.pi / height)) & ~near & above
    sent = np.sum((texels * solid[..., None])[near], axis=0) - texels[ring].mean(axis=0) * solid[near].sum()
    expected = 12.8 * daylight.transmittance(np.radians(90 - elevation), turbidity)
    # The sky is not quite even under its sun: some 30 % of up to 5, over the texels taken.
    np.testing.assert_allclose(sent, expected, atol=0.3 * 5 * solid[near].sum() + 1e-4)
    brightest = np.unravel_index(np.argmax(texels.sum(axis=2)), solid.shape)
    assert cosine[brightest] > np.cos(1.5 * np.pi / height)


def test_the_air_reddens_a_low_sun():
    high, low = (daylight.transmittance(np.radians(angle), 3.0) for angle in (0.0, 85.0))
    assert np.all(low < high) and low[0] / low[2] > 3 * high[0] / high[2]
    # Straight up through clear air: Rayleigh's optical depth at 0.55 µm is 0.0083·0.55⁻⁴ ≈ 0.1 (Bucholtz 1995: 0.097).
    clear = daylight.transmittance(0.0, 1.0)
    assert -np.log(clear[1]) - 0.085 * 0.35 - 0.00022 / 0.55**1.3 == pytest.approx(0.097, rel=0.05)


def test_the_zenith_has_the_published_luminance():
    """Preetham et al. 1999, appendix A.2: Yz = (4.0453T − 4.9710)·tan χ − 0.2155T + 2.4192 kcd/m²."""
    texels = daylight.sky(elevation=30.0, turbidity=4.0, height=HEIGHT).texels
    chi = (4 / 9 - 4 / 120) * (np.pi - 2 * np.radians(60))
    published = (4.0453 * 4 - 4.9710) * np.tan(chi) - 0.2155 * 4 + 2.4192
    # The first row lies 0.7° below the zenith, on average over all azimuths beside it.
    assert texels[0].mean(axis=0) @ LUMINANCE * 10 == pytest.approx(published, rel=0.01)


def test_the_ground_reflects_what_falls_on_it():
    texels = daylight.sky(height=HEIGHT).texels.astype(np.float64)
    directions, solid = directions_and_solid_angles(HEIGHT)
    falls = np.sum(texels * (np.maximum(directions[1], 0) * solid)[..., None], axis=(0, 1))
    np.testing.assert_allclose(texels[-1, 0], 0.2 * falls / np.pi, rtol=2e-3)  # the sun's texels are not at its centre
    assert np.ptp(texels[HEIGHT // 2 + 1 :], axis=(0, 1)).max() == 0


@pytest.mark.parametrize("turbidity", [2.0, 10.0])
@pytest.mark.parametrize("elevation", [0.1, 20.0, 90.0])
def test_every_texel_is_light(elevation, turbidity):
    texels = daylight.sky(elevation, turbidity, 64).texels
    assert np.isfinite(texels).all() and texels.min() >= 0


def test_the_studio_shows_its_boxes_where_they_stand():
    image = studio(HEIGHT)
    directions, _ = directions_and_solid_angles(HEIGHT)
    for box in BOXES:
        axis = np.array(box.towards) / np.linalg.norm(box.towards)
        seen = np.unravel_index(np.argmax(np.tensordot(axis, directions, 1)), directions.shape[1:])
        assert np.all(image.texels[seen] >= np.array(box.radiance, np.float32))
    below = directions[1] < -0.5
    assert image.texels[below].max() < 0.2


def test_a_scene_names_its_sky(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text('[environment]\nmap = "sky"\nelevation = 20\nturbidity = 5\nrotate = 90\n' + BALL)
    found = load(path).environment
    assert found is not None and found.map is not None and found.rotation == pytest.approx(np.pi / 2)
    np.testing.assert_array_equal(found.map.texels, daylight.sky(20.0, 5.0).texels)
    path.write_text('[environment]\nmap = "studio"\nradiance = 2\n' + BALL)
    studio_scene = load(path).environment
    assert studio_scene is not None and studio_scene.radiance == (2.0, 2.0, 2.0)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('map = "studio"\nelevation = 20', "of the built-in map 'sky'"),
        ('map = "sky"\nelevation = 0', "environment.elevation"),
        ('map = "sky"\nelevation = 91', "environment.elevation"),
        ('map = "sky"\nturbidity = 1', "environment.turbidity"),
        ('map = "sky"\nturbidity = "thick"', "environment.turbidity"),
        ("radiance = 1\nelevation = 20", "of the built-in map 'sky'"),
        ('map = "skies"', "skies"),
    ],
)
def test_a_wrong_sky_is_told(tmp_path, text, told):
    path = tmp_path / "s.toml"
    path.write_text(f"[environment]\n{text}\n{BALL}")
    with pytest.raises(SceneError, match=told):
        load(path)


def test_every_built_in_map_is_there():
    for name in BUILT_IN:
        assert built_in(name, degrees=30.0).shines
