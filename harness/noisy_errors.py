"""Errors of sets of exact players by a metric that noise biases, at the mean of all batches and of halves of them."""

from dataclasses import dataclass

import numpy as np

from lightmeter.game import Game
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.noise_bound import QUARTERS, SPLITS, signed_bound
from lightmeter.squared_shares import CONFIDENCE, sampling_error


def batch_groups(batches: int) -> list[list[int]]:
    """Which batches to average: all of them, then both halves of each way to halve them."""
    quarters = [list(range(quarter, batches, len(QUARTERS))) for quarter in QUARTERS]
    halves = [sorted(b for quarter in half for b in quarters[quarter]) for split in SPLITS for half in split]
    return [list(range(batches)), *halves]


@dataclass(frozen=True, eq=False)
class NoisyErrors:
    """The error of every set.

    Attributes:
        full: (m,), at the mean of all batches.
        halves: (3, 2, m), at the mean of each half of three ways to halve them.
    """

    game: Game
    full: np.ndarray
    halves: np.ndarray

    @classmethod
    def of(cls, game: Game, values: np.ndarray) -> "NoisyErrors":
        """From (7, m), a row for each of `batch_groups`."""
        return cls(game, values[0], values[1:].reshape(len(SPLITS), 2, -1))

    def share(self, player: int) -> Measurement:
        """A player's Shapley share, signed."""
        return self._measured(self.game.share_weights(player), "Shapley value")

    def removed(self, *players: int) -> Measurement:
        """The error that goes away where these players alone are made exact, signed."""
        return self._measured(self.game.removed_weights(*players), "frame less frame with this exact")

    def total(self) -> Measurement:
        """The error with nobody exact."""
        return self._measured(self.game.total_weights(), "value")

    def residual(self) -> Measurement:
        """What is left with everybody exact: noise, for the most part."""
        return self._measured(self.game.residual_weights(), "value")

    def _measured(self, weights: np.ndarray, what: str) -> Measurement:
        """A linear combination of the sets' errors: (p, m) weights, p samples of orders."""
        samples, mean = weights @ self.full, weights.mean(axis=0)
        value, half = float(samples.mean()), sampling_error(samples)
        low, high = signed_bound(value, self.halves @ mean, CONFIDENCE)
        how = f"{what} at the mean of {len(self.game.reference)} batches, bound from fewer batches"
        return Measurement(value, low - half, high + half, "", how)
