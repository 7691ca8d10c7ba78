"""Attribution: how much of the frame's error each approximation causes.

E(S) is the frame's error with the players in S exact. Every set is evaluated (beyond ten players: sampled orders), by
substituting oracles' buffers for effects' buffers before composition, and each player gets its Shapley share; nothing
is rendered again. What is left with everything exact is the residual: total = Σ share + residual.
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from lightmeter.families import Families
from lightmeter.flip_shares import flip_errors
from lightmeter.game import Game
from lightmeter.metrics.shapley import orders_for
from lightmeter.noisy_errors import NoisyErrors
from lightmeter.progress import Report, silent
from lightmeter.reports import results as outcome
from lightmeter.squared_shares import SquaredErrors, squared_errors, squared_maps


@dataclass(frozen=True, eq=False)
class Shares:
    """What attribution found.

    Attributes:
        attribution: the numbers.
        maps: metric to player to (H, W) float32: where its share lies. The mean of a map is the share: of FLIP exactly,
            of the squared error (in (W/sr/m²)²) up to noise.
    """

    attribution: outcome.Attribution
    maps: Mapping[str, Mapping[str, np.ndarray]]


def attribute(
    players: Mapping[str, tuple[str, ...]],
    effects: Mapping[str, object],
    families: Families,
    reference: np.ndarray,
    display: Callable[[np.ndarray], np.ndarray],
    report: Report = silent,
) -> Shares:
    """Share out the frame's error.

    Args:
        players: name to the terms that become exact with it.
        effects: the players that are effects; the others are terms that no effect gives.
        families: the layers of every variant.
        reference: (K, H, W, 3) batches, K ≥ 8.
        display: the frame's display transform, for FLIP.
    """
    game = Game(tuple(players), orders_for(len(players)), families, reference)
    seconds = {}

    def timed(metric: str, work: Callable):
        start = time.perf_counter()
        done = work()
        seconds[metric] = round((time.perf_counter() - start) / len(game.orders.sets), 6)
        return done

    report("variants", len(game.by_variant), len(game.by_variant))  # rendered now: no part of what a set costs
    squared = timed("mse", lambda: squared_errors(game))
    flips, flip_maps = timed("flip", lambda: flip_errors(game, display, report))
    errors = {"mse": squared, "flip": flips}
    return Shares(
        outcome.Attribution(
            total={metric: found.total() for metric, found in errors.items()},
            residual={metric: found.residual() for metric, found in errors.items()},
            players=tuple(
                outcome.Player(
                    name,
                    terms,
                    name in effects,
                    {metric: found.share(i) for metric, found in errors.items()},
                    {metric: found.removed(i) for metric, found in errors.items()},
                )
                for i, (name, terms) in enumerate(players.items())
            ),
            subsets=len(game.orders.sets),
            exhaustive=game.orders.exhaustive,
            seconds_per_subset=seconds,
            together=tuple(
                outcome.Together(
                    (game.names[i], game.names[j]), {m: found.removed(i, j) for m, found in errors.items()}
                )
                for i, j in (pairs_that_compensate(game, errors) if game.orders.exhaustive else ())
            ),
        ),
        {"mse": squared_maps(game), "flip": flip_maps},
    )


def pairs_that_compensate(game: Game, errors: Mapping[str, SquaredErrors | NoisyErrors]) -> list[tuple[int, int]]:
    """Players that make the frame worse where they alone are exact, each with the one it makes up for.

    That is the partner with whom it removes most, where that is more than either removes alone.
    """
    players, found = range(len(game.names)), dict[tuple[int, int], None]()
    for error in errors.values():
        alone = [error.removed(i).value for i in players]
        for i in (i for i in players if alone[i] < 0):
            others = {j: error.removed(i, j).value for j in players if j != i}
            best = max(others, key=others.__getitem__, default=i)
            if best != i and others[best] > max(alone[best], 0.0):
                found.setdefault((min(i, best), max(i, best)))
    return list(found)
