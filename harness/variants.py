"""The G-buffer with any of the players that vary it exact.

`surface` and `material` are no buffers: making one exact changes the points that every other term is evaluated at. A
*variant* is named by the players that are exact in it. It has a surface (the one that is drawn, or the true one: the
rasteriser and the oracles change with it) and points on it with their parameters.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lightmeter.realtime.renderer import Capture, Renderer
from lightmeter.scenes.points import SurfacePoints
from lightmeter.stacking import at_sample, stack_points
from lightmeter.substitution import players_of
from lightmeter.truth import Truth

VARYING = ("surface", "material")
"""The terms whose players change the points."""


@dataclass(frozen=True, eq=False)
class Seen:
    """The points of one variant at some sub-pixel samples.

    Attributes:
        truth: the oracles on the variant's surface.
        captures: what the effects gave at each sample, where that was asked for.
        points: (n, H, W).
        family: names the random numbers of oracles here, see `Truth.batch`.
    """

    truth: Truth
    captures: list[Capture]
    points: SurfacePoints
    family: str


@dataclass(eq=False)
class Variants:
    """All variants of one frame's G-buffer.

    Args:
        renderer: draws the frame.
        truth: of the true surface.
    """

    renderer: Renderer
    truth: Truth

    @cached_property
    def everyone(self) -> frozenset[str]:
        """The players that vary the points."""
        plan = self.renderer.plan
        return frozenset(p for term in VARYING if term not in plan.missing for p in players_of(plan, term))

    def named(self, exact: Collection[str]) -> frozenset[str]:
        """The variant in which those of the players are exact that vary the points."""
        return self.everyone & frozenset(exact)

    def surface(self, exact: Collection[str]) -> tuple[Renderer, Truth]:
        """Who draws the surface of a variant, and the oracles on it."""
        if self._has_true_surface(exact):
            return self._true, self.truth
        return self.renderer, self.truth.on(self.renderer.plan.scene)

    def see(self, exact: Collection[str], offsets: Sequence[np.ndarray], terms: bool = True) -> Seen:
        """A variant at some samples.

        Args:
            offsets: (n, 2) from the pixels' centres, pixels right and down.
            terms: whether the effects' buffers are wanted.
        """
        renderer, truth = self.surface(exact)
        if self._has_true_surface(exact) and self._has_exact_material(exact):
            # Rays are as exact as it gets, and do not mind how many triangles there are.
            return self._shaded(exact, stack_points([truth.seen(offset) for offset in offsets]), offsets, terms)
        as_drawn = "material" in self.truth.missing or not self._has_exact_material(exact)
        floats = exact if as_drawn else self.renderer.plan.effects
        captures = [renderer.capture(tuple(offset), terms and as_drawn, floats) for offset in offsets]
        points = stack_points([capture.points for capture in captures])
        if not as_drawn:
            return self._shaded(exact, truth.exact_material(points), offsets, terms)
        return Seen(truth, captures, points, self._family(exact))

    def _shaded(
        self, exact: Collection[str], points: SurfacePoints, offsets: Sequence[np.ndarray], terms: bool
    ) -> Seen:
        """At given points, as they are stored; with the effects' buffers there, where they are wanted."""
        renderer, truth = self.surface(exact)
        stored = [renderer.stored(at_sample(points, n), tuple(place), exact) for n, place in enumerate(offsets)]
        there = zip(stored, offsets, strict=True) if terms else ()
        captures = [renderer.shade(sample, tuple(place)) for sample, place in there]
        return Seen(truth, captures, stack_points(stored), self._family(exact))

    @cached_property
    def _true(self) -> Renderer:
        return Renderer(self.renderer.device, self.renderer.plan.with_true_surface(), self.renderer.size)

    def _has_true_surface(self, exact: Collection[str]) -> bool:
        effects = self.renderer.plan.effects
        return any(name in effects and effects[name][0].surface is not None for name in self.named(exact))

    def _has_exact_material(self, exact: Collection[str]) -> bool:
        """Whether parameters are unfiltered, however they are stored; so they are without textures."""
        plan = self.renderer.plan
        everyone = players_of(plan, "material")
        filters = [player for player in everyone if not plan.is_storage(player)]
        return "material" in self.truth.missing or self.named(exact) >= frozenset(filters or everyone)

    def _family(self, exact: Collection[str]) -> str:
        """The name of a variant's random numbers.

        How channels are stored moves points by little: with the same numbers the difference has hardly any noise.
        """
        plan = self.renderer.plan
        filters = {player for player in players_of(plan, "material") if not plan.is_storage(player)}
        named = {player for player in self.named(exact) if not plan.is_storage(player)}
        if not named:
            return "frame"
        return "exact material" if named == filters else f"exact {', '.join(sorted(named))}"
