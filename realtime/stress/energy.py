"""Conservation of energy: a BRDF returns no more than it gets, albedo = ∫ f·(n·l) dl ≤ 1 for every view."""

from dataclasses import replace

import numpy as np

from lightmeter.scenes.optics.furnace import COARSE, FINE, SEARCH, Rule, light_from_everywhere

from ..twin import Argument, logarithmic, uniform
from .both_sides import BothSides, Extreme
from .design import Design, Inputs, joined
from .judging import EPS
from .kinds import Domain, domain_of

N_DOT_V = Argument("n_dot_v", "float", logarithmic(1e-2, 1.0), (1e-2, 0.1, 1.0), kind="cosine")
"""The view of an albedo."""
TURN = Argument("turn", "float", uniform(0.0, np.pi / 2), (0.0, np.pi / 4, np.pi / 2))
"""Azimuth of a grain to the view, radians."""
LEAST_COSINE = 1e-3
"""Down to which the quadrature is known to be good."""
KEPT, WEIGHED = 8, 3
"""Parents of the next generation; how many are weighed finely in the end."""


class Energy:
    """The albedo of the brightest channel, on a surface of normal (0, 0, 1) seen from (√(1 − n·v²), 0, n·v).

    Attributes:
        arguments: what an albedo is of: the function's parameters, n·v, and the turn of a grain.
        needs: what `defined` asks of them, in words.
    """

    needs = f"n_dot_v is a cosine from {LEAST_COSINE:g} to 1"

    def __init__(self, sides: BothSides, rng: np.random.Generator) -> None:
        self._sides, brdf = sides, sides.brdf
        self._given = {brdf.view, brdf.light, brdf.normal, brdf.grain, *HALF}
        own = [a for a in sides.arguments if a.name not in self._given]
        self.arguments = [*own, N_DOT_V, *([TURN] if brdf.grain else [])]
        self._domains = [domain_of(argument) for argument in self.arguments]
        self._rng, self._cosine = rng, len(own)
        self._design = Design(replace(sides.twin, arguments=tuple(self.arguments), arrange=None), rng)

    def worst(self, designed: int = 128, generations: int = 8, children: int = 32) -> Extreme:
        """The largest albedo found, on either side, within the declared domain and n·v ≥ 0.01.

        Its error is the quadrature's, told from a coarser rule, and the function's own roundings.

        Args:
            designed: surfaces to begin with.
            generations: steps of the search for brighter ones.
            children: surfaces of each step. With a grain, of which each takes six times as long, half of both.
        """
        if self._sides.brdf.grain:
            designed, children = designed // 2, children // 2
        inputs = self._surfaces(designed)
        elite, best = inputs, np.zeros(0)
        for generation in range(generations + 1):
            found = np.max(self.albedos(inputs, SEARCH), axis=0)
            elite, best = (inputs, found) if not generation else (joined(elite, inputs), np.append(best, found))
            order = np.argsort(-best)[:KEPT]
            elite, best = [x[:, order] for x in elite], best[order]
            inputs = self._children(elite, children)
        weighed = (self.at([x[:, i : i + 1] for x in elite]) for i in range(WEIGHED))
        return max(weighed, key=lambda e: max(e.model, e.device))

    def at(self, inputs: Inputs) -> Extreme:
        """The albedo of one surface, a lane of each argument, n·v above 0."""
        fine, coarse = (self.albedos(inputs, rule)[:, 0] for rule in (FINE, COARSE))
        error = 0.0
        if np.isfinite([fine, coarse]).all():
            error = float(np.max(np.abs(fine - coarse)) + self._sides.twin.roundings * EPS * np.max(fine))
        words = {a.name: x[:, 0].tolist() for a, x in zip(self.arguments, inputs, strict=True)}
        return Extreme(words, float(fine[0]), float(fine[0]), float(fine[1]), error)

    def defined(self, inputs: Inputs) -> np.ndarray:
        """(n,) where n·v is within 0.001…1."""
        cosine = inputs[self._cosine][0]
        return (cosine >= LEAST_COSINE) & (cosine <= 1)

    def albedos(self, inputs: Inputs, rule: Rule) -> np.ndarray:
        """(2, n): by the model and by the device; infinite where a result is not finite."""
        lanes = [self._lit([x[:, i] for x in inputs], rule) for i in range(inputs[0].shape[1])]
        weights = np.stack([weight for _, weight in lanes])
        spread = [np.concatenate(parts, axis=1) for parts in zip(*(given for given, _ in lanes), strict=True)]
        found = []
        for side in (self._sides.model, self._sides.device):
            values = side(spread).reshape(-1, *weights.shape)
            with np.errstate(all="ignore"):
                albedo = np.max(np.sum(values * weights, axis=-1), axis=0)
            found.append(np.where(np.isfinite(albedo), albedo, np.inf))
        return np.stack(found)

    def _lit(self, surface: list[np.ndarray], rule: Rule) -> tuple[Inputs, np.ndarray]:
        """The function's inputs under light from everywhere, and weights of its results."""
        brdf = self._sides.brdf
        given = {a.name: x for a, x in zip(self.arguments, surface, strict=True)}
        cosine = float(given["n_dot_v"][0])
        turn = float(given["turn"][0]) if brdf.grain else None
        light, weight = light_from_everywhere(cosine, rule, turn)
        view = np.array([np.sqrt(1 - cosine * cosine), 0.0, cosine])
        directions = next(a.size for a in self._sides.arguments if a.name == brdf.light) == 3
        if brdf.below:
            given[brdf.below] = given[brdf.below][:, None] * light[2] / np.pi
        given |= _half_cosines(view[:, None], light)
        given[brdf.light] = light if directions else light[2:]
        if brdf.view:
            given[brdf.view] = view if directions else view[2:]
        if brdf.normal:
            given[brdf.normal] = np.array([0.0, 0.0, 1.0])
        if brdf.grain and turn is not None:
            given[brdf.grain] = np.array([np.cos(turn), np.sin(turn), 0.0])
        inputs = [
            np.broadcast_to(np.reshape(given[a.name], (a.size, -1)), (a.size, light.shape[1]))
            for a in self._sides.arguments
        ]
        return inputs, weight if brdf.cosine else weight * light[2]

    def _surfaces(self, n: int) -> Inputs:
        """Surfaces of the declared domain: half of them of pure materials and white, since a mixture is no brighter
        than its parts; and half with an α of any decade.
        """
        pure, smooth = self._rng.random((2, n)) < 0.5
        result = []
        for domain, x in zip(self._domains, self._design.ordinary(n), strict=True):
            if domain.kind == "colour":
                x = np.where(pure, 1.0, x)
            elif domain.kind == "share":
                x = np.where(pure, self._rng.integers(0, 2, x.shape), x)
            elif domain.kind in ("alpha", "roughness"):
                decades = 10 ** self._rng.uniform(-3, 0, x.shape)
                x = np.where(smooth, decades if domain.kind == "alpha" else np.sqrt(decades), x)
            result.append(x)
        return self._held(result)

    def _children(self, parents: Inputs, n: int) -> Inputs:
        """Parents with a quarter of their arguments new and half of the others moved, by 1 % to a factor of e."""
        rng = self._rng
        one = rng.integers(0, parents[0].shape[1], n)
        reach = 10 ** rng.uniform(-2, 0, n)
        result = []
        for x, fresh in zip(parents, self._surfaces(n), strict=True):
            moved = x[:, one] * np.exp(np.where(rng.random(n) < 0.5, reach, 0) * rng.normal(size=fresh.shape))
            result.append(np.where(rng.random(n) < 0.25, fresh, moved))
        return self._held(result)

    def _held(self, inputs: Inputs) -> Inputs:
        """Within the declared domain, as float32 holds it."""
        return [_within(domain, x) for domain, x in zip(self._domains, inputs, strict=True)]


HALF = ("n_dot_h", "sin2_h", "v_dot_h", "l_dot_h")


def _half_cosines(view: np.ndarray, light: np.ndarray) -> dict[str, np.ndarray]:
    """What a function by cosines may take of the half vector, (1, n) each."""
    half = view + light
    half = half / np.linalg.norm(half, axis=0)
    along = np.sum(view * half, axis=0, keepdims=True)
    return dict(zip(HALF, (half[2:], np.sum(half[:2] ** 2, axis=0, keepdims=True), along, along), strict=True))


def _within(domain: Domain, x: np.ndarray) -> np.ndarray:
    return x if domain.kind == "fixed" else np.clip(x, domain.low, domain.high).astype(np.float32).astype(np.float64)
