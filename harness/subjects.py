"""What limits are judged on: images against a truth that grows by batches, and times that grow by rounds."""

from collections.abc import Callable
from functools import cached_property
from typing import Protocol

import numpy as np

from lightmeter.cases import Case
from lightmeter.limit import FRAME, TIME_RATIO, Limit
from lightmeter.measuring import Display, Question, answer, clipped
from lightmeter.metrics.finite import NonFinite, find_non_finite
from lightmeter.metrics.interval import mean_interval
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.registry import find_metric
from lightmeter.metrics.sequential import (
    Groups,
    effective_count,
    linear_contributions,
    median_interval,
    plan_looks,
    squared_contributions,
)
from lightmeter.realtime.gathering import gathered
from lightmeter.realtime.timing import Recording
from lightmeter.scenes.terms import TERMS
from lightmeter.sides import FramePoints, Sides, contribution, display_sides
from lightmeter.stacking import mean_samples

MOST_BATCHES = 256
"""A first look costs 8 batches: a thirtieth of the samples."""

SQUARED = ("mse", "rmse", "nrmse", "relmse", "psnr")
"""Metrics whose spread the squared error's is; the others of radiance spread as the mean does."""

PARTS = 16
"""Into how many parts a reference is divided where each of them costs a whole image."""

FIRST_ROUNDS, MOST_ROUNDS = 24, 480
"""Rounds of frames: an order statistic at an error of 10⁻⁶ needs 20."""


class Subject(Protocol):
    """Something that several limits may be on, and that is drawn more of until they are decided.

    Attributes:
        looks: the amounts at which to look, in units of its own.
    """

    looks: tuple[int, ...]

    @property
    def samples(self) -> int:
        """Drawn so far: samples per pixel, or frames."""
        ...

    def advance(self, to: int, go_on: Callable[[], bool]) -> bool:
        """Draw up to an amount; False where `go_on` said no before."""
        ...

    def broken(self, limit: Limit) -> NonFinite | None:
        """What is not finite in what is tested, where the limit is; None where that is not known yet."""
        ...

    def doubt(self) -> str:
        """Why nothing can be decided on what is compared with; "" where there is no reason."""
        ...

    def measure(self, limit: Limit, confidence: float) -> Measurement:
        """The limit's number with its interval."""
        ...

    def count(self, limit: Limit) -> float:
        """Effective number of samples that carry the number's spread."""
        ...


class ImageSubject:
    """Images against truth, batch by batch. A batch is small, so that the first look is cheap."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.spp = max(1, case.conditions.spp // MOST_BATCHES)
        self.looks = plan_looks(case.conditions.spp // self.spp)
        self.groups = Groups()

    @property
    def samples(self) -> int:
        return self.groups.batches * self.spp

    def advance(self, to: int, go_on: Callable[[], bool]) -> bool:
        while self.groups.batches < to:
            if not go_on():
                return False
            self.groups.make_room()
            self.groups.add(self.draw(self.groups.drawn, self.groups.size))
        return True

    def draw(self, number: int, size: int) -> np.ndarray:
        """The mean of `size` batches; `number` names their random numbers."""
        raise NotImplementedError

    def sides(self, limit: Limit) -> Sides:
        """What is compared, with what has been drawn so far."""
        raise NotImplementedError

    def display(self, limit: Limit) -> Display:
        """What shows both sides."""
        return self.case.display

    def means(self, limit: Limit) -> Sides:
        """What is compared, each side as one image: for a picture."""
        sides = self.sides(limit)
        tested, truth = (np.mean(side, axis=0, dtype=np.float64) for side in (sides.tested, sides.truth))
        return Sides([tested], [truth], sides.space)

    def broken(self, limit: Limit) -> NonFinite | None:
        """What is not finite inside the limit's region, once a batch is there."""
        if not self.groups.images:
            return None
        return find_non_finite(self.sides(limit).tested[0], self.case.mask(limit))

    def doubt(self) -> str:
        """The truth's own."""
        return self.case.truth.doubt

    def measure(self, limit: Limit, confidence: float) -> Measurement:
        """By the metric's own interval."""
        question = Question((limit.metric,), self.sides(limit), True, self.case.mask(limit), confidence)
        return answer(question, self.display(limit)).get(limit.metric) or Measurement(
            np.nan, how=f"failed: the image is too small for {limit.metric}"
        )

    def count(self, limit: Limit) -> float:
        """Of the squared error's contributions, of the displayed mean's, or of the mean's."""
        sides, mask = self.sides(limit), self.case.mask(limit)
        if find_metric(limit.metric).domain == "display":
            display = self.display(limit) if sides.space == "scene-linear" else clipped
            return effective_count(linear_contributions(_influences(sides.truth, display, mask)))
        tested = sides.tested if len(sides.tested) > 1 else sides.tested * len(sides.truth)
        differences = [_inside(t - r, mask) for t, r in zip(tested, sides.truth, strict=True)]
        linear = limit.metric not in SQUARED
        return effective_count((linear_contributions if linear else squared_contributions)(differences))


