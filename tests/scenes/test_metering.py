"""The metering rule, by hand."""

import numpy as np
import pytest

from lightmeter.scenes.metering import Metering
from lightmeter.scenes.model import Camera


def greys(*values: float) -> np.ndarray:
    return np.repeat(np.array(values)[None, :, None], 3, axis=-1)


def test_a_log_average_is_brought_to_grey():
    image = greys(0.5, 2.0, 4.0, 0.25)
    assert Metering().average(image) == pytest.approx(0.0, abs=1e-12)
    assert Metering(grey=0.1).scale(2.0) == pytest.approx(0.025)
    camera = Camera("", np.eye(4), yfov=1.0, exposure=1.0, metering=Metering(grey=0.2))
    assert camera.exposure_scale(Metering().average(image)) == pytest.approx(0.4)
    assert camera.exposure_scale() == 2.0


def test_red_green_and_blue_count_as_they_are_bright():
    image = np.array([[[0.0, 1.0, 0.0]]])
    assert Metering().average(image) == pytest.approx(np.log2(0.7152))


def test_trims_take_part_of_a_pixel():
    """A quarter and a half pixel of four are left out: weights ¾, 1, 1, ½."""
    image = greys(1.0, 2.0, 4.0, 8.0)
    trimmed = Metering(darkest=0.25 / 4, brightest=0.5 / 4)
    assert trimmed.average(image) == pytest.approx((0.75 * 0 + 1 + 2 + 0.5 * 3) / 3.25)


def test_black_counts_as_the_floor_and_what_is_not_finite_not_at_all():
    assert Metering(floor=2.0**-10).average(greys(0.0, 1.0, np.nan, np.inf)) == pytest.approx(-5.0)
    assert Metering(floor=0.5).average(greys(np.nan)) == -1.0
