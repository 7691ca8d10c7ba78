"""Metrics that noise biases: the ladder's arithmetic on laws of known order, and who shares which map."""

import math

import numpy as np
import pytest

from lightmeter.metrics import Comparison, measure
from lightmeter.metrics.flip import ldr_flip
from lightmeter.metrics.interval import student_t
from lightmeter.metrics.mae import mae
from lightmeter.metrics.noise_bound import Ladder
from lightmeter.metrics.percentile import flip_p95, flip_p99
from lightmeter.metrics.worst_tile import flip_worst_tile

RNG = np.random.default_rng


def ladder(law, floor=0.0, **options):
    """Of a metric that is exactly law(m) at the mean of m batches of 64."""
    return Ladder(law(64), np.full((3, 2), law(32)), np.full(4, law(16)), floor, **options)


@pytest.mark.parametrize("power", [1, 0.5, 0.35])
def test_a_known_order_is_extrapolated_and_bounded(power):
    # Value 0.3 and a bias of m^-power: D₁ r / (1 − r) is the bias itself with the right r, no spread.
    steps = ladder(lambda m: 0.3 + m**-power)
    assert steps.extrapolated() == pytest.approx(0.3, abs=1e-12)
    low, high = steps.bound(0.95)
    assert high == pytest.approx(0.3 + 64**-power)
    slowest = 2**-0.35
    # D₁ = 64^-p (2^p − 1), and the slowest decay that is thought of.
    assert low == pytest.approx(0.3 + 64**-power * (1 - (2**power - 1) * slowest / (1 - slowest)))
    assert low <= 0.3 + 1e-12


def test_a_bias_downwards_is_bounded_above():
    low, high = ladder(lambda m: 0.5 - 1 / m).bound(0.95)
    assert (low, high) == pytest.approx((0.5 - 1 / 64, 0.5 - 1 / 64 + 1 / 64 * 2**-0.35 / (1 - 2**-0.35)))
    similar = ladder(lambda m: 0.8 - 1 / m, floor=0.7, perfect=1.0, larger_is_worse=False)
    assert similar.extrapolated() == pytest.approx(0.8)
    assert similar.bound(0.95)[0] == pytest.approx(0.8 - 1 / 64)


def test_saturation_reaches_to_the_perfect_value():
    # The steps grow as the noise falls: D₁ = 0.1, D₂ = 0.05.
    values = {64: 0.5, 32: 0.6, 16: 0.65}
    assert ladder(values.get).bound(0.95) == (0, 0.5)
    assert ladder({m: 1 - v for m, v in values.items()}.get, 0.6, perfect=1.0, larger_is_worse=False).bound(0.95) == (
        pytest.approx(0.5),
        1,
    )


def test_an_error_within_the_floor_reaches_to_the_perfect_value():
    assert ladder(lambda m: 0.3, floor=0.31).bound(0.95) == (0, 0.3)
    assert ladder(lambda m: 0.3, floor=0.29).bound(0.95) == (0.3, 0.3)


def test_spread_is_that_of_half_samples():
    # Halves differ by 0.02 in each split: the mean's deviation is half of that; no bias, no doubt about it.
    steps = Ladder(0.3, np.tile([0.29, 0.31], (3, 1)), np.full(4, 0.3), 0.0)
    for confidence in (0.95, 1 - 1e-5):
        half = student_t(4, confidence) * 0.01
        assert steps.bound(confidence) == pytest.approx((max(0, 0.3 - half), 0.3 + half))
    # Quarters that spread by more than halves explain: their standard error counts.
    quarters = np.array([0.26, 0.34, 0.26, 0.34])
    assert Ladder(0.3, np.full((3, 2), 0.3), quarters, 0.0).bound(0.95)[1] == pytest.approx(
        0.3 + student_t(4, 0.95) * quarters.std(ddof=1) / 2
    )


def test_a_doubtful_step_widens_the_far_end():
    # Splits whose halves are at 0.4, 0.5, 0.6: D₁ = 0.1 with a standard error of 0.1/√3, no spread of the value itself.
    # D₂ is 0, but nothing about the ratio is significant.
    low, high = Ladder(0.4, np.array([[0.4] * 2, [0.5] * 2, [0.6] * 2]), np.full(4, 0.5), 0.0, perfect=-99).bound(0.95)
    left = 2**-0.35 / (1 - 2**-0.35)
    half = student_t(4, 0.95) * left * 0.1 / math.sqrt(3)
    assert (low, high) == pytest.approx((0.4 - left * 0.1 - half, 0.4 - left * 0.1 + half))


