"""The squared error of every set of exact players, and its shares.

The image of a set is a sum of layers, so its squared error is a quadratic form: one matrix of inner products between
all layers of all batches gives it for every set, by products of different batches only (neither side's noise biases
it), and with every jackknife replicate. The pixels are read once, however many sets there are.
"""

import math
from dataclasses import dataclass

import numpy as np

from lightmeter.families import Layers
from lightmeter.game import Game
from lightmeter.metrics.interval import mean_interval, squared_norm_interval, student_t, u_statistic
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.mse import RADIANCE

UNIT = f"({RADIANCE})²"
CONFIDENCE = 0.95
_VALUES = 1 << 15
"""Values of an image that are multiplied at once, for all layers: what stays in a cache."""


@dataclass(frozen=True, eq=False)
class SquaredErrors:
    """The mean squared error of every set.

    Attributes:
        values: (m,) U-statistics.
        left_out: (m, K), with each batch left out.
        grams: place of a set to its (K, K) inner products of differences; for the empty and the full set.
    """

    game: Game
    values: np.ndarray
    left_out: np.ndarray
    grams: dict[int, np.ndarray]

    def share(self, player: int) -> Measurement:
        """A player's Shapley share, signed."""
        return self._measured(self.game.share_weights(player), "Shapley value")

    def removed(self, *players: int) -> Measurement:
        """The error that goes away where these players alone are made exact, signed."""
        return self._measured(self.game.removed_weights(*players), "frame less frame with this exact")

    def total(self) -> Measurement:
        """The frame's error."""
        return self._squared_norm(0)

    def residual(self) -> Measurement:
        """What is left with everybody exact."""
        return self._squared_norm(len(self.values) - 1)

    def _squared_norm(self, place: int) -> Measurement:
        value = float(self.values[place])
        low, high = squared_norm_interval(value, self.left_out[place], self.grams[place], CONFIDENCE)
        return Measurement(value, low, high, UNIT, self._how("U-statistic"))

    def _measured(self, weights: np.ndarray, what: str) -> Measurement:
        """A difference of errors: (p, m) weights, p samples of orders."""
        samples, mean = weights @ self.values, weights.mean(axis=0)
        value = float(samples.mean())
        low, high = mean_interval(value, mean @ self.left_out, CONFIDENCE)
        half = math.hypot((high - low) / 2, sampling_error(samples))
        return Measurement(value, value - half, value + half, UNIT, self._how(what))

    def _how(self, what: str) -> str:
        return f"{what} over {len(self.game.reference)} batches, jackknife, Student t"


def sampling_error(samples: np.ndarray) -> float:
    """The half-width of the 95 % interval that sampling orders leaves of a share; 0 where all orders are taken."""
    if len(samples) == 1:
        return 0.0
    return student_t(len(samples), CONFIDENCE) * float(samples.std(ddof=1)) / math.sqrt(len(samples))


def squared_errors(game: Game) -> SquaredErrors:
    """The squared error of every set, in the frame's unit."""
    batches, count = len(game.reference), len(game.orders.sets)
    values, left_out = np.zeros(count), np.zeros((count, batches))
    grams = {}
    for layers, sets in game.by_variant:
        products = inner_products(layers, game.reference)
        for place, players in sets:
            summands = coefficients(layers, game.exact(players), batches)
            gram = summands @ products @ summands.T
            values[place], left_out[place] = u_statistic(gram)
            if place in (0, count - 1):
                grams[place] = gram
    return SquaredErrors(game, values, left_out, grams)


def inner_products(layers: Layers, reference: np.ndarray) -> np.ndarray:
    """(r, r) float64: mean products over pixels and channels of all images: the layers' batches, then the reference's.

    The reference's mean is taken off the base and the reference alike: differences stay what they are, and lose no
    digits.
    """
    images = [stack.reshape(len(stack), -1) for stack in (*_stacks(layers), reference)]
    count = sum(len(stack) for stack in images)
    total, values = np.zeros((count, count)), images[0].shape[1]
    for start in range(0, values, _VALUES):
        strip = [stack[:, start : start + _VALUES].astype(np.float64) for stack in images]
        mean = strip[-1].mean(axis=0)
        strip[0] -= mean
        strip[-1] -= mean
        rows = np.concatenate(strip)
        total += rows @ rows.T
    return total / values


def coefficients(layers: Layers, exact: tuple[str, ...], batches: int) -> np.ndarray:
    """(K, r): batch k's difference of composition and reference, as a sum of the images in `inner_products`."""
    chosen = {id(part) for part in layers.parts(exact)}
    blocks = []
    for stack in _stacks(layers):
        spread = np.eye(batches) if len(stack) == batches else np.ones((batches, 1))
        blocks.append(spread if id(stack) in chosen else np.zeros_like(spread))
    return np.hstack([*blocks, -np.eye(batches)])


def squared_maps(game: Game) -> dict[str, np.ndarray]:
    """Player to (H, W) float32: where its share lies, by products of two halves of the batches."""
    height, width = game.reference.shape[1:3]
    maps = np.zeros((len(game.names), height, width))
    weights = game.orders.mean
    for layers, sets in game.by_variant:
        halves = [_means(layers, slice(first, None, 2)) for first in (0, 1)]
        truths = [game.reference[first::2].mean(axis=0, dtype=np.float64) for first in (0, 1)]
        for place, players in sets:
            chosen = [id(part) for part in layers.parts(game.exact(players))]
            even, odd = (sum(half[i] for i in chosen) - truth for half, truth in zip(halves, truths, strict=True))
            error = (even * odd).mean(axis=2)
            for player in np.flatnonzero(weights[:, place]):
                maps[player] += weights[player, place] * error
    return dict(zip(game.names, maps.astype(np.float32), strict=True))


def _means(layers: Layers, batches: slice) -> dict[int, np.ndarray]:
    """The mean of every stack of images over some batches, by the stack's identity."""
    return {
        id(stack): (stack[batches] if len(stack) > 1 else stack).mean(axis=0, dtype=np.float64)
        for stack in _stacks(layers)
    }


def _stacks(layers: Layers) -> list[np.ndarray]:
    """Every stack of images: the base first."""
    return [layers.base, *(stack for images in layers.images for stack in images)]
