"""Shapley values: an error shared out among those that cause it.

Shapley, "A Value for n-Person Games", 1953. A set of players is a bit mask: bit i set, player i is exact. With E(S) the
error that is left where the players in S are exact, player i's share is the mean, over all orders in which the players
could be made exact one after the other, of the error that goes away when its turn comes:

    φ_i = Σ_{S ∌ i} |S|! (n − |S| − 1)! / n! · (E(S) − E(S ∪ {i})),      Σ_i φ_i = E(∅) − E(all).

Shares are linear in E: this module gives the weights, so that the same weights serve numbers, pictures and jackknife
replicates. A share is negative where making the player exact makes things worse: it made up for another's error.
"""

from dataclasses import dataclass
from math import factorial

import numpy as np

MOST_EXHAUSTIVE = 10
"""Players up to which every set is evaluated (1,024 sets)."""


@dataclass(frozen=True)
class Orders:
    """Which sets to evaluate, and what each counts in each player's share.

    Attributes:
        players: n.
        sets: (m,) bit masks, increasing; 0 and the full set are among them.
        weights: (p, n, m): the shares by each of p independent samples of orders are `weights @ errors`; p = 1 where
            all orders are taken.
    """

    players: int
    sets: np.ndarray
    weights: np.ndarray

    @property
    def exhaustive(self) -> bool:
        """Whether all orders are taken, so that no sampling error remains."""
        return len(self.weights) == 1

    @property
    def mean(self) -> np.ndarray:
        """(n, m): the shares are `mean @ errors`."""
        return self.weights.mean(axis=0)

    def index(self, players: int) -> int:
        """Where the set with this mask stands in `sets`.

        Raises:
            KeyError: it is not evaluated.
        """
        at = int(np.searchsorted(self.sets, players))
        if at == len(self.sets) or self.sets[at] != players:
            raise KeyError(players)
        return at


def every_order(players: int) -> Orders:
    """All sets of `players` players, with Shapley's weights."""
    sets = np.arange(1 << players)
    sizes = np.array([int(s).bit_count() for s in sets])
    weights = np.zeros((players, len(sets)))
    for i in range(players):
        without = np.flatnonzero(~sets >> i & 1)
        weight = [factorial(s) * factorial(players - s - 1) / factorial(players) for s in sizes[without]]
        weights[i, without] += weight
        weights[i, without | 1 << i] -= weight
    return Orders(players, sets, weights[None])


def sampled_orders(players: int, pairs: int, seed: int = 0) -> Orders:
    """Random orders, each with its reverse (antithetic: Mitchell et al. 2022, "Sampling Permutations for Shapley
    Value Estimation"), and the sets of one player alone besides.

    Args:
        pairs: how many independent pairs of an order and its reverse, at least 2: their spread is the sampling error.

    Raises:
        ValueError: there are fewer pairs.
    """
    if pairs < 2:
        raise ValueError(f"expected at least 2 pairs of orders, got {pairs}")
    rng = np.random.default_rng([seed, players])
    chains: list[list[tuple[int, int, int]]] = []  # per pair: (player, set before, set after)
    for _ in range(pairs):
        order = rng.permutation(players)
        steps = []
        for direction in (order, order[::-1]):
            before = 0
            for player in direction:
                steps.append((int(player), before, before | 1 << int(player)))
                before |= 1 << int(player)
        chains.append(steps)
    seen = {0} | {1 << i for i in range(players)} | {s for steps in chains for _, *both in steps for s in both}
    sets = np.array(sorted(seen))
    place = {int(s): i for i, s in enumerate(sets)}
    weights = np.zeros((pairs, players, len(sets)))
    for pair, steps in enumerate(chains):
        for player, before, after in steps:
            weights[pair, player, place[before]] += 0.5
            weights[pair, player, place[after]] -= 0.5
    return Orders(players, sets, weights)


def orders_for(players: int, pairs: int = 64, seed: int = 0) -> Orders:
    """Every order up to `MOST_EXHAUSTIVE` players, sampled ones beyond."""
    return every_order(players) if players <= MOST_EXHAUSTIVE else sampled_orders(players, pairs, seed)
