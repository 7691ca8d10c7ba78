"""Inputs: ordinary ones, designed extremes, and steps of a search in float space."""

import numpy as np

from ..shared_twins import apart, near_the_mirror
from ..twin import Argument, Twin
from .kinds import EXTREMES, UNIT_SLACK, domain_of

DENSITIES = (apart, near_the_mirror)
"""Arrangements that only say where to look; the others are relations that the function may rely on."""

Inputs = list[np.ndarray]


class Design:
    """Draws inputs for a function: (components, n) float32 values in float64 per argument."""

    def __init__(self, twin: Twin, rng: np.random.Generator) -> None:
        self.arguments = [argument for argument in twin.arguments if not argument.out]
        self._arrange, self._rng = twin.arrange, rng
        self._relation = twin.arrange is not None and twin.arrange not in DENSITIES
        self._kinds = [domain_of(argument).kind for argument in self.arguments]

    def ordinary(self, n: int) -> Inputs:
        """Random inputs of the declared domain."""
        return self._held(self._drawn(n), self._arrange)

    def extremes(self, n: int) -> Inputs:
        """Ordinary inputs in which one argument, or up to three, are extreme."""
        inputs = self.ordinary(n)
        chances = self._rng.random((len(inputs), n))
        first = self._rng.integers(0, len(inputs), n)
        several = self._rng.random(n) < 0.4
        for i in range(len(inputs)):
            chosen = (first == i) | (several & (chances[i] < 2 / (1 + len(inputs))))
            inputs[i] = np.where(chosen, self._extreme(i, inputs), inputs[i])
        return self._held(inputs, self._arrange if self._relation else None)

    def children(self, parents: Inputs, n: int) -> Inputs:
        """Steps from a roundings' length to a factor of e from parents, and crossings of two."""
        rng, count = self._rng, parents[0].shape[1]
        one, other = rng.integers(0, count, (2, n))
        result = []
        stride = 10 ** rng.uniform(-7, 0, n)
        for i, values in enumerate(parents):
            x = np.where(rng.random(n) < 0.15, values[:, other], values[:, one])
            if self._kinds[i] != "fixed":
                moved = x * np.exp(stride * rng.normal(size=x.shape) * (rng.random(x.shape) < 0.5))
                if self._kinds[i] == "direction":
                    moved = _as_long(moved, x)
                x = np.where(rng.random(n) < 0.1, self._extreme(i, result + parents[i:], x.shape), moved)
            result.append(x)
        return self._held(result, self._arrange if self._relation else None)

    def _drawn(self, n: int) -> Inputs:
        found = []
        for argument in self.arguments:
            x = self._draw(argument, n)
            found.append(np.where(self._rng.random(n) < 0.15, self._boundary(argument, x), x))
        return found

    def _draw(self, argument: Argument, n: int) -> np.ndarray:
        assert argument.draw is not None
        return np.reshape(argument.draw(self._rng, n), (-1, n))

    def _boundary(self, argument: Argument, x: np.ndarray) -> np.ndarray:
        if not len(argument.boundary):
            return x
        ends = np.reshape(np.array(argument.boundary, np.float64).T, (len(x), -1))
        return ends[:, self._rng.integers(0, ends.shape[1], x.shape[1])]

    def _extreme(self, i: int, inputs: Inputs, shape: tuple[int, ...] | None = None) -> np.ndarray:
        """Extreme values of argument i; where its kind has none, its boundary's."""
        rng, kind = self._rng, self._kinds[i]
        size, n = shape or inputs[i].shape
        if kind == "direction":
            return self._direction(i, n, inputs)
        values = EXTREMES.get(kind, ())
        if not values:
            return self._boundary(self.arguments[i], self._draw(self.arguments[i], n))
        picked = np.array(values)[rng.integers(0, len(values), (size, n))]
        if kind in ("alpha", "roughness"):
            decades = 10 ** rng.uniform(-6, 0, (size, n))
            picked = np.where(rng.random(n) < 0.7, decades if kind == "alpha" else np.sqrt(decades), picked)
        if kind == "distance" and size > 1:
            v = rng.normal(size=(size, n))
            picked = v / np.linalg.norm(v, axis=0) * picked[0]
        return np.where(rng.random(n) < 0.5, picked, picked[0]) if kind in ("colour", "index") else picked

    def _direction(self, i: int, n: int, inputs: Inputs) -> np.ndarray:
        """A direction that is zero, too short or long, an axis; or, to another one, equal, opposite or grazing."""
        rng = self._rng
        v = rng.normal(size=(3, n))
        v = v / np.linalg.norm(v, axis=0)
        axis = np.eye(3)[:, rng.integers(0, 3, n)] * rng.choice([-1.0, 1.0], n)
        others = [k for k, kind in enumerate(self._kinds) if kind == "direction" and k != i]
        wide = [inputs[k] for k in others if inputs[k].shape[1] == n]
        to = wide[rng.integers(0, len(wide))] if wide else axis
        along = v - to * (v * to).sum(axis=0)
        along = along / np.maximum(np.linalg.norm(along, axis=0), 1e-9)
        tilt = 10 ** rng.uniform(-8, -1, n) * rng.choice([-1.0, 1.0, 1.0], n)
        choices = [
            0 * v,
            v * 10 ** rng.uniform(-20, -3, n),
            v * 10 ** rng.uniform(-2, 1, n),
            v * (1 + 10 ** rng.uniform(-5, -1, n) * rng.choice([-1, 1], n)),
            axis,
            _unit(to + along * tilt),
            _unit(-to + along * np.abs(tilt)),
            -to,
            _unit(along + to * tilt),
            _unit(along + to * tilt),
        ]
        return np.choose(rng.integers(0, len(choices), n), choices)

    def _held(self, inputs: Inputs, arrange) -> Inputs:
        """Arranged, as float32 holds them; lanes that an arrangement breaks are given ordinary values."""
        n = inputs[0].shape[1]
        if arrange is not None:
            flat = [x[0] if a.size == 1 else x for a, x in zip(self.arguments, inputs, strict=True)]
            with np.errstate(all="ignore"):
                inputs = [np.reshape(x, (-1, n)) for x in arrange(self._rng, flat)]
        with np.errstate(over="ignore", under="ignore"):
            held = [x.astype(np.float32).astype(np.float64) for x in inputs]
        sound = np.all([np.isfinite(x).all(axis=0) for x in held], axis=0)
        if not sound.all():
            mended = self.ordinary(n) if arrange is None else [np.where(np.isfinite(x), x, 0.5) for x in held]
            held = [np.where(sound, x, y) for x, y in zip(held, mended, strict=True)]
        return held


def joined(first: Inputs, second: Inputs) -> Inputs:
    """The lanes of both."""
    return [np.concatenate(pair, axis=1) for pair in zip(first, second, strict=True)]


def _unit(v: np.ndarray) -> np.ndarray:
    return v / np.maximum(np.linalg.norm(v, axis=0), 1e-300)


def _as_long(moved: np.ndarray, before: np.ndarray) -> np.ndarray:
    """Unit vectors stay so."""
    length = np.linalg.norm(before, axis=0)
    return np.where(np.abs(length - 1) <= UNIT_SLACK, _unit(moved), moved)
