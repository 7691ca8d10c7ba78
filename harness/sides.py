"""What each effect made, beside what its oracle says at the same points."""

from collections.abc import Callable, Collection
from dataclasses import dataclass, field

import numpy as np

from lightmeter.display_chain import Chained, display_steps
from lightmeter.exact_batch import ExactBatch
from lightmeter.progress import Report
from lightmeter.realtime.gathering import gathered
from lightmeter.realtime.graph import Plan, Step
from lightmeter.realtime.renderer import Capture, Renderer
from lightmeter.scenes.points import SurfacePoints
from lightmeter.scenes.terms import TERMS
from lightmeter.stacking import mean_samples
from lightmeter.substitution import exact_ratios, slot_image, slots
from lightmeter.truth import Truth
from lightmeter.variants import Seen, Variants

SPACES = {"glare": "scene-linear", "exposure": "scene-linear", "tone": "display-linear", "encode": "display"}
"""What the two sides of a display effect are."""

MOST_SAMPLES = 16
"""Sub-pixel samples at which terms are exact, at most; a frame with more is judged at some of them."""


@dataclass(frozen=True, eq=False)
class Sides:
    """An effect's buffer and its oracle's, at the same points.

    Attributes:
        tested: K images (H, W, 3), or one where the oracle has no part in it.
        truth: K images (H, W, 3).
        space: "scene-linear" or "display".
    """

    tested: list[np.ndarray]
    truth: list[np.ndarray]
    space: str = "scene-linear"


@dataclass
class _Sums:
    """Batches of an effect's two sides, as they come."""

    tested: list[np.ndarray] = field(default_factory=list)
    truth: list[np.ndarray] = field(default_factory=list)


