"""FLIP of every set of exact players, and its shares.

FLIP needs a picture per set. The reference is filtered once for all of them, sets that differ by players which change
nothing are one, and pictures are composed and compared two at a time. Noise biases FLIP, so every set is also compared
at halves of the batches, which tells how far (see metrics/noise_bound.py).
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from lightmeter.families import Layers
from lightmeter.game import Game
from lightmeter.metrics.flip import FlipAgainst
from lightmeter.noisy_errors import NoisyErrors, batch_groups
from lightmeter.progress import Report, silent

WORKERS = 2
_SAME = 1e-6
"""Images whose RMS difference is below this fraction of the reference's RMS are one: a few float32 roundings."""


Display = Callable[[np.ndarray], np.ndarray]


def flip_errors(game: Game, display: Display, report: Report = silent) -> tuple[NoisyErrors, dict[str, np.ndarray]]:
    """FLIP of every set, and player to (H, W) float32: where its share lies.

    Args:
        display: maps (H, W, 3) scene-linear to display values, put on both sides.
    """
    batches, count = len(game.reference), len(game.orders.sets)
    groups = batch_groups(batches)
    values = np.zeros((len(groups), count))
    weights, maps = game.orders.mean, np.zeros((len(game.names), *game.reference.shape[1:3]))
    changes = _players_that_change_something(game)
    done = 0
    for layers, sets in game.by_variant:
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
    return NoisyErrors.of(game, values), {name: maps[i].astype(np.float32) for i, name in enumerate(game.names)}


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
    variants = [layers for layers, _ in game.by_variant]
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
