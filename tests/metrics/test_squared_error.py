"""The MSE family, bias and PSNR: closed forms, unbiasedness, and coverage of the intervals by simulation."""

import math

import numpy as np
import pytest
from scipy.stats import binom
from scipy.stats import t as student_t

from lightmeter.metrics import METRICS, Comparison, InputError, interval, measure
from lightmeter.metrics.moments import Moments

RNG = np.random.default_rng


def noisy(truth, batches, seed, noise=1.0):
    return (truth + noise * RNG(seed).normal(size=(batches, *truth.shape))).astype(np.float32)


def test_formula_written_out():
    # Section 4 of the design, literally, on values where nothing is symmetric.
    rng = RNG(0)
    tested, batches = rng.random((5, 6, 3)), rng.random((7, 5, 6, 3))
    d = tested - batches
    literal = ((d.sum(axis=0)) ** 2 - (d**2).sum(axis=0)).mean() / (7 * 6)
    power = ((batches.sum(axis=0)) ** 2 - (batches**2).sum(axis=0)).mean() / (7 * 6)
    # float64 throughout; a few hundred roundings of terms of order 1.
    assert measure("mse", tested, batches).value == pytest.approx(literal, abs=1e-13)
    assert measure("relmse", tested, batches).value == pytest.approx(literal / power, rel=1e-11)
    root = math.sqrt(max(0, literal))
    assert measure("rmse", tested, batches).value == pytest.approx(root, rel=1e-9)
    assert measure("nrmse", tested, batches).value == pytest.approx(root / batches.mean(), rel=1e-9)
    assert measure("bias", tested, batches).value == pytest.approx(d.mean(), abs=1e-14)
    assert measure("relative_bias", tested, batches).value == pytest.approx(d.mean() / batches.mean(), rel=1e-10)
    assert measure("psnr", tested, batches, peak=2.0).value == pytest.approx(10 * math.log10(4 / literal), rel=1e-9)


def test_jackknife_written_out():
    # Leaving a batch out by hand gives the same replicates as the Gram matrix does.
    from lightmeter.metrics.interval import u_statistic

    rng = RNG(1)
    tested, batches = rng.random((4, 4, 3)), rng.random((5, 4, 4, 3))
    _, left_out = u_statistic(Comparison(tested, batches).moments.gram)
    for k in range(5):
        by_hand = measure("mse", tested, np.delete(batches, k, axis=0)).value
        assert left_out[k] == pytest.approx(by_hand, abs=1e-13)


def test_reference_noise_does_not_bias():
    truth = RNG(2).random((32, 32, 3))
    batches = noisy(truth, 8, seed=3)
    # The naive RMSE of a perfect image is the noise of the mean, 1/√8 = 0.354.
    naive = math.sqrt(np.mean((truth - batches.mean(axis=0)) ** 2))
    assert naive == pytest.approx(1 / math.sqrt(8), rel=0.05)
    found = measure("rmse", truth, batches)
    assert found.low == 0
    assert found.value < 0.1
    assert found.high < 0.2 < naive


def test_u_statistic_is_unbiased():
    # Mean of 400 trials of a perfect image and of one with an error of 0.05 (MSE 0.0025). One trial has a standard
    # deviation of √(2/(K(K−1)n)) = 0.0273 at n = 48, K = 8 (and 4·0.0025/(8·48) more); 4 standard errors of the mean.
    truth = RNG(4).random((4, 4, 3))
    for error in (0.0, 0.05):
        values = [measure("mse", truth + error, noisy(truth, 8, seed)).value for seed in range(400)]
        deviation = math.sqrt(2 / (8 * 7 * 48) + 4 * error**2 / (8 * 48))
        assert np.mean(values) == pytest.approx(error**2, abs=4 * deviation / 20)
        assert np.std(values) == pytest.approx(deviation, rel=0.2)
        assert min(values) < 0  # reported as it is


TRIALS = 600


def coverage(name, tested, expected, make, trials=TRIALS):
    hits = 0
    for seed in range(trials):
        found = measure(name, tested, make(seed))
        hits += found.low <= expected <= found.high
    return hits


