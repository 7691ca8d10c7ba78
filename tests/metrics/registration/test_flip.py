"""Mirrored frames."""

import numpy as np
import pytest

from lightmeter.metrics.registration import correct, find_faults

from .pictures import Lighting, noisy, picture

SIDE = 64
FLIPS = {
    "mirrored left to right": (lambda image: image[:, ::-1], {"left_right": 1, "up_down": 0}),
    "upside down": (lambda image: image[::-1], {"left_right": 0, "up_down": 1}),
    "turned by 180°": (lambda image: image[::-1, ::-1], {"left_right": 1, "up_down": 1}),
}


@pytest.mark.parametrize("words", FLIPS)
@pytest.mark.parametrize("lighting", [Lighting(), Lighting(ambient=0, shadows=False)])
def test_a_flip_is_named(words, lighting):
    mirror, size = FLIPS[words]
    tested = mirror(picture(SIDE, lighting=lighting)).astype(np.float32)
    faults = find_faults(tested, noisy(picture(SIDE)))
    assert [fault.words for fault in faults] == [words]
    assert faults[0].size == size
    assert np.array_equal(correct(tested, faults), picture(SIDE, lighting=lighting).astype(np.float32))


def test_a_flip_is_found_before_everything_else():
    tested = 1.5 * picture(SIDE, right=1.5, down=-0.5)[:, ::-1]
    faults = find_faults(tested.astype(np.float32), noisy(picture(SIDE)))
    assert [fault.name for fault in faults] == ["flip", "shift", "exposure"]
    # The shift is that of the frame mirrored back; tolerances as in test_geometry and test_light.
    assert faults[1].size == pytest.approx({"right": 1.5, "down": -0.5}, abs=0.06)
    assert faults[2].size["factor"] == pytest.approx(1.5, rel=0.01)
    back = correct(tested.astype(np.float32), faults)
    assert find_faults(back, noisy(picture(SIDE))) == ()


def test_a_symmetrical_picture_cannot_tell():
    half = picture(SIDE)[:, : SIDE // 2]
    even = np.concatenate([half, half[:, ::-1]], axis=1)
    assert find_faults(even[:, ::-1].astype(np.float32), noisy(even)) == ()
    (fault,) = find_faults(even[::-1].astype(np.float32), noisy(even))
    assert fault.words == "upside down"


def test_another_picture_is_not_the_truth_mirrored():
    rng = np.random.default_rng(3)
    for _ in range(5):
        blocks = np.kron(rng.random((8, 8, 3)), np.ones((8, 8, 1)))
        assert find_faults(blocks.astype(np.float32), noisy(picture(SIDE))) == ()
