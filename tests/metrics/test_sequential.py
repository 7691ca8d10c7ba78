"""Sequential verdicts: what they cost in errors, what they decide, and when they refuse."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.stats import binom

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.mse import mse
from lightmeter.metrics.sequential import (
    LEAST_COUNT,
    MOST_GROUPS,
    Bound,
    Groups,
    effective_count,
    error_per_look,
    group_size,
    linear_contributions,
    look,
    median_interval,
    plan_looks,
    squared_contributions,
)

SIDE = 12
GATES = 120
CONFIDENCE = 0.95


def test_looks_grow_geometrically_and_come_at_whole_groups():
    assert plan_looks(8) == (8,)
    assert plan_looks(64) == (8, 12, 18, 27, 41, 64)
    for most in (8, 9, 63, 65, 100, 256, 300, 1024, 5000):
        looks = plan_looks(most)
        assert looks[0] == (8 if most > 9 else most) and most - group_size(most) < looks[-1] <= most
        assert all(a < b <= 2.3 * a for a, b in pairwise(looks))
        assert all(k % group_size(k) == 0 and k // group_size(k) <= MOST_GROUPS for k in looks)
    with pytest.raises(ValueError, match="8 batches"):
        plan_looks(7)


def test_groups_keep_the_mean_and_a_bounded_number_of_images():
    groups, worth, total = Groups(), 0, 0.0
    for number in range(150):
        groups.make_room()
        groups.add(np.full((1, 1, 3), number, np.float32))
        worth, total = worth + groups.size, total + groups.size * number
        assert len(groups.images) <= MOST_GROUPS and groups.batches == worth
    assert groups.size == group_size(groups.batches) == 8
    assert groups.drawn == 150
    assert np.mean(groups.images) == pytest.approx(total / worth)


def test_a_count_of_contributions():
    rng = np.random.default_rng(1)
    assert effective_count(np.tile([1.0, -1.0], 50)) == 100
    assert effective_count(rng.normal(size=200_000)) == pytest.approx(200_000 / 3, rel=0.05)
    assert effective_count(np.append(rng.normal(size=1000), 1e200)) == pytest.approx(1)
    assert effective_count(np.zeros(5)) == math.inf


def test_contributions_add_up_to_the_jackknife_s_deviations():
    """Summed over the pixels, a batch's contribution is what leaving it out changes, but for a factor and the mean."""
    rng = np.random.default_rng(2)
    d = rng.normal(size=(9, 20, 3))
    gram = np.einsum("inc,jnc->ij", d, d)
    off = gram.sum(axis=1) - np.diag(gram)
    assert squared_contributions(list(d)).sum(axis=1) == pytest.approx(off - off.mean())
    assert linear_contributions(list(d)).sum(axis=1) == pytest.approx(d.sum(axis=(1, 2)) - d.sum() / 9)


def gaussian(rng: np.random.Generator, count: int) -> np.ndarray:
    """Batches of mean 1 and noise 1."""
    return 1 + rng.normal(size=(count, SIDE, SIDE, 3))


def fireflies(rng: np.random.Generator, count: int) -> np.ndarray:
    """Batches of mean 1: a tenth of it comes from one pixel in 80, eight times as bright.

    Eight batches have 144 · 8 / 80 = 14 of them: none once in a million times, since unseen ones cannot be detected.
    """
    lit = rng.random((count, SIDE, SIDE, 1)) < 1 / 80
    return 0.9 + 0.1 * rng.normal(size=(count, SIDE, SIDE, 3)) + 8.0 * lit


def a_lamp(rng: np.random.Generator, count: int) -> np.ndarray:
    """Batches of mean 1 with little noise, but for three pixels of the first eight that outshine everything."""
    batches = 1 + 0.01 * rng.normal(size=(count, SIDE, SIDE, 3))
    batches[[1, 4, 6], [3, 5, 7], [2, 2, 9]] += 50.0
    return batches


def gates(draw, away: float, tally: int = GATES, alpha: float | None = None) -> dict[str, int]:
    """Many gates on the MSE of an image that is wrong by 1, whose MSE lies `away` from the limit."""
    looks = plan_looks(41)
    alpha = alpha or error_per_look(CONFIDENCE, 1, len(looks))
    tested = np.full((SIDE, SIDE, 3), 2.0)
    bound = Bound(1 / (1 + away), 1 / (1 + away))
    ends = {"within": 0, "beyond": 0, "open": 0, "heavy": 0}
    for seed in range(tally):
        batches, found = draw(np.random.default_rng(seed), looks[-1]), None
        for k in looks:
            part = list(batches[:k])

            def count(part=part) -> float:
                return effective_count(squared_contributions([(tested - r).reshape(-1, 3) for r in part]))

            found = look(bound, alpha, lambda c, p=part: mse(Comparison(tested, p, confidence=c)), count)
            if found.side != "open":
                break
        assert found is not None
        ends[found.side] += 1
        ends["heavy"] += found.heavy
    return ends


