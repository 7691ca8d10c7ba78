"""What is recovered of a light and what leaks, on images whose answer is known."""

import math

import numpy as np
import pytest

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.recovery import recovery


def light(noise=0.0, batches=8, seed=0) -> list[np.ndarray]:
    """Batches of an image of two halves, 2 and 0, with noise of this standard deviation."""
    image = np.zeros((32, 32, 3))
    image[:, :16] = 2.0
    rng = np.random.default_rng(seed)
    return [image + noise * rng.normal(size=image.shape) for _ in range(batches)]


def test_the_light_itself_is_recovered_whole():
    found = recovery(Comparison([light()[0]], light()))
    assert (found.share.value, found.energy.value) == (1, 1)
    assert (found.leaked.value, found.missing.value, found.rmse.value) == (0, 0, 0)


def test_half_of_it_everywhere_lacks_one_half_where_it_is_and_leaks_where_it_is_not():
    """1 everywhere: Σ t·R = ½ Σ R², as much in all, half of it too dark and half of it leaked."""
    found = recovery(Comparison([np.ones((32, 32, 3))], light()))
    assert found.share.value == pytest.approx(0.5)
    assert found.energy.value == pytest.approx(1.0)
    assert found.leaked.value == pytest.approx(0.5)
    assert found.missing.value == pytest.approx(0.5)


def test_noise_does_not_bias_the_share():
    """Σ R² of a noisy mean is larger by the noise; over 3072 values of a U-statistic nothing of it is left.

    σ = 2 in 8 batches: of a plain mean the share would be 2/(2 + 4/8) = 0.8. Its own standard error: 2σ·√(Σ t²)/√8 over
    Σ R² = 6144 for the denominator is 2·2·√6144/√8/6144 = 1.8 %.
    """
    found = recovery(Comparison([light()[0]], light(noise=2.0)))
    assert found.share.value == pytest.approx(1.0, abs=3 * 0.018)
    assert found.share.low < found.share.value < found.share.high


def test_no_light_is_undefined():
    found = recovery(Comparison([np.ones((8, 8, 3))], [np.zeros((8, 8, 3))] * 8))
    assert math.isnan(found.share.value) and math.isnan(found.leaked.value)