def fewest(trials, level=0.95, doubt=1e-4):
    """The fewest hits that a true coverage of `level` gives, except with probability `doubt`."""
    return binom.ppf(doubt, trials, level)


TRUTH = RNG(7).random((4, 4, 3)) + 0.5


def independent(k):
    return lambda seed: noisy(TRUTH, k, seed)


def one_direction(k):
    # A gain that fluctuates from batch to batch: all of the noise in one eigenvector, the worst for a degenerate
    # U-statistic. In units of the image's norm.
    return lambda seed: (TRUTH * (1 + 0.5 * RNG(seed).normal(size=(k, 1, 1, 1)))).astype(np.float32)


def skewed(k):
    return lambda seed: (TRUTH * RNG(seed).exponential(size=(k, *TRUTH.shape))).astype(np.float32)


# Errors as multiples of the truth: none, below the noise of the mean, around it, above one batch's noise.
@pytest.mark.parametrize("scale", [0, 0.05, 0.2, 2])
@pytest.mark.parametrize(("make", "k"), [(independent, 8), (one_direction, 8), (one_direction, 32), (skewed, 8)])
def test_interval_of_rmse_covers(make, k, scale):
    expected = scale * math.sqrt(np.mean(TRUTH**2))
    hits = coverage("rmse", TRUTH * (1 + scale), expected, make(k))
    assert hits >= fewest(TRIALS)


def test_interval_is_not_wider_than_it_must_where_the_error_is_large():
    # Section 4: 93 to 97 % where the error is not below one batch's noise (RMSE 2 against a noise of 1). Both ends at
    # a probability of 1e-4.
    trials = 2000
    expected = 2.0
    hits = coverage("rmse", TRUTH + 2, expected, independent(8), trials)
    assert binom.ppf(1e-4, trials, 0.93) <= hits <= binom.ppf(1 - 1e-4, trials, 0.97)


@pytest.mark.parametrize("scale", [0, 0.3])
@pytest.mark.parametrize("name", ["nrmse", "relmse", "mse", "bias", "relative_bias", "psnr"])
def test_other_intervals_cover(name, scale):
    mean, square = TRUTH.mean(), np.mean(TRUTH**2)
    expected = {
        "nrmse": scale * math.sqrt(square) / mean,
        "relmse": scale**2,
        "mse": scale**2 * square,
        "bias": scale * mean,
        "relative_bias": scale,
        "psnr": math.inf if scale == 0 else -10 * math.log10(scale**2 * square),
    }[name]
    hits = coverage(name, TRUTH * (1 + scale), expected, independent(8), 400)
    assert hits >= fewest(400)


def test_both_sides_noisy():
    # Closure: neither side's noise may bias. One trial's deviation as above with twice the variance, so twice as large.
    truth = RNG(8).random((4, 4, 3))
    values, bias_hits = [], 0
    for seed in range(300):
        tested, reference = noisy(truth, 8, 2 * seed), noisy(truth, 8, 2 * seed + 1)
        values.append(measure("mse", tested, reference).value)
        found = measure("bias", tested, reference)
        bias_hits += found.low <= 0 <= found.high
    assert np.mean(values) == pytest.approx(0, abs=4 * 2 * math.sqrt(2 / (8 * 7 * 48)) / math.sqrt(300))
    assert bias_hits >= fewest(300)


def test_one_reference_image_has_values_without_intervals():
    rng = RNG(9)
    a, b = rng.random((2, 6, 5, 3))
    square = np.mean((a - b) ** 2)
    expected = {
        "mse": square,
        "rmse": math.sqrt(square),
        "nrmse": math.sqrt(square) / b.mean(),
        "relmse": square / np.mean(b**2),
        "bias": np.mean(a - b),
        "relative_bias": np.mean(a - b) / b.mean(),
        "mae": np.mean(np.abs(a - b)),
        "psnr": -10 * math.log10(square),
    }
    for name, value in expected.items():
        for reference in (b, b[None]):
            found = measure(name, a, reference)
            assert found.value == pytest.approx(value, rel=1e-12), name
            assert (found.low, found.high, found.floor, found.corrected) == (None, None, None, None), name


