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
        captures: what the effects gave at each sample.
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
        effects = self.renderer.plan.effects
        if any(name in effects and effects[name][0].surface is not None for name in self.named(exact)):
            return self._true, self.truth
        return self.renderer, self.truth.on(self.renderer.plan.scene)

    @cached_property
    def _true(self) -> Renderer:
        return Renderer(self.renderer.device, self.renderer.plan.with_true_surface(), self.renderer.size)

    def see(self, exact: Collection[str], offsets: Sequence[np.ndarray], terms: bool = True) -> Seen:
        """A variant at some samples.

        Args:
            offsets: (n, 2) from the pixels' centres, pixels right and down.
            terms: whether the effects' buffers are wanted.
        """
        renderer, truth = self.surface(exact)
        filtered, places = not self._exact_material(exact), [tuple(offset) for offset in offsets]
        floats = exact if filtered else self.renderer.plan.effects
        captures = [renderer.capture(place, terms and filtered, floats) for place in places]
        points = stack_points([capture.points for capture in captures])
        if not filtered:
            points = truth.exact_material(points)
            samples = [renderer.stored(at_sample(points, n), place, exact) for n, place in enumerate(places)]
            points = stack_points(samples)
            captures = [renderer.shade(sample) for sample in samples] if terms else captures
        return Seen(truth, captures, points, self._family(exact))

    def _exact_material(self, exact: Collection[str]) -> bool:
        """Whether texture values are unfiltered: where those who filter them are exact, however they are stored."""
        plan = self.renderer.plan
        everyone = players_of(plan, "material")
        filters = [player for player in everyone if not plan.is_storage(player)]
        return "material" not in plan.missing and self.named(exact) >= frozenset(filters or everyone)

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
