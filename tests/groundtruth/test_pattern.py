"""The numbers that wavefronts hand out: uniform, and independent from place to place."""

import numpy as np
import pytest

from lightmeter.groundtruth.wavefront import average

SIDE, SEEDS = 64, 20


@pytest.fixture(scope="module")
def numbers() -> np.ndarray:
    """(seeds, dimensions, H, W): the first sample of each place."""

    def estimate(lanes):
        return [lanes.pattern.next(), lanes.pattern.next(), lanes.pattern.next()]

    found = [average(SIDE * SIDE, 1, (seed, 0), estimate, channels=3, dimensions=3) for seed in range(SEEDS)]
    return np.stack(found).reshape(SEEDS, 3, SIDE, SIDE)


def test_numbers_are_uniform(numbers):
    counts = np.histogram(numbers, bins=64, range=(0.0, 1.0))[0]
    expected = numbers.size / 64
    # χ² of 63 degrees of freedom passes 103.4 in one of a thousand.
    assert ((counts - expected) ** 2 / expected).sum() < 103.4


@pytest.mark.parametrize("step", [(0, 1), (0, 2), (1, 0), (1, 1), (0, 4)])
def test_neighbouring_places_are_independent(numbers, step):
    """Else the pixels of a batch err together, and its mean is noisier than it need be."""
    down, right = step
    x = (numbers - 0.5) * np.sqrt(12)
    products = x[..., : SIDE - down, : SIDE - right] * x[..., down:, right:]
    means = products.mean(axis=(2, 3))
    # A mean over n products of independent numbers has the deviation 1/√n. Of 60 means, one passes 4.3 deviations in
    # a thousand runs (normal, Šidák).
    assert np.abs(means).max() < 4.3 / np.sqrt(products.shape[2] * products.shape[3])


def test_dimensions_are_independent(numbers):
    x = (numbers - 0.5) * np.sqrt(12)
    means = np.stack([(x[:, a] * x[:, b]).mean(axis=(1, 2)) for a, b in ((0, 1), (0, 2), (1, 2))])
    assert np.abs(means).max() < 4.3 / SIDE