def at_most(probability: float, tally: int = GATES) -> int:
    """How many of `tally` such events happen at most, but for once in a million runs."""
    return int(binom.ppf(1 - 1e-6, tally, probability))


def test_a_limit_that_holds_exactly_is_failed_no_more_often_than_allowed():
    """At the limit itself the chance of a wrong FAIL is largest. Without dividing the error it is too large."""
    assert gates(gaussian, 0.0)["beyond"] <= at_most(1 - CONFIDENCE)
    assert gates(gaussian, 0.0, alpha=1 - CONFIDENCE)["beyond"] > GATES * (1 - CONFIDENCE)


@pytest.mark.parametrize(("away", "right"), [(-0.2, "within"), (0.2, "beyond")])
def test_a_clear_case_is_decided(away, right):
    """The estimate's relative deviation at 41 batches is 2/√(41 · 432) = 1.5 %: 20 % are 13 deviations."""
    assert gates(gaussian, away, 40) == {"within": 0, "beyond": 0, "open": 0, "heavy": 0} | {right: 40}


@pytest.mark.parametrize("away", [0.0, 0.001])
def test_fireflies_give_no_more_wrong_verdicts_than_allowed(away):
    """At the limit from either side: `away` of 0 holds, and 0.001 does not."""
    wrong = "beyond" if away == 0 else "within"
    assert gates(fireflies, away)[wrong] <= at_most(1 - CONFIDENCE)


def test_a_few_samples_that_outshine_the_rest_leave_it_undecided():
    """The spread is three samples': 1.0 against a limit of 5 would be clear by the interval alone."""
    found = gates(a_lamp, -0.8, 5)
    assert (found["open"], found["heavy"]) == (5, 5)


def test_an_interval_that_few_samples_carry_decides_nothing():
    clear = Measurement(0.5, 0.4, 0.6)
    assert look(Bound(1, 1), 0.01, lambda c: clear, lambda: LEAST_COUNT).side == "within"
    refused = look(Bound(1, 1), 0.01, lambda c: clear, lambda: LEAST_COUNT - 1)
    assert (refused.side, refused.heavy) == ("open", True)
    assert not look(Bound(0.5, 0.5), 0.01, lambda c: clear, lambda: 1.0).heavy
    assert look(Bound(1, 1), 0.01, lambda c: Measurement(0.5), lambda: math.inf).side == "open"


def test_one_end_may_miss_and_both_where_the_magnitude_counts():
    asked = []

    def measure(confidence: float) -> Measurement:
        asked.append(confidence)
        return Measurement(0.0, 0.0, 0.0)

    look(Bound(1, 1), 0.01, measure, lambda: math.inf)
    look(Bound(1, 1, magnitude=True), 0.01, measure, lambda: math.inf)
    assert asked == pytest.approx([0.98, 0.99])


@pytest.mark.parametrize(
    ("bound", "low", "high", "side"),
    [
        (Bound(1, 1), 0.8, 1.0, "within"),
        (Bound(1, 1), 0.8, 1.1, "open"),
        (Bound(1, 1), 1.01, 1.1, "beyond"),
        (Bound(1, 2), 1.5, 1.6, "open"),
        (Bound(1, 2), 2.1, 2.2, "beyond"),
        (Bound(1, 1, is_max=False), 1.0, 2.0, "within"),
        (Bound(1, 1, is_max=False), 0.8, 0.9, "beyond"),
        (Bound(1, 1, is_max=False), 0.8, 1.2, "open"),
        (Bound(1, 1, magnitude=True), -0.9, 0.5, "within"),
        (Bound(1, 1, magnitude=True), -3.0, -2.0, "beyond"),
        (Bound(1, 1, magnitude=True), -3.0, 0.5, "open"),
        (Bound(1, 1), math.nan, 0.5, "open"),
    ],
)
def test_sides(bound, low, high, side):
    assert bound.side(low, high) == side


def test_the_median_s_interval_is_the_sign_test_s():
    """Of 10 values the second to the ninth: P(X ≤ 1) = 11/1024 = 1.07 % at either end (Conover, table A3)."""
    found = median_interval(np.arange(10.0, 0, -1), 1 - 2 * 11.1 / 1024)
    assert (found.value, found.low, found.high) == (5.5, 2, 9)
    tighter = median_interval(np.arange(10.0), 1 - 2 * 10.9 / 1024)
    assert (tighter.low, tighter.high) == (0, 9)
    assert median_interval(np.arange(10.0), 1 - 2 * 0.9 / 1024).low is None


def test_the_median_s_interval_holds_its_level_whatever_the_distribution():
    rng = np.random.default_rng(3)
    runs, missed = 2000, 0
    for _ in range(runs):
        found = median_interval(rng.pareto(0.7, size=24), 0.9)
        median = 2 ** (1 / 0.7) - 1
        missed += not found.low <= median <= found.high
    assert missed <= binom.ppf(1 - 1e-6, runs, 0.1)
