"""FLIP of every set of exact players, and its shares.

FLIP needs a picture per set. The reference is filtered once for all of them, sets that differ by players which change
nothing are one, and pictures are composed and compared two at a time. Noise biases FLIP, so every set is also compared
at halves of the batches, which tells how far (see metrics/noise_bound.py).
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from lightmeter.families import Layers
from lightmeter.game import Game
from lightmeter.metrics.flip import FlipAgainst
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.noise_bound import QUARTERS, SPLITS, signed_bound
from lightmeter.progress import Report, silent
from lightmeter.squared_shares import CONFIDENCE, sampling_error

WORKERS = 2
_SAME = 1e-6
"""Images whose RMS difference is below this fraction of the reference's RMS are one: a few float32 roundings."""


Display = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class FlipErrors:
    """Mean FLIP of every set.

    Attributes:
        full: (m,), at the mean of all batches.
        halves: (3, 2, m), at the mean of each half of three ways to halve them.
    """

    game: Game
    full: np.ndarray
    halves: np.ndarray

    def share(self, player: int) -> Measurement:
        """A player's Shapley share, signed."""
        return self._measured(self.game.share_weights(player), "Shapley value")

    def removed(self, player: int) -> Measurement:
        """The error that goes away where the player alone is made exact, signed."""
        return self._measured(self.game.removed_weights(player), "frame less frame with this exact")

    def total(self) -> Measurement:
        """The frame's error."""
        return self._measured(self.game.total_weights(), "FLIP")

    def residual(self) -> Measurement:
        """What is left with everybody exact: noise, for the most part."""
        return self._measured(self.game.residual_weights(), "FLIP")

    def _measured(self, weights: np.ndarray, what: str) -> Measurement:
        """A linear combination of the sets' errors: (p, m) weights, p samples of orders."""
        samples, mean = weights @ self.full, weights.mean(axis=0)
        value, half = float(samples.mean()), sampling_error(samples)
        low, high = signed_bound(value, self.halves @ mean, CONFIDENCE)
        how = f"{what} at the mean of {len(self.game.reference)} batches, bound from fewer batches"
        return Measurement(value, low - half, high + half, "", how)


def flip_errors(game: Game, display: Display, report: Report = silent) -> tuple[FlipErrors, dict[str, np.ndarray]]:
    """FLIP of every set, and player to (H, W) float32: where its share lies.

    Args:
        display: maps (H, W, 3) scene-linear to display values, put on both sides.
    """
    batches, count = len(game.reference), len(game.orders.sets)
    quarters = [list(range(quarter, batches, 4)) for quarter in QUARTERS]
    halves = [sorted(b for quarter in half for b in quarters[quarter]) for split in SPLITS for half in split]
    groups = [list(range(batches)), *halves]
    values = np.zeros((len(groups), count))
    weights, maps = game.orders.mean, np.zeros((len(game.names), *game.reference.shape[1:3]))
    changes = _players_that_change_something(game)
    done = 0
    for layers, sets in game.by_variant():
        same: dict[int, list[int]] = {}
        for place, players in sets:
            same.setdefault(players & changes, []).append(place)
        for level, group in enumerate(groups):
            against = FlipAgainst(display(_mean(game.reference, group)))
            means = {id(part): _mean(part, group) for part in _parts(layers, game, same)}

            def error(players: int, means=means, layers=layers, against=against) -> np.ndarray:
                image = sum(means[id(part)] for part in layers.parts(game.exact(players)))
                return against(display(image.astype(np.float32)))

            with ThreadPoolExecutor(WORKERS) as pool:
                for places, found in zip(same.values(), pool.map(error, same), strict=True):
                    values[level, places] = found.mean(dtype=np.float64)
                    if level == 0:
                        for player in range(len(maps)):
                            maps[player] += weights[player, places].sum() * found
                    done += 1
                    report("shares of FLIP", done, len(groups) * len(game.orders.sets))
    errors = FlipErrors(game, values[0], values[1:].reshape(len(SPLITS), 2, count))
    return errors, dict(zip(game.names, maps.astype(np.float32), strict=True))


def _parts(layers: Layers, game: Game, sets) -> list[np.ndarray]:
    """Every stack of images that any of the sets needs."""
    found = {id(part): part for players in sets for part in layers.parts(game.exact(players))}
    return list(found.values())


def _mean(stack: np.ndarray, batches: list[int]) -> np.ndarray:
    """(H, W, 3) float32: the mean over some batches of (K or 1, H, W, 3)."""
    chosen = stack[batches] if len(stack) > 1 else stack
    return chosen.mean(axis=0, dtype=np.float64).astype(np.float32)


def _players_that_change_something(game: Game) -> int:
    """The set of players whose exactness changes an image or the points that it is composed at."""
    scale = float(np.sqrt(np.mean(_mean(game.reference, list(range(len(game.reference)))) ** 2, dtype=np.float64)))
    found = 0
    variants = [layers for layers, _ in game.by_variant()]
    for i, name in enumerate(game.names):
        moves = game.families.layers((name,)) is not game.families.layers(())
        if moves or any(_changes(layers, name, _SAME * scale) for layers in variants):
            found |= 1 << i
    return found


def _changes(layers: Layers, player: str, least: float) -> bool:
    """Whether a player's exactness changes any slot's image by more than `least` RMS."""
    for slot, images in zip(layers.slots, layers.images, strict=True):
        if player not in slot.players:
            continue
        bit = 1 << slot.players.index(player)
        for which in slot.sets:
            if not which & bit:
                without, with_it = (images[w].mean(axis=0, dtype=np.float64) for w in (which, which | bit))
                if np.sqrt(np.mean((with_it - without) ** 2)) > least:
                    return True
    return False
