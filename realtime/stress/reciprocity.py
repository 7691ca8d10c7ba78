"""Helmholtz's reciprocity: a BRDF is the same when light and viewer change places, f(v, l) = f(l, v)."""

from dataclasses import replace

import numpy as np

from ..shared_twins import towards
from .both_sides import BothSides, Extreme
from .design import Design, Inputs, joined
from .judging import undecided
from .kinds import domain_of
from .regimes import marks_of

LEAST_COSINE = 1e-3
"""Of light and viewer: nearer to the surface float32 hardly knows the cosines themselves."""
FLOOR = 1e-6 / np.pi
"""A smaller f is judged as if it were as large: a millionth of white paper's."""
VIEW = "v"
"""What the view is called where the function takes none."""
KEPT = 24
"""Parents of the next generation, by each side's violation."""


class Reciprocity:
    """|f(v, l) − f(l, v)| over the larger of the two, of the largest channel.

    Attributes:
        arguments: what it takes: the function's own, and the view where it takes none.
        needs: what `defined` asks of them, in words.
    """

    needs = f"light and viewer need a cosine of at least {LEAST_COSINE:g} to the normal, and directions a length"

    def __init__(self, sides: BothSides, rng: np.random.Generator) -> None:
        brdf, twin = sides.brdf, sides.twin
        if brdf.view is None:
            twin = replace(twin, arguments=(*twin.arguments, towards(VIEW)), arrange=None)
        self._sides, self._design = sides, Design(twin, rng)
        self.arguments = self._design.arguments
        place = {argument.name: i for i, argument in enumerate(self.arguments)}
        self._view, self._light = place[brdf.view or VIEW], place[brdf.light]
        self._normal = None if brdf.normal is None else place[brdf.normal]
        self._below = None if brdf.below is None else place[brdf.below]
        self._directions = self.arguments[self._light].size == 3
        self._by_cosines = domain_of(self.arguments[self._light]).kind == "cosine"

    def worst(self, designed: int = 4096, generations: int = 5, children: int = 1024) -> dict[str, Extreme]:
        """The largest violation found, by the "model" and by the "device", within the declared domain.

        Args:
            designed: ordinary inputs, and as many with extremes.
            generations: steps of the search for worse ones.
            children: inputs of each step.

        Raises:
            ValueError: no input of the declared domain is one that the law is defined at.
        """
        found: dict[str, Extreme] = {}
        inputs = joined(self._design.ordinary(designed), self._design.extremes(designed))
        for _ in range(generations + 1):
            sound = self.defined(inputs) & marks_of(self.arguments, inputs).declared
            if not (sound.any() or found):
                raise ValueError(f"{self._sides.twin.function}: {self.needs}; no input of its domain has them")
            inputs = [x[:, sound] for x in inputs]
            sides = self._violations(inputs)
            parents = set()
            for name in ("model", "device"):
                values = sides[name]
                order = np.argsort(-values)[:KEPT]
                parents |= set(order.tolist())
                if len(order) and (name not in found or values[order[0]] > getattr(found[name], name)):
                    found[name] = self._extreme(inputs, sides, int(order[0]))
            # Those before stay among the parents, so that a step that leads nowhere loses nothing.
            before = [np.array([e.inputs[a.name] for e in found.values()]).T for a in self.arguments]
            elite = joined([x[:, sorted(parents)] for x in inputs], before)
            inputs = self._design.children(elite, children)
        return found

    def at(self, inputs: Inputs) -> Extreme:
        """The violation at one input, a lane of each argument, where the law is `defined`."""
        return self._extreme(inputs, self._violations(inputs), 0)

    def defined(self, inputs: Inputs) -> np.ndarray:
        """(n,) where both directions have a length and stand above the surface, by 10⁻³."""
        return np.all([c >= LEAST_COSINE for c in self._cosines(inputs)], axis=0)

    def _violations(self, inputs: Inputs) -> dict[str, np.ndarray]:
        """(n,) of each, as `Extreme` has them; 0 where float32 cannot tell on which side of a branch either lies."""
        there = self._swapped(inputs)
        one, other = self._of_length_1(inputs), self._of_length_1(there)
        sides = {
            "model": _apart(*(self._value(self._sides.model, x) for x in (one, other))),
            "given": _apart(*(self._value(self._sides.model, x) for x in (inputs, there))),
            "device": _apart(*(self._value(self._sides.device, x) for x in (inputs, there))),
        }
        own = len(self._sides.arguments)
        unclear = undecided(self._sides.twin, inputs[:own]) | undecided(self._sides.twin, there[:own])
        return {name: np.where(unclear, 0.0, value) for name, value in sides.items()}

    def _value(self, side, inputs: Inputs) -> np.ndarray:
        """f, (channels, n)."""
        with np.errstate(all="ignore"):
            value = side(inputs[: len(self._sides.arguments)])
            return value / self._cosines(inputs)[1] if self._sides.brdf.cosine else value

    def _cosines(self, inputs: Inputs) -> tuple[np.ndarray, np.ndarray]:
        """n·v and n·l of unit directions, (n,); without a normal, that of the half vector, which is the best one."""
        view, light = inputs[self._view], inputs[self._light]
        if not self._directions:
            return (view[0], light[0]) if self._by_cosines else (np.ones(view.shape[1]), np.ones(view.shape[1]))
        view, light = _unit(view), _unit(light)
        normal = _unit(view + light) if self._normal is None else _unit(inputs[self._normal])
        return np.sum(normal * view, axis=0), np.sum(normal * light, axis=0)

    def _swapped(self, inputs: Inputs) -> Inputs:
        """Light and viewer in each other's place; what lies below is Lambert's, f·(n·l)."""
        result = list(inputs)
        result[self._view], result[self._light] = inputs[self._light], inputs[self._view]
        if self._below is not None:
            to_view, to_light = self._cosines(inputs)
            below = inputs[self._below] * to_view / to_light
            result[self._below] = below.astype(np.float32).astype(np.float64)
        return result

    def _of_length_1(self, inputs: Inputs) -> Inputs:
        """Directions without what float32 rounded their lengths by: no fault of a model."""
        result = list(inputs)
        if self._directions:
            for i in (self._view, self._light, *(() if self._normal is None else (self._normal,))):
                result[i] = _unit(inputs[i])
        return result

    def _extreme(self, inputs: Inputs, sides: dict[str, np.ndarray], lane: int) -> Extreme:
        words = {a.name: x[:, lane].tolist() for a, x in zip(self.arguments, inputs, strict=True)}
        return Extreme(words, *(float(sides[name][lane]) for name in ("model", "given", "device")))


def _apart(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """|one − other| over the larger, (n,) of (channels, n); infinite where either is not finite."""
    with np.errstate(invalid="ignore"):
        size = np.maximum(np.max(np.abs(one), axis=0), np.max(np.abs(other), axis=0))
        apart = np.max(np.abs(one - other), axis=0) / np.maximum(size, FLOOR)
    return np.where(np.isfinite(apart), apart, np.inf)


def _unit(v: np.ndarray) -> np.ndarray:
    return v / np.maximum(np.linalg.norm(v, axis=0), 1e-300)
