"""Pareto front and crossover, on cases that can be checked by hand."""

import math

import pytest

from lightmeter.reports.crossover import Crossover, crossover
from lightmeter.reports.pareto import pareto_front

NAN = math.nan


@pytest.mark.parametrize(
    ("points", "front"),
    [
        ([], []),
        ([(1, 1)], [True]),
        # The third is beaten by the second in both, the fourth in time alone.
        ([(1, 3), (2, 2), (3, 2.5), (2.5, 2)], [True, True, False, False]),
        # Equal points are on the front together, or off it together.
        ([(1, 3), (2, 2), (2, 2)], [True, True, True]),
        ([(1, 1), (2, 2), (2, 2)], [True, False, False]),
        # As fast and worse, or as good and slower, is beaten.
        ([(1, 1), (1, 2), (2, 1)], [True, False, False]),
        # What is not finite beats nothing and is never on the front.
        ([(1, NAN), (2, 5), (NAN, 0), (0.5, math.inf)], [False, True, False, False]),
        # An error may come out at 0 or below.
        ([(1, 0.0), (2, -0.1), (3, 0.0)], [True, True, False]),
    ],
)
def test_the_front_is_what_nothing_beats(points, front):
    assert pareto_front(points) == front


@pytest.mark.parametrize(
    ("times", "spread", "front"),
    [
        # In all of these the errors rise from the first to the last.
        ((10.0, 9.0), 0.0, [True, True]),
        ((10.0, 9.0), 0.5, [True, True]),  # 1 ms is more than √2 · 0.5 = 0.71
        ((10.0, 9.0), 1.0, [True, False]),  # and less than √2
        ((9.0, 10.0), 1.0, [True, False]),  # worse and no faster
        # The second is not told from the first, nor the third from the second; but the third from the first.
        ((10.0, 9.0, 8.0), 1.0, [True, False, True]),
    ],
)
def test_what_noise_makes_look_fast_is_not_on_the_front(times, spread, front):
    points = [(time, error) for error, time in enumerate(times, 1)]
    assert pareto_front(points, [spread] * len(points)) == front
    assert pareto_front(points[::-1], [spread] * len(points)) == front[::-1]


def test_equally_good_points_are_both_on_the_front_until_their_times_are_told_apart():
    assert pareto_front([(10.0, 1.0), (9.0, 1.0)], [1.0, 1.0]) == [True, True]
    assert pareto_front([(10.0, 1.0), (9.0, 1.0)], [0.5, 0.5]) == [False, True]


CURVE = [(10.0, 0.4), (20.0, 0.2), (80.0, 0.1), (320.0, 0.05)]
"""By hand: from the second point on the error halves as the time becomes four times as long, as 1/√n does."""


@pytest.mark.parametrize(
    ("error", "ms", "relation"),
    [
        (0.2, 20.0, "="),  # at a point
        (0.2 / math.sqrt(2), 40.0, "="),  # halfway in log-log, on both axes
        (0.075, 80.0 * (0.1 / 0.075) ** 2, "="),  # on e = 0.1·√(80/t)
        (0.4, 10.0, "<="),
        (0.9, 10.0, "<="),
        (0.05, 320.0, "="),  # the end belongs to the curve
        (0.049, 320.0, ">"),
        (0.0, 320.0, ">"),
        (-0.01, 320.0, ">"),  # an unbiased estimate near 0
    ],
)
def test_a_crossover_is_read_off_the_curve(error, ms, relation):
    found = crossover(CURVE, error)
    assert found is not None and found.relation == relation
    assert found.ms == pytest.approx(ms, rel=1e-12)


def test_a_lucky_image_does_not_count():
    """The curve dips below 0.15 at 20 ms and rises again: it is there to stay between 40 and 80 ms."""
    curve = [(10.0, 0.4), (20.0, 0.14), (40.0, 0.2), (80.0, 0.1)]
    found = crossover(curve, 0.15)
    assert found is not None and 40 < found.ms < 80 and found.relation == "="


def test_a_point_that_is_not_finite_is_passed_over():
    holed = [CURVE[0], (15.0, NAN), *CURVE[1:], (math.inf, 0.01), (640.0, math.inf)]
    assert crossover(holed, 0.1) == crossover(CURVE, 0.1)


def test_a_curve_of_one_point_is_reached_or_not():
    assert crossover([(5.0, 0.1)], 0.1) == Crossover(5.0, "<=")
    assert crossover([(5.0, 0.1)], 0.09) == Crossover(5.0, ">")


def test_without_a_curve_or_an_error_nothing_is_said():
    assert crossover([], 0.1) is None
    assert crossover([(1.0, NAN)], 0.1) is None
    assert crossover(CURVE, NAN) is None


def test_an_error_of_zero_is_reached_where_it_was_measured():
    """Its logarithm does not exist, so that nothing can be interpolated towards it."""
    assert crossover([(1.0, 0.1), (2.0, 0.0)], 0.05) == Crossover(2.0, "=")


def test_beyond_the_curve_nothing_is_claimed():
    assert Crossover(320.0, ">").sentence("320") == "the path tracer is not as good within 320 ms"
