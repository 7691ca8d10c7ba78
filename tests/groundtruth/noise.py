"""Tests of noisy numbers, each with the chance that it fails although all is well."""

import numpy as np
from scipy import stats

FALSE_ALARM = 1e-4
"""How often a test may fail by chance, all its comparisons together."""


def assert_mean(batches: np.ndarray, expected, *, slack=0.0, half_width=None) -> None:
    """Holds means of batches against expected values, by Student's t with Šidák's correction.

    Args:
        batches: (K, …); the first axis holds independent batches.
        expected: broadcasts with the rest.
        slack: what the expected values may be off by, absolute.
        half_width: the largest half-width of a 95 % interval, so that a noisy test cannot pass.
    """
    batches = np.asarray(batches, float)
    count = len(batches)
    mean = batches.mean(axis=0)
    error = batches.std(axis=0, ddof=1) / np.sqrt(count)
    tests = max(1, mean.size)
    quantile = stats.t.ppf(1 - sidak(tests) / 2, count - 1)
    # Float32 results that do not vary still carry rounding.
    allowed = quantile * error + slack + 4e-6 * np.abs(mean)
    off = np.abs(mean - expected)
    worst = np.unravel_index(np.argmax(off - allowed), off.shape)
    target = np.broadcast_to(expected, off.shape)[worst]
    assert np.all(off <= allowed), f"at {worst}: {mean[worst]:.6g}, expected {target:.6g} ± {allowed[worst]:.2g}"
    if half_width is not None:
        widest = float(np.max(stats.t.ppf(0.975, count - 1) * error))
        assert widest <= half_width, f"half-width {widest:.2g}, expected at most {half_width:.2g}"


def assert_same_mean(a: np.ndarray, b: np.ndarray) -> None:
    """Holds two sets of batches (K, …) against each other, by Welch's t with Šidák's correction."""
    a, b = (np.asarray(x, float).reshape(len(x), -1) for x in (a, b))
    varies = (a.std(axis=0) > 0) | (b.std(axis=0) > 0)
    same = np.isclose(a.mean(axis=0), b.mean(axis=0), rtol=1e-5, atol=1e-7)
    assert np.all(varies | same)
    p = stats.ttest_ind(a[:, varies], b[:, varies], equal_var=False).pvalue
    assert p.min() > sidak(p.size), f"p = {p.min():.2g} among {p.size} tests"


def sidak(tests: int) -> float:
    """The level of one of `tests` tests, for `FALSE_ALARM` together."""
    return -np.expm1(np.log1p(-FALSE_ALARM) / tests)


def blocks(images: np.ndarray, size: int) -> np.ndarray:
    """(K, H, W, C) → means over size × size pixels, (K, H/size, W/size, C)."""
    k, h, w, c = images.shape
    return images.reshape(k, h // size, size, w // size, size, c).mean(axis=(2, 4))
