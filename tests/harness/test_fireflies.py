"""A reference whose noise few samples carry is said to be one."""

import numpy as np

from lightmeter.comparison import few_carry


def test_fireflies_are_noted_and_ordinary_noise_is_not():
    rng = np.random.default_rng(3)
    batches = rng.normal(1.0, 0.2, (8, 24, 24, 3))
    frame = np.full((24, 24, 3), 1.1)
    assert few_carry(frame, list(batches)) == ()
    batches[2, 5, 7] = 400.0
    (note,) = few_carry(frame, list(batches))
    assert "fireflies" in note


def test_a_truth_without_noise_has_no_note():
    image = np.ones((4, 4, 3))
    assert few_carry(image * 0.5, [image] * 8) == ()


def test_a_frame_that_is_not_a_number_has_no_note():
    image = np.ones((4, 4, 3))
    assert few_carry(image * np.nan, [image] * 8) == ()