class FrameSubject(ImageSubject):
    """The frame against the reference; and the display effects, which are judged on the reference's mean."""

    def draw(self, number: int, size: int) -> np.ndarray:
        return self.case.truth.reference_batch(number, self.spp * size)

    def sides(self, limit: Limit) -> Sides:
        if limit.of != FRAME:
            return display_sides(self.case.plan, self.groups.images)[limit.of]
        return Sides([self.case.frame.radiance], self.groups.images)

    def broken(self, limit: Limit) -> NonFinite | None:
        if limit.of != FRAME:
            return super().broken(limit)
        return find_non_finite(self.case.frame.radiance, self.case.mask(limit))

    def measure(self, limit: Limit, confidence: float) -> Measurement:
        """A display effect's error is a smooth function of the reference's mean: a jackknife over parts of it.

        The interval reaches from the value to the one corrected for bias, and the jackknife's spread beyond both.
        """
        if limit.of == FRAME:
            return super().measure(limit, confidence)
        whole, without = _leave_out(self.groups.images)

        def value(image: np.ndarray) -> Measurement:
            sides = display_sides(self.case.plan, [image])[limit.of]
            question = Question((limit.metric,), sides, mask=self.case.mask(limit), confidence=confidence)
            return answer(question, self.display(limit))[limit.metric]

        found, k = value(whole), len(without)
        left_out = np.array([value(image).value for image in without])
        corrected = k * found.value - (k - 1) * left_out.mean()
        ends = [mean_interval(centre, left_out, confidence) for centre in (found.value, corrected)]
        low, high = min(low for low, _ in ends), max(high for _, high in ends)
        return Measurement(found.value, low, high, found.unit, f"at the reference's mean, jackknife over {k} parts")

    def count(self, limit: Limit) -> float:
        if limit.of == FRAME:
            return super().count(limit)
        return effective_count(
            linear_contributions(_influences(self.groups.images, self.display(limit), self.case.mask(limit)))
        )


class EffectSubject(ImageSubject):
    """One effect's buffer against its oracle at the frame's own points, and only the terms that it needs."""

    def __init__(self, case: Case, effect: str) -> None:
        super().__init__(case)
        self.effect = effect
        self.composed = any(TERMS[term].scope == "gbuffer" for term in case.plan.effects[effect][0].terms)

    @cached_property
    def _at(self) -> FramePoints:
        return FramePoints.of(self.case.renderer, self.case.truth)

    def draw(self, number: int, size: int) -> np.ndarray:
        """(2, H, W, 3): tested and truth."""
        at, spp = self._at, self._at.spp_of(self.spp) * size
        plan = self.case.plan
        if not self.composed:
            terms = plan.terms_of(self.effect)
            exact = at.batch((), number, spp, remember=False, terms=terms)
            both = contribution(plan, self.effect, at.captures, exact)
            return np.stack([mean_samples(image) for image in both])
        everyone = at.variants.everyone
        made = at.batch(everyone, number, spp, remember=False)
        exact = made.composition()
        if self.effect in plan.effects_of("coverage"):
            exact = gathered(plan, made.samples(), at.points)
            return np.stack([exact, self.case.truth.reference_batch(number, self.spp * size)])
        return np.stack([at.without(self.effect, number, spp, remember=False), exact])

    def sides(self, limit: Limit) -> Sides:
        return Sides([both[0] for both in self.groups.images], [both[1] for both in self.groups.images])


class TimeSubject:
    """A frame's times, round by round: the whole frame and every pass, one after the other."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.looks = plan_looks(MOST_ROUNDS, FIRST_ROUNDS)
        self.recordings: list[Recording] = []
        self.samples = 0

    def advance(self, to: int, go_on: Callable[[], bool]) -> bool:
        if not go_on():
            return False
        self.recordings.append(self.case.renderer.record(to - self.samples, 0 if self.recordings else 3))
        self.samples = to
        return True

    def broken(self, limit: Limit) -> NonFinite | None:
        """A time is always finite."""
        return None

    def doubt(self) -> str:
        """A time is compared with times."""
        return ""

    def measure(self, limit: Limit, confidence: float) -> Measurement:
        """The median, of milliseconds or of the ratios of times that were taken in one round."""
        times = self._rounds(limit.of)
        if limit.metric == TIME_RATIO:
            return median_interval(times / self._rounds(limit.to or FRAME), confidence)
        found = median_interval(times, confidence)
        return Measurement(found.value, found.low, found.high, "ms", found.how)

    def count(self, limit: Limit) -> float:
        """Order statistics ask nothing of the tails."""
        return np.inf

    def _rounds(self, of: str) -> np.ndarray:
        return np.concatenate([recording.rounds("" if of == FRAME else of) for recording in self.recordings])


def _inside(image: np.ndarray, mask: np.ndarray | None) -> np.ndarray:
    """(N, 3): the pixels that count."""
    return image.reshape(-1, 3) if mask is None else image[mask]


def _leave_out(images: list[np.ndarray]) -> tuple[np.ndarray, list[np.ndarray]]:
    """The mean of all, and the means without each of at most `PARTS` parts, (H, W, 3) float64."""
    stack = np.stack(images).astype(np.float64)
    total, parts = stack.sum(axis=0), min(PARTS, len(images))
    kept = []
    for start in range(parts):
        part = stack[start::parts]
        kept.append((total - part.sum(axis=0)) / (len(stack) - len(part)))
    return total / len(stack), kept


def _influences(
    images: list[np.ndarray], display: Callable[[np.ndarray], np.ndarray], mask: np.ndarray | None
) -> list[np.ndarray]:
    """What leaving each part out changes in the mean as it is displayed, (N, 3) each."""
    whole, without = _leave_out(images)
    shown = display(whole)
    return [_inside(shown - display(image), mask) for image in without]