@pytest.mark.parametrize("k", [2, 3])
def test_few_batches_have_no_squared_error_interval(k):
    found = measure("rmse", TRUTH, noisy(TRUTH, k, 0))
    assert (found.low, found.high) == (None, None)
    assert measure("bias", TRUTH, noisy(TRUTH, k, 0)).high is not None


def test_closed_forms():
    image = np.full((8, 8, 3), 0.5)
    reference = np.stack([image] * 8)
    # Equal batches have no noise: the interval is a point. 0.1 off at peak 1 is 20 dB.
    found = measure("psnr", image + 0.1, reference)
    assert found.value == pytest.approx(20, abs=1e-10)
    assert (found.low, found.high) == pytest.approx((20, 20), abs=1e-6)
    assert measure("psnr", image, reference).value == math.inf
    assert measure("nrmse", image * 1.2, reference).value == pytest.approx(0.2)
    assert measure("relmse", image * 1.2, reference).value == pytest.approx(0.04)
    assert measure("relative_bias", image * 0.9, reference).value == pytest.approx(-0.1)
    assert measure("mae", image * 0.9, reference).value == pytest.approx(0.05)


def test_mask_is_the_crop():
    rng = RNG(10)
    tested, batches = rng.random((9, 8, 3)), rng.random((6, 9, 8, 3))
    mask = np.zeros((9, 8), bool)
    mask[2:7, 1:5] = True
    outside = tested.copy()
    outside[~mask] = np.nan
    for name in ("mse", "rmse", "nrmse", "relmse", "bias", "relative_bias", "psnr", "mae", "rms_p99", "delta_e_itp"):
        masked = measure(name, outside, batches, mask)
        cropped = measure(name, tested[2:7, 1:5], batches[:, 2:7, 1:5])
        for field in ("value", "low", "high", "corrected", "floor"):
            one, other = getattr(masked, field), getattr(cropped, field)
            assert (one is None and other is None) or one == pytest.approx(other, rel=1e-9), (name, field)


def test_negative_radiance_counts_as_it_is():
    image = np.full((4, 4, 3), 1.0)
    assert measure("rmse", -image, image).value == 2
    assert measure("bias", -image, image).value == -2


def test_strips_do_not_change_the_sums(monkeypatch):
    rng = RNG(11)
    tested, batches = rng.random((13, 5, 3)), list(rng.random((4, 13, 5, 3)))
    mask = rng.random((13, 5)) < 0.6
    whole = Moments.of([tested], batches, mask)
    monkeypatch.setattr("lightmeter.metrics.moments._STRIP_VALUES", 4 * 5 * 3 * 4)
    parts = Moments.of([tested], batches, mask)
    for field in ("gram", "reference_gram", "difference_means", "reference_means"):
        np.testing.assert_allclose(getattr(parts, field), getattr(whole, field), rtol=1e-13)


def test_float32_batches_are_summed_in_float64():
    # 1 + 2⁻²² against 1: a float32 sum of squares would lose it.
    tested = np.full((64, 64, 3), np.float32(1 + 2**-22))
    reference = np.ones((8, 64, 64, 3), np.float32)
    assert measure("rmse", tested, reference).value == pytest.approx(2**-22, rel=1e-9)


def test_black_reference_has_no_relative_error():
    black = np.zeros((8, 4, 4, 3))
    for name in ("nrmse", "relmse", "relative_bias"):
        found = measure(name, black[0] + 1, black)
        assert math.isnan(found.value)
        assert "black" in found.how
    assert measure("rmse", black[0] + 1, black).value == 1


@pytest.mark.parametrize("peak", [0, -1, math.nan, math.inf])
def test_peak_is_checked(peak):
    with pytest.raises(InputError, match="PSNR needs a peak"):
        measure("psnr", TRUTH, TRUTH, peak=peak)


