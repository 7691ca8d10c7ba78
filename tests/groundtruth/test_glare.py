"""Diffraction at an aperture: closed forms, and what a picture gets of it."""

import numpy as np
import pytest
from scipy.special import j0, j1

from lightmeter.groundtruth.diffraction import BANDS, bessel_j1, density, point_spread
from lightmeter.groundtruth.oracles import exposure, glare
from lightmeter.groundtruth.variant import mi
from lightmeter.scenes.aperture import Aperture
from lightmeter.scenes.metering import Metering
from lightmeter.scenes.model import Camera

SIZE = 64, 48


def camera(**given) -> Camera:
    return Camera("", np.eye(4), yfov=1.0, **given)


def test_bessel_function():
    """Its polynomials err by 4e-8 in size and phase; the phase's float32 rounding by 2⁻²⁴·x, of at most √(2/πx)."""
    x = np.linspace(0, 300, 5001).astype(np.float32)
    allowed = 1.3e-7 + 2.0**-24 * x * np.sqrt(2 / np.pi / np.maximum(x, 1))
    assert (np.abs(np.array(bessel_j1(mi.Float(x))) - j1(x.astype(np.float64))) <= allowed).all()


@pytest.mark.parametrize("radius", [4.5, 12.5, 20.5])
def test_a_circle_s_encircled_energy(radius):
    """Rayleigh 1881: outside a circle of radius r lie J₀² + J₁² of v = πr/λN.

    A pixel on the circle's edge is in or out: 2πr pixels, at random by half of themselves, of density c/(2πr³).
    Samples: 1/√64 of a pixel's light each.
    """
    spread = point_spread(Aperture(16.0), SIZE)
    y, x = np.mgrid[1 - SIZE[1] : SIZE[1], 1 - SIZE[0] : SIZE[0]]
    outside = 1 - spread[np.hypot(x, y) <= radius].sum(axis=0)
    for channel, (low, high) in enumerate(BANDS):
        v = np.pi * radius * (0.024 / SIZE[1]) / (np.linspace(low, high, 101) * 16)
        expected = np.mean(j0(v) ** 2 + j1(v) ** 2)
        edge = expected / radius * np.sqrt(2 * np.pi * radius) / (2 * np.pi * radius)
        assert outside[channel] == pytest.approx(expected, abs=4 * edge)


def test_light_is_spread_and_not_made():
    """What falls outside the picture's width is 2c/π·√(a² + b²)/(ab) for a circle: it is not in the sum."""
    for aperture in (Aperture(16.0), Aperture(16.0, blades=5)):
        spread = point_spread(aperture, SIZE)
        missing = 1 - spread.sum(axis=(0, 1))
        assert (spread >= 0).all() and (missing > 0).all() and (missing < 1e-3).all()
        np.testing.assert_array_equal(spread, spread[::-1, ::-1])


def test_a_polygon_of_many_corners_is_a_circle():
    x = mi.Point2f(np.linspace(0.01, 6, 400).astype(np.float32), np.linspace(0.0, 2.0, 400).astype(np.float32))
    circle, polygon = (np.array(density(Aperture(blades=blades), x)) for blades in (0, 64))
    # The radius of a polygon of the same area varies by π²/(2·64²), 1.2e-3: so do places, x·dI/dx at most 4·I(0).
    assert np.abs(circle - polygon).max() <= 4 * 1.2e-3 * np.pi / 4


def test_the_density_in_the_middle_is_the_area():
    for blades in (0, 3, 6):
        assert np.array(density(Aperture(blades=blades), mi.Point2f(1e-6, 0.0)))[0] == pytest.approx(
            np.pi / 4, rel=1e-4
        )


def test_spikes_stand_across_the_edges():
    """A triangle's lower edge lies level at rotation 0: its spike is upright. Turned by 20° it leans to the left."""

    def direction(rotation: float) -> float:
        spread = point_spread(Aperture(22.0, 3, np.radians(rotation)), (65, 65))[..., 1]
        y, x = np.mgrid[-64:65, -64:65]
        ring = (np.hypot(x, y) > 20) & (np.hypot(x, y) < 40) & (np.abs(np.degrees(np.arctan2(x, -y))) < 29)
        return float(np.average(np.degrees(np.arctan2(x, -y))[ring], weights=spread[ring]))

    assert direction(0.0) == pytest.approx(0.0, abs=1.0)
    assert direction(20.0) == pytest.approx(-20.0, abs=2.0)


def test_glare_of_a_lamp_is_its_spread():
    image = np.zeros((SIZE[1], SIZE[0], 3))
    image[10, 20] = 1000, 100, 10
    there = camera(aperture=Aperture(16.0, 6))
    glared = glare.evaluate(image, there)
    spread = point_spread(there.aperture, SIZE)[SIZE[1] - 1 - 10 :, SIZE[0] - 1 - 20 :][: SIZE[1], : SIZE[0]]
    np.testing.assert_allclose(glared, spread * (1000, 100, 10), rtol=1e-5, atol=1e-10)
    image[30, 30] = np.nan
    assert np.isnan(glare.evaluate(image, there)[30, 30]).all()
    assert np.isfinite(np.delete(glare.evaluate(image, there), 30, axis=0)).all()


def test_exposure_is_the_rule_on_the_exact_luminances():
    image = np.full((4, 4, 3), 0.5)
    np.testing.assert_allclose(exposure.evaluate(image, camera(exposure=1.0)), 1.0)
    np.testing.assert_allclose(exposure.evaluate(image, camera(exposure=1.0, metering=Metering(grey=0.25))), 0.5)
