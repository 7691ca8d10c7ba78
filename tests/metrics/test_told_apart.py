"""Errors against the same batches are told apart by their difference."""

import numpy as np
import pytest
from scipy.stats import binom

from lightmeter.metrics import Comparison, measure
from lightmeter.metrics.told_apart import SquaredError, told_apart

TRUTH = np.random.default_rng(0).random((16, 16, 3))
RUNS = 300


def errors(seed: int, *added: np.ndarray | float) -> list[SquaredError]:
    """Of the truth with something added, against eight batches with normal noise."""
    noise = np.random.default_rng((1, seed)).normal(size=(8, *TRUTH.shape))
    return [SquaredError.of(Comparison(TRUTH + one, TRUTH + noise)) for one in added]


def test_what_overlaps_is_told_apart_where_the_noise_is_shared():
    """By hand: over n = 768 values the noise of the batches' mean is 1/√(8n) = 0.013. It moves an MSE of 0.3² by
    2 · 0.3 · 0.013 = 0.008 and more, and the difference to 0.31², 0.0061, by 2 · 0.01 · 0.013 = 0.0003."""
    batches = TRUTH + np.random.default_rng(2).normal(size=(8, *TRUTH.shape))
    near, far = (measure("mse", TRUTH + offset, batches) for offset in (0.30, 0.31))
    assert near.high is not None and far.low is not None and near.high > far.value > near.value > far.low
    assert all(told_apart(*errors(seed, 0.30, 0.31)) for seed in range(20))


def test_equal_errors_are_seldom_told_apart():
    """Errors of either sign are equally large; at 95 % one in 20 is taken for larger, and no more (binomial, 0.1 %)."""
    error = np.random.default_rng(3).normal(size=TRUTH.shape)
    wrong = sum(told_apart(*errors(seed, error, -error)) for seed in range(RUNS))
    assert 0 < wrong <= binom.ppf(0.999, RUNS, 0.05)


def test_one_error_is_not_told_from_itself():
    (one,) = errors(0, 0.3)
    assert not told_apart(one, one)


@pytest.mark.parametrize("batches", [1, 8])
def test_without_noise_every_difference_counts(batches):
    truth = np.repeat(TRUTH[None], batches, axis=0)
    near, same, far = (SquaredError.of(Comparison(TRUTH + x, truth)) for x in (0.3, 0.3, 0.3001))
    assert told_apart(near, far) and not told_apart(near, same)


def test_what_is_not_finite_is_as_good_as_nothing():
    broken = TRUTH.copy()
    broken[0, 0, 0] = np.nan
    failed = SquaredError.of(Comparison(broken, TRUTH[None]))
    (whole,) = errors(0, 0.3)
    assert told_apart(failed, whole) and told_apart(whole, failed) and told_apart(failed, failed)