def symmetric(truth, pairs, noise=1.0):
    """Batches without skewness: truth ± noise, each a gain of the whole image, so that a metric cannot see any."""
    gains = noise * np.linspace(0.2, 1, pairs)
    return truth * (1 + np.concatenate([gains, -gains])[:, None, None, None])


def test_interval_of_the_bias_is_students():
    # The jackknife of a mean is the classical interval where nothing is skewed: mean ± t s/√K.
    batches = symmetric(TRUTH, 3)
    means = (TRUTH - batches).mean(axis=(1, 2, 3))
    half = student_t.ppf(0.975, 5) * means.std(ddof=1) / math.sqrt(6)
    found = measure("bias", TRUTH, batches)
    assert (found.low, found.high) == pytest.approx((-half, half), rel=1e-9)


def test_interval_of_skewed_batches_is_longer_at_the_tail():
    # Gains 0, 0, 0, 4: mean 1, deviations −1, −1, −1, 3; s² = 12/3; G1 = √12/2 · (24/4)/(12/4)^1.5 = 2.
    batches = np.ones((4, 2, 2, 3)) * np.array([0, 0, 0, 4])[:, None, None, None]
    t = student_t.ppf(0.975, 3)
    found = measure("bias", np.zeros((2, 2, 3)), batches)  # the tail of tested − reference is at the lower end
    assert found.high == pytest.approx(-1 + t, rel=1e-9)
    assert found.low == pytest.approx(-1 - t - 2 * (2 * t**2 + 1) / (6 * 2), rel=1e-9)


def test_skewed_batches_are_covered_better():
    # Exponential batch means, K = 16: Student's interval covers about 92 % (hits of the same trials), ours more.
    trials, k, t = 2000, 16, student_t.ppf(0.975, 15)
    means = RNG(20).exponential(size=(trials, k))
    plain = np.abs(means.mean(axis=1) - 1) <= t * means.std(axis=1, ddof=1) / math.sqrt(k)
    hits = 0
    for row in means:
        left_out = (row.sum() - row) / (k - 1)
        low, high = interval.mean_interval(row.mean(), left_out, 0.95)
        hits += low <= 1 <= high
    assert plain.sum() < fewest(trials)
    assert hits >= binom.ppf(1e-4, trials, 0.945)


def test_students_t_is_the_published():
    # NIST/SEMATECH e-Handbook, 1.3.6.7.2, three digits.
    for degrees, confidence, published in ((7, 0.95, 2.365), (7, 0.998, 4.785), (30, 0.99, 2.750)):
        assert interval.student_t(degrees + 1, confidence) == pytest.approx(published, abs=5e-4)


@pytest.mark.parametrize("confidence", [0.95, 1 - 1e-5, 1 - 1e-13])
def test_students_t_is_exact_far_out(confidence):
    # One degree of freedom is Cauchy's distribution: its quantile is cot(π · doubt / 2). 1 − confidence is exact.
    exact = 1 / math.tan(math.pi * (1 - confidence) / 2)
    assert interval.student_t(2, confidence) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("confidence", [0.5, 1 - 1e-5])
@pytest.mark.parametrize("name", ["bias", "relative_bias", "mse", "rmse", "nrmse", "relmse"])
def test_confidence_widens_by_students_quantile(name, confidence):
    # For squared errors where the error is far above the noise: there it is value ± t · s but for t²λ/K.
    batches = symmetric(TRUTH, 4, noise=1e-4)
    usual = measure(name, TRUTH * 2, batches)
    found = METRICS[name].function(Comparison(TRUTH * 2, batches, confidence=confidence))
    ratio = student_t.isf((1 - confidence) / 2, 7) / student_t.isf(0.025, 7)
    assert found.high - found.low == pytest.approx(ratio * (usual.high - usual.low), rel=5e-3)


@pytest.mark.parametrize("confidence", [0, 1, -0.5, 95, math.nan])
def test_confidence_is_checked(confidence):
    with pytest.raises(InputError, match=r"confidence.*between 0 and 1"):
        Comparison(TRUTH, TRUTH, confidence=confidence)
