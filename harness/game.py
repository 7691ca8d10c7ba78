"""The game that an error is shared out by: its players, the sets that are evaluated, the layers each set adds up."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lightmeter.families import Families, Layers
from lightmeter.metrics.shapley import Orders


@dataclass(frozen=True, eq=False)
class Game:
    """Players and sets of them.

    Attributes:
        names: the players; bit i of a set stands for the i-th.
        orders: which sets are evaluated, with what weights.
        families: the layers of every variant of the G-buffer; None for a game that is not played with layers.
        reference: (K, H, W, 3) batches.
    """

    names: tuple[str, ...]
    orders: Orders
    families: Families | None
    reference: np.ndarray

    def exact(self, players: int) -> tuple[str, ...]:
        """The names in a set."""
        return tuple(name for i, name in enumerate(self.names) if players >> i & 1)

    @cached_property
    def by_variant(self) -> tuple[tuple[Layers, list[tuple[int, int]]], ...]:
        """Every variant's layers, with the (place in `orders.sets`, set) that are composed from them. Renders them."""
        found: dict[int, tuple[Layers, list[tuple[int, int]]]] = {}
        for place, players in enumerate(map(int, self.orders.sets)):
            layers = self.families.layers(self.exact(players))
            found.setdefault(id(layers), (layers, []))[1].append((place, players))
        return tuple(found.values())

    def share_weights(self, player: int) -> np.ndarray:
        """(p, m): the player's share by each sample of orders is this times the errors of the m sets."""
        return self.orders.weights[:, player]

    def removed_weights(self, *players: int) -> np.ndarray:
        """(1, m): the error that goes away where these players alone are made exact.

        Raises:
            KeyError: that set is not evaluated, as orders are sampled.
        """
        return self._unit(0) - self._unit(sum(1 << player for player in players))

    def total_weights(self) -> np.ndarray:
        """(1, m): the error with nobody exact, the frame's own."""
        return self._unit(0)

    def residual_weights(self) -> np.ndarray:
        """(1, m): the error with everybody exact."""
        return self._unit((1 << len(self.names)) - 1)

    def _unit(self, players: int) -> np.ndarray:
        weights = np.zeros((1, len(self.orders.sets)))
        weights[0, self.orders.index(players)] = 1.0
        return weights
