"""Input that tells nothing, or is broken: no fault, no crash, no hang; and what is no input at all."""

import warnings

import numpy as np
import pytest

from lightmeter.metrics import InputError
from lightmeter.metrics.registration import ORDER, Fault, correct, find_faults

from .pictures import noisy, picture

SIDE = 64
RNG = np.random.default_rng


@pytest.fixture(autouse=True)
def _strict():
    """NumPy's warnings are errors: a division by 0 that nobody thought of."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


@pytest.mark.parametrize("size", [(1, 1), (1, 64), (2, 3), (7, 9), (16, 16), (40, 5), (17, 33)])
def test_images_of_any_size(size):
    rng = RNG(0)
    tested, batches = rng.random((*size, 3)), rng.random((8, *size, 3))
    assert find_faults(tested, batches, alpha=rng.random(size), background=rng.random(size) > 0.5) == ()


@pytest.mark.parametrize("value", [0.0, 0.5, 2.0])
@pytest.mark.parametrize("truth", [0.0, 0.5])
def test_single_colours(value, truth):
    tested, batches = np.full((SIDE, SIDE, 3), value), np.full((8, SIDE, SIDE, 3), truth)
    assert find_faults(tested, batches) == ()


def test_a_black_frame_of_a_lit_scene():
    assert find_faults(np.zeros((SIDE, SIDE, 3)), noisy(picture(SIDE))) == ()


def test_pixels_that_are_not_finite_are_left_out():
    tested = 1.5 * picture(SIDE, right=1)
    tested[20:28, 30:45] = np.nan
    tested[::9, ::7] = np.inf
    faults = find_faults(tested.astype(np.float32), noisy(picture(SIDE)))
    assert [fault.name for fault in faults] == ["shift", "exposure"]
    # A tenth of the picture is filled from beside: tolerances twice those of test_geometry and test_light.
    assert faults[0].size == pytest.approx({"right": 1, "down": 0}, abs=0.12)
    assert faults[1].size["factor"] == pytest.approx(1.5, rel=0.02)


def test_a_frame_or_a_truth_without_a_finite_pixel():
    assert find_faults(np.full((SIDE, SIDE, 3), np.nan), noisy(picture(SIDE))) == ()
    assert find_faults(picture(SIDE), np.full((8, SIDE, SIDE, 3), np.nan)) == ()


def test_a_batch_that_is_not_finite_somewhere():
    batches = noisy(picture(SIDE))
    batches[3, 10:20, 10:20] = np.nan
    assert find_faults(picture(SIDE).astype(np.float32), batches) == ()


def test_huge_and_negative_values():
    tested = picture(SIDE).astype(np.float32)
    tested[5:9, 5:9] = np.finfo(np.float32).max
    tested[40, 40] = -7
    assert find_faults(tested, noisy(picture(SIDE))) == ()
    (fault,) = find_faults((1e30 * picture(SIDE)).astype(np.float32), noisy(picture(SIDE)))
    assert fault.size["factor"] == pytest.approx(1e30, rel=0.01)  # as in test_light


def test_a_firefly_in_the_truth():
    batches = noisy(picture(SIDE))
    batches[2, 33, 21] = 1e6
    assert find_faults(picture(SIDE).astype(np.float32), batches) == ()


def test_noise_on_both_sides():
    assert find_faults(noisy(picture(SIDE), seed=5).mean(axis=0), noisy(picture(SIDE))) == ()
    assert find_faults(noisy(picture(SIDE), seed=5)[0], noisy(picture(SIDE))) == ()
    assert find_faults(RNG(1).random((SIDE, SIDE, 3)), noisy(picture(SIDE))) == ()
    assert find_faults(RNG(1).random((SIDE, SIDE, 3)), RNG(2).random((8, SIDE, SIDE, 3))) == ()


def test_one_reference_image_is_enough():
    (fault,) = find_faults(picture(SIDE, right=1).astype(np.float32), picture(SIDE))
    assert fault.name == "shift"


def test_what_was_handed_in_is_not_changed():
    tested, batches = 1.5 * picture(SIDE, right=1)[:, ::-1], noisy(picture(SIDE))
    before = tested.copy(), batches.copy()
    faults = find_faults(tested, batches)
    correct(tested, faults)
    assert np.array_equal(tested, before[0]) and np.array_equal(batches, before[1])


def test_shapes_that_do_not_fit():
    with pytest.raises(InputError, match="differ in size"):
        find_faults(np.ones((8, 9, 3)), np.ones((8, 8, 8, 3)))
    with pytest.raises(InputError, match="alpha does not fit"):
        find_faults(np.ones((8, 8, 3)), np.ones((8, 8, 8, 3)), alpha=np.ones((4, 4)))
    with pytest.raises(InputError, match="background does not fit"):
        find_faults(np.ones((8, 8, 3)), np.ones((8, 8, 8, 3)), background=np.ones((8, 8, 1), bool))


def test_what_cannot_be_corrected():
    image = np.ones((8, 8, 3), np.float32)
    with pytest.raises(InputError, match="background cannot be corrected"):
        correct(image, [Fault("background", "", {"pixels": 3.0})])
    with pytest.raises(InputError, match="divided by alpha"):
        correct(image, [Fault("alpha", "", {"pixels": 3.0, "lost": 0.0})])
    with pytest.raises(InputError, match="no fault 'rotation'"):
        correct(image, [Fault("rotation", "", {})])
    assert np.array_equal(correct(image, []), image)


def test_every_fault_but_the_background_has_its_place_in_the_order():
    assert ORDER == ("transfer", "exposure", "alpha", "flip", "shift", "field_of_view")