def test_quarters_of_unequal_size_weigh_as_they_should():
    batches = RNG(6).random((10, 4, 4, 3))
    comparison = Comparison(batches, batches)
    half = batches[[0, 4, 8, 2, 6]].mean(axis=0)  # k mod 4 is 0 or 2; the first quarter holds three
    half_and_one = batches[[0, 4, 8, 1, 5, 9, 2, 6]].mean(axis=0)
    for part in (comparison.reference_part, comparison.tested_part):
        assert part((0, 2)) == pytest.approx(half, rel=1e-12)
        assert part((0, 1, 2)) == pytest.approx(half_and_one, rel=1e-12)
        assert part((0, 1, 2, 3)) == pytest.approx(batches.mean(axis=0), rel=1e-12)


def test_ladder_is_of_means_of_the_batches():
    # Written out: quarter q holds the batches q, q + 4, …; its map is at their mean.
    batches, tested = RNG(4).random((8, 20, 20, 3)), RNG(5).random((20, 20, 3))

    def at(*quarters):
        chosen = [k for k in range(8) if k % 4 in quarters]
        return ldr_flip(tested, batches[chosen].mean(axis=0)).mean(dtype=float)

    splits = [[at(0, 2), at(1, 3)], [at(0, 1), at(2, 3)], [at(0, 3), at(1, 2)]]
    floor = ldr_flip(batches[::2].mean(axis=0), batches[1::2].mean(axis=0)).mean(dtype=float)
    expected = Ladder(at(0, 1, 2, 3), np.array(splits), np.array([at(q) for q in range(4)]), floor)
    found = measure("flip", tested, batches)
    assert found.value == pytest.approx(expected.full, rel=1e-6)
    assert found.floor == pytest.approx(floor, rel=1e-6)
    assert found.corrected == pytest.approx(expected.extrapolated(), rel=1e-5)
    assert (found.low, found.high) == pytest.approx(expected.bound(0.95), rel=1e-5)


@pytest.mark.parametrize("k", [2, 3, 7])
def test_few_batches_have_no_bound_and_say_why(k):
    found = measure("mae", np.zeros((4, 4, 3)), RNG(0).random((k, 4, 4, 3)))
    assert (found.low, found.high, found.corrected) == (None, None, None)
    assert found.floor > 0
    assert "no bound under 8 batches" in found.how


def test_both_sides_noisy():
    # Equal expectations; the tested side is the noisier by far, so its halves make the floor.
    truth = RNG(1).random((16, 16, 3))
    tested = truth + RNG(2).normal(size=(8, 16, 16, 3))
    reference = truth + 0.01 * RNG(3).normal(size=(8, 16, 16, 3))
    found = measure("mae", tested, reference)
    # E|N(0, 1/8)| for the value, twice that between halves; 6 % is 4 standard errors of 768 values.
    assert found.value == pytest.approx(math.sqrt(2 / math.pi / 8), rel=0.1)
    assert found.floor == pytest.approx(2 * math.sqrt(2 / math.pi / 8), rel=0.1)
    assert found.low == 0


def test_metrics_of_one_map_share_it(monkeypatch):
    calls = []

    def counted(*images):
        calls.append(1)
        return ldr_flip(*images)

    monkeypatch.setattr("lightmeter.metrics.flip.ldr_flip", counted)
    comparison = Comparison(RNG(0).random((20, 20, 3)), RNG(1).random((8, 20, 20, 3)))
    for metric in (flip_p95, flip_p99, flip_worst_tile):
        metric(comparison)
    assert len(calls) == 12  # the mean, six halves, four quarters, the floor
    flip_p95(comparison, display=np.sqrt)
    assert len(calls) == 24


def test_confidence_widens_the_bound():
    tested, batches = RNG(0).random((20, 20, 3)), RNG(1).random((16, 20, 20, 3))
    usual, sure = (mae(Comparison(tested, batches, confidence=c)) for c in (0.95, 0.999))
    assert sure.low < usual.low < usual.value < usual.high < sure.high
