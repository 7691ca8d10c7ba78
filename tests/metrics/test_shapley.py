"""Shapley shares against games whose shares are known in closed form."""

import itertools

import numpy as np
import pytest

from lightmeter.metrics.shapley import MOST_EXHAUSTIVE, every_order, orders_for, sampled_orders


def additive(errors):
    """Each player's error is its own: its share is just that."""
    return lambda s: sum(e for i, e in enumerate(errors) if not s >> i & 1)


def squared_sum(deltas, rest):
    """E(S) = (rest + Σ_{i ∉ S} Δ_i)²; pair by pair, φ_i = Δ_i (Σ_j Δ_j + 2 rest)."""
    return lambda s: (rest + sum(d for i, d in enumerate(deltas) if not s >> i & 1)) ** 2


def values(orders, game):
    return np.array([game(int(s)) for s in orders.sets])


def test_an_additive_game_gives_each_its_own():
    errors = np.array([3.0, -1.0, 0.5, 0.0])
    orders = every_order(4)
    np.testing.assert_allclose(orders.mean @ values(orders, additive(errors)), errors, atol=1e-12)


def test_squared_errors_that_add_up_or_cancel():
    deltas, rest = np.array([1.0, -0.4, 2.0]), 0.3
    orders = every_order(3)
    shares = orders.mean @ values(orders, squared_sum(deltas, rest))
    np.testing.assert_allclose(shares, deltas * (deltas.sum() + 2 * rest), atol=1e-12)
    assert shares[1] < 0


def test_shares_are_the_mean_over_all_orders():
    """Against the definition itself, order by order, for a game without structure."""
    rng = np.random.default_rng(1)
    table = rng.normal(size=16)
    found = np.zeros(4)
    for order in itertools.permutations(range(4)):
        before = 0
        for player in order:
            found[player] += table[before] - table[before | 1 << player]
            before |= 1 << player
    orders = every_order(4)
    np.testing.assert_allclose(orders.mean @ table, found / 24, atol=1e-12)


@pytest.mark.parametrize("orders", [every_order(5), sampled_orders(5, 2), orders_for(12, pairs=3)])
def test_shares_add_up_to_what_goes_away(orders):
    rng = np.random.default_rng(2)
    table = rng.normal(size=len(orders.sets))
    everyone = orders.index((1 << orders.players) - 1)
    shares = orders.weights @ table
    np.testing.assert_allclose(shares.sum(axis=1), table[orders.index(0)] - table[everyone], atol=1e-12)


def test_sampled_orders_converge_as_their_own_spread_says():
    """A game with products of three players, which antithetic pairs do not cancel, unlike squares."""
    deltas = np.linspace(0.5, 1.5, 6)
    game = lambda s: np.prod([1 + (0 if s >> i & 1 else d) for i, d in enumerate(deltas)])  # noqa: E731
    exact = every_order(6)
    truth = exact.mean @ values(exact, game)
    for pairs in (16, 1024):
        orders = sampled_orders(6, pairs, seed=3)
        samples = orders.weights @ values(orders, game)
        error = samples.std(axis=0, ddof=1) / np.sqrt(pairs)
        # Six players at two budgets: 3.6 standard errors are passed by chance in one of 250 runs (normal, Šidák).
        assert (np.abs(samples.mean(axis=0) - truth) < 3.6 * error).all()
    assert (error < 0.02 * truth).all()


def test_antithetic_pairs_are_exact_for_squares():
    """For E = (Σ Δ)² an order and its reverse average to the Shapley value itself."""
    deltas, rest = np.linspace(-1, 2, 12), 0.1
    orders = orders_for(12, pairs=2)
    samples = orders.weights @ values(orders, squared_sum(deltas, rest))
    np.testing.assert_allclose(samples[0], deltas * (deltas.sum() + 2 * rest), atol=1e-10)


def test_every_set_is_evaluated_up_to_ten_players():
    assert orders_for(MOST_EXHAUSTIVE).exhaustive
    assert len(orders_for(MOST_EXHAUSTIVE).sets) == 1024
    assert not orders_for(MOST_EXHAUSTIVE + 1).exhaustive


def test_a_set_that_is_not_evaluated_is_refused():
    orders = sampled_orders(12, 2)
    missing = next(s for s in range(1 << 12) if s not in set(orders.sets.tolist()))
    with pytest.raises(KeyError):
        orders.index(missing)