@dataclass(eq=False)
class FramePoints:
    """The frame's own sub-pixel samples, at most `MOST_SAMPLES` of them, in every variant of the G-buffer."""

    variants: Variants
    _seen: dict[frozenset[str], Seen] = field(default_factory=dict)

    @classmethod
    def of(cls, renderer: Renderer, truth: Truth) -> "FramePoints":
        """Of a frame; `truth` is of its true surface."""
        return cls(Variants(renderer, truth))

    def seen(self, exact: Collection[str] = ()) -> Seen:
        """With some players exact; seen once, where they vary the points at all."""
        name = self.variants.named(exact)
        if name not in self._seen:
            self._seen[name] = self.variants.see(name, some_offsets(self.variants.renderer.offsets))
        return self._seen[name]

    @property
    def truth(self) -> Truth:
        """The oracles on the surface that is drawn."""
        return self.seen().truth

    @property
    def captures(self) -> list[Capture]:
        """What the effects gave at each sample."""
        return self.seen().captures

    @property
    def points(self) -> SurfacePoints:
        """(n, H, W), as the G-buffer holds them."""
        return self.seen().points

    @property
    def spp(self) -> int:
        """Samples per point of the oracles: the reference's, shared by the points of a pixel."""
        return self.spp_of(self.variants.truth.reference.spp)

    def spp_of(self, spp: int) -> int:
        """What is left of some samples per pixel for each of its points."""
        return max(1, spp // len(self.captures))

    def batch(
        self, exact: Collection[str], batch: int, spp: int, remember: bool = True, terms: Collection[str] = tuple(TERMS)
    ) -> ExactBatch:
        """One batch of the oracles in a variant, see `Truth.batch`."""
        seen = self.seen(exact)
        return seen.truth.batch(seen.points, batch, seen.family, spp, remember=remember, terms=terms)

    def without(self, name: str, batch: int, spp: int, remember: bool = True) -> np.ndarray:
        """(H, W, 3): one batch of the image with every player exact but one of those that vary the points.

        What that one draws is in it too: its error is that of all its terms together.
        """
        exact, plan = self.variants.everyone - {name}, self.variants.renderer.plan
        made = self.batch(exact, batch, spp, remember)
        if not any(step.effect == name for step in plan.steps):
            return made.composition()
        seen, ratios = self.seen(exact), exact_ratios([made])
        image = mean_samples(seen.points.emission).astype(np.float64)
        for slot in slots(plan):
            others = slot.exact_set([player for player in slot.players if player != name])
            image += slot_image(slot, others, seen.captures, made, ratios)
        return image.astype(np.float32)


def effect_sides(
    renderer: Renderer,
    truth: Truth,
    report: Report,
    at: FramePoints | None = None,
    only: Collection[str] | None = None,
) -> dict[str, Sides]:
    """Every effect that shades, filters or samples, against its oracle at the frame's own points.

    Args:
        at: the frame's points, where the caller has them.
        only: just these effects, and no oracle that they do not need.
    """
    plan, at = renderer.plan, at or FramePoints.of(renderer, truth)
    wanted = set(plan.effects if only is None else only)
    captures, spp = at.captures, at.spp
    drawn = dict.fromkeys(step.effect for step in plan.steps if not step.of_display)
    shading = [name for name in drawn if name in wanted and name not in at.variants.everyone]
    sums = {name: _Sums() for name in shading}
    everyone = at.variants.everyone
    varying = [name for name in plan.effects if name in everyone & wanted]
    coverage = [name for name in plan.effects_of("coverage") if name in wanted]
    sums |= {name: _Sums() for name in (*varying, *coverage)}
    composed, mean = bool(varying or coverage), np.zeros(1)
    terms = tuple(TERMS) if composed else {term for name in shading for term in plan.terms_of(name)}
    for batch in range(truth.batches):
        report("oracles at the frame's points", batch, truth.batches)
        at_frame = at.batch((), batch, spp, terms=terms)
        for name in shading:
            tested, exact = contribution(plan, name, captures, at_frame)
            sums[name].tested.append(mean_samples(tested))
            sums[name].truth.append(mean_samples(exact))
        if not composed:
            continue
        made = at.batch(everyone, batch, spp)
        exact = made.composition()
        for name in varying:
            sums[name].tested.append(at.without(name, batch, spp))
            sums[name].truth.append(exact)
        samples = made.samples()
        mean = mean + samples / truth.batches
        for name in coverage:
            sums[name].tested.append(gathered(plan, samples, at.points))
    report("oracles at the frame's points", truth.batches, truth.batches)
    for name in coverage:
        sums[name].truth = truth.reference.batches
    found = {name: Sides(s.tested, s.truth) for name, s in sums.items()}
    for name in coverage:
        if plan.effects[name][0].stage != "samples":  # not linear, and noise looks like edges to it
            found[name] = Sides([gathered(plan, mean, at.points)], found[name].truth)
    return found | {name: filtered_sides(plan, name, found[name]) for name in coverage if plan.filters_display(name)}


def filtered_sides(plan: Plan, name: str, linear: Sides) -> Sides:
    """What a filter of code values makes of the frame's samples, and the reference, both through the frame's display.

    Neither the display chain nor the filter is linear: both are of the batches' means.

    Args:
        linear: the samples' mean with every term exact, and the reference.
    """
    tested, truth = (Chained(plan, np.mean(side, axis=0, dtype=np.float64)) for side in (linear.tested, linear.truth))
    return Sides([tested.whole(())], [truth.whole({name})], "display")


def coverage_sides(renderer: Renderer, truth: Truth, report: Report) -> Sides:
    """The frame's sub-pixel samples, all of them, with every other term exact, against the reference.

    `effect_sides` takes some of them, which is enough for a picture; a sweep compares numbers of samples.
    """
    variants, offsets, plan = Variants(renderer, truth), renderer.offsets, renderer.plan
    spp = max(1, truth.reference.spp // len(offsets))
    parts = np.array_split(offsets, -(-len(offsets) // MOST_SAMPLES))
    tested = [np.zeros((*truth.size[::-1], 3)) for _ in range(truth.batches)]
    for number, part in enumerate(parts):
        seen = variants.see(variants.everyone, part, terms=False)
        for batch, image in enumerate(tested):
            report("oracles at the frame's points", number * len(tested) + batch, len(parts) * len(tested))
            # Each part has random numbers of its own.
            exact = seen.truth.batch(seen.points, batch * len(parts) + number, seen.family, spp)
            image += gathered(plan, exact.samples(), seen.points) * (len(part) / len(offsets))
    report("oracles at the frame's points", 1, 1)
    return Sides([image.astype(np.float32) for image in tested], list(truth.reference.batches))


def some_offsets(offsets: np.ndarray) -> np.ndarray:
    """At most `MOST_SAMPLES` of the offsets, evenly chosen."""
    if len(offsets) <= MOST_SAMPLES:
        return offsets
    return offsets[np.linspace(0, len(offsets) - 1, MOST_SAMPLES).round().astype(int)]


def contribution(plan: Plan, name: str, captures: list[Capture], exact: ExactBatch) -> tuple[np.ndarray, np.ndarray]:
    """An effect's buffers and its oracles', in radiance, summed over its terms and lights: (n, H, W, 3) each.

    A visibility is weighted with the exact unshadowed radiance: where nothing arrives a wrong shadow costs nothing.
    """
    tested = np.zeros_like(exact.emission, dtype=np.float64)
    truth = np.zeros_like(tested)

    def captured(find: Callable[[Capture], np.ndarray]) -> np.ndarray:
        return np.stack([find(capture) for capture in captures])

    def add(step: Step, term: str) -> None:
        nonlocal tested, truth
        light = step.light
        if term == "direct" and light is not None:
            tested += captured(lambda c: c.direct[light])
            truth += exact.direct[light]
        elif term == "visibility" and light is not None:
            tested += exact.direct[light] * captured(lambda c: c.visibility[light])
            truth += exact.shadowed[light]
        elif term == "environment":
            tested += captured(lambda c: c.frame["environment"])
            truth += exact.environment
        elif term == "environment_visibility":
            tested += exact.environment * captured(lambda c: c.frame["environment_visibility"])
            truth += exact.environment_shadowed
        elif term in ("indirect", "transmission"):
            tested += captured(lambda c: c.frame[term])
            truth += getattr(exact, term)

    for step in plan.steps:
        if step.effect == name:
            for term in step.writes:
                add(step, term)
    return tested.astype(np.float32), truth.astype(np.float32)


def display_sides(plan: Plan, reference: list[np.ndarray]) -> dict[str, Sides]:
    """The display effects against their own oracles, on the reference's mean image.

    What comes before is exact, but that an encoding is given what the frame's tone curve gives. An exposure is shown as
    the image that is too bright by as much as it is.
    """
    chain = Chained(plan, np.mean(reference, axis=0, dtype=np.float64))
    steps, camera, found = display_steps(plan), plan.scene.camera, {}
    for place, step in enumerate(steps):
        (term,) = step.writes
        if term == "coverage":
            continue  # judged at the frame's samples, see `filtered_sides`: this image is filtered already
        exact = {earlier.effect for earlier in steps[:place] if earlier.writes != ("tone",)}
        tested, truth = chain.after(step, exact), chain.after(step, exact | {step.effect})
        if term == "exposure":
            assert camera.metering is not None
            truth = chain.before(step, exact)
            tested = tested / camera.exposure_scale(camera.metering.average(truth))
        found[step.effect] = Sides([tested.astype(np.float32)], [truth.astype(np.float32)], SPACES[term])
    return found
