"""Error against run time: every setting of an effect measured for both, and the path tracer beside them."""

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.gathering import gather
from lightmeter.candidates.judging import judge
from lightmeter.convergence import convergence
from lightmeter.device import fingerprint
from lightmeter.failures import UsageError
from lightmeter.idle_knobs import needless
from lightmeter.knob_words import Visit, declared, visits
from lightmeter.measuring import Question, answers
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.told_apart import SquaredError, told_apart
from lightmeter.progress import Report, silent
from lightmeter.realtime.baking import Baking
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effect, effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import DISPLAY_TERMS, Choice, Plan, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.realtime.timing import Recording, Time, Times, summarise
from lightmeter.reports import results as outcome
from lightmeter.reports import sweep_results as found
from lightmeter.reports.significant import show_number
from lightmeter.scenes.model import Scene
from lightmeter.sides import Sides, coverage_sides, display_sides, effect_sides
from lightmeter.truth import Truth

ROUNDS, FRAMES, WARM_UP = 4, 5, 3
"""Every setting is timed for `FRAMES` frames in each round, so that what else the machine does in the meantime
falls on all settings alike and does not look like a trend."""
KEPT_BAKING = 1000.0
"""Milliseconds of baking from which on it is kept for the other rounds; less is done again, and needs no memory."""


@dataclass(eq=False)
class Measured:
    """A setting as far as it has been measured.

    Attributes:
        picture: equal for settings whose judged pictures are equal bit for bit.
        squared: by view, what RMSEs are told apart by.
        bakes: milliseconds of every time that the effect baked; none where it bakes nothing.
        baking: what the plan's effects baked, where that is kept.
    """

    effect: str
    plan: Plan
    visit: Visit
    picture: bytes
    errors: Mapping[str, Mapping[str, Measurement]]
    squared: Mapping[str, SquaredError]
    recordings: list[Recording] = field(default_factory=list)
    bakes: list[float] = field(default_factory=list)
    baking: Baking | None = None

    def time(self, renderer: Renderer) -> None:
        """Another round of frames, and what was baked for them."""
        self.recordings.append(renderer.record(FRAMES, WARM_UP, self.effect))
        if renderer.baking is self.baking:
            return
        baked = renderer.baking.milliseconds
        self.bakes += [baked[self.effect]] if self.effect in baked else []
        self.baking = renderer.baking if sum(baked.values()) >= KEPT_BAKING else None


class Sweeping:
    """Measures settings one after the other; what was done so far can be had at any time.

    Args:
        wanted: effect to the settings to measure.
        choice: the current settings, around which the effects are varied.
        truth: reference and oracles.
        curve_seconds: what the path tracer's curve may take.
        report: told of progress.
        candidates: other renderers, whose frames stand beside the settings.
    """

    def __init__(
        self,
        wanted: Mapping[str, Sequence[Visit]],
        choice: Choice,
        truth: Truth,
        curve_seconds: float,
        report: Report = silent,
        candidates: Sequence[Candidate] = (),
    ) -> None:
        self._curve_seconds = curve_seconds
        self._choice, self._truth, self._report = choice, truth, report
        self._device = Device()
        self._plan = compile_plan(truth.scene, effects(), choice)
        # The sweep's one display transform, so that settings and path tracer are seen through the same.
        metered = truth.scene.camera.metering is not None
        frame = self._renderer(self._plan).render().radiance if metered else None
        self._display = display_transform(self._plan, frame)
        self._wanted = [(name, visit) for name, listed in wanted.items() for visit in listed]
        self._measured: dict[str, list[Measured]] = {name: [] for name in wanted}
        self._curve: list[found.CurvePoint] = []
        self._candidates = candidates
        self._others: tuple[found.Other, ...] = ()
        self._of_others: tuple[str, ...] = ()
        self._complete = False

    def run(self) -> None:
        """Measure everything: errors with the first round of times, the other rounds, the path tracer."""
        if self._candidates:
            self._see_others()
        for done, (name, visit) in enumerate(self._wanted):
            self._report("settings", done, len(self._wanted))
            self._measured[name].append(self._measure(name, visit))
        self._report("settings", len(self._wanted), len(self._wanted))
        everything = [item for name in self._measured for item in self._kept(name)]
        total = (ROUNDS - 1) * len(everything)
        for number in range(ROUNDS - 1):
            # Forth and back, so that a steady drift cancels.
            order = everything[:: -1 if number % 2 == 0 else 1]
            for done, item in enumerate(order):
                self._report("times", number * len(everything) + done, total)
                # One renderer at a time: maps of every setting at once may not fit the device's memory.
                item.time(self._renderer(item.plan, item.baking))
        self._report("times", total, total)
        if goal := self._goal():
            for point in convergence(self._truth, self._display, goal, self._curve_seconds, self._report):
                self._curve.append(point)
        self._complete = True

    def _see_others(self) -> None:
        """The candidates' frames, measured as the settings' are."""
        scene, size, batches = self._truth.scene, self._truth.size, self._truth.reference.batches
        gathered = gather(self._candidates, scene, size, self._display, report=self._report)
        shapes = self._renderer(self._plan).capture(terms=False).points.shape
        judged = judge(scene, shapes, batches, gathered.handed)
        measured = answers({one.name: one.question(found.METRICS, batches) for one in judged}, self._display, silent)
        results = [one.result(measured[one.name]) for one in judged]
        self._others = tuple(
            found.Other(one.name, one.time_ms, one.time_how, one.time_whole, one.metrics, one.pixels) for one in results
        )
        self._of_others = tuple(f"{one.name} gave no frame: {one.why}" for one in gathered.failed)
        self._of_others += tuple(f"{one.name}: {one.words}." for one in judged if one.words)

    @property
    def begun(self) -> bool:
        """Whether there is anything to show."""
        return any(self._measured.values())

    def results(self) -> found.Sweep:
        """What was found so far."""
        times = [summarise(item.recordings) for listed in self._measured.values() for item in listed]
        swept = [self._swept(name) for name, listed in self._measured.items() if listed]
        return found.Sweep(
            schema=found.SCHEMA,
            scene=self._truth.scene.name,
            size=self._truth.size,
            device=fingerprint(self._device.renderer, self._device.version),
            reference=self._truth.facts,
            effects=tuple(found.ranked(effect, self._curve) for effect in swept),
            path_tracer=tuple(self._curve),
            notes=(*self._truth.scene.notes, *self._notes(times), *self._of_others),
            complete=self._complete,
            others=self._others,
        )

    def _renderer(self, plan: Plan, baking: Baking | None = None) -> Renderer:
        return Renderer(self._device, plan, self._truth.size, baking)

    def _measure(self, name: str, visit: Visit) -> Measured:
        """Both errors of a setting, and its first round of times."""
        settings = {**self._choice.settings, name: visit.knobs}
        plan = compile_plan(self._truth.scene, effects(), replace(self._choice, settings=settings))
        renderer = self._renderer(plan)
        whole = Sides([renderer.render().radiance], list(self._truth.reference.batches))
        sides = {"effect": self._own_sides(renderer, name), "frame": whole}
        questions = {view: Question(found.METRICS, side) for view, side in sides.items()}
        errors = answers(questions, self._display, silent)
        tested = (image for side in sides.values() for image in side.tested)
        squared = {view: SquaredError.of(Comparison(side.tested, side.truth)) for view, side in sides.items()}
        measured = Measured(name, plan, visit, _digest(tested), errors, squared)
        measured.time(renderer)
        return measured

    def _own_sides(self, renderer: Renderer, name: str) -> Sides:
        terms = renderer.plan.terms_of(name)
        if terms[0] in DISPLAY_TERMS:
            return display_sides(renderer.plan, list(self._truth.reference.batches))[name]
        if terms == ("coverage",) and renderer.plan.effects[name][0].stage == "samples":
            return coverage_sides(renderer, self._truth, silent)
        return effect_sides(renderer, self._truth, silent, only=(name,))[name]

    def _kept(self, name: str) -> list[Measured]:
        """The settings of an effect but for those of which another tells all."""
        listed, idle = self._measured[name], self._idle(name)
        told = {index for indices in idle.values() for index in indices}
        return [item for index, item in enumerate(listed) if index not in told]

    def _idle(self, name: str) -> dict[str, list[int]]:
        listed = self._measured[name]
        return needless([item.visit for item in listed], [item.picture for item in listed])

    def _swept(self, name: str) -> found.SweptEffect:
        idle, kept = self._idle(name), self._kept(name)
        least = {view: _least([item.squared[view] for item in kept]) for view in found.VIEWS}
        return found.SweptEffect(
            effect=name,
            terms=self._plan.terms_of(name),
            own_time="its passes" if has_passes(self._plan, name) else "the whole frame",
            comparable=self._of_light(name),
            settings=tuple(self._setting(item, idle, least) for item in kept),
            idle=tuple(self._idle_knob(name, knob, indices) for knob, indices in idle.items()),
        )

    def _of_light(self, name: str) -> bool:
        """Whether an effect's error is one of radiance, not of code values."""
        declaration = self._plan.effects[name][0]
        return declaration.stage != "display" and not set(declaration.terms) & set(DISPLAY_TERMS)

    def _setting(self, item: Measured, idle: Iterable[str], least: Mapping[str, SquaredError]) -> found.Setting:
        varied, times = item.visit.varied, {"effect": self._own_time(item), "frame": summarise(item.recordings).frame}
        standings = {
            view: found.Standing(
                _timing(times[view]), item.errors[view], as_good=not told_apart(item.squared[view], least[view])
            )
            for view in found.VIEWS
        }
        return found.Setting(
            knobs=dict(item.visit.knobs),
            varied=tuple(knob for knob in varied if knob not in idle) or varied,
            current=item.visit.knobs == self._plan.effects[item.effect][1],
            effect=standings["effect"],
            frame=standings["frame"],
            bake_ms=float(np.median(item.bakes)) if item.bakes else None,
        )

    def _idle_knob(self, name: str, knob: str, indices: Sequence[int]) -> found.IdleKnob:
        items = [self._measured[name][index] for index in indices]
        times = [self._own_time(item).median for item in items]
        values = dict.fromkeys(item.visit.knobs[knob] for item in items)
        return found.IdleKnob(knob, tuple(values), min(times), max(times))

    def _own_time(self, item: Measured) -> Time:
        """Of an effect's passes, or of the frame where it has none."""
        times = summarise(item.recordings)
        own = times.of(item.effect) if has_passes(self._plan, item.effect) else None
        return own or times.frame

    def _goal(self) -> dict[str, float]:
        """The least error that the path tracer's is held against, by metric; empty where none is of radiance."""
        swept = [one for one in map(self._swept, self._measured) if one.comparable]
        standings = [s.standing(view) for one in swept for s in one.settings for view in one.views]
        return {metric: min(s.metrics[metric].value for s in standings) for metric in found.METRICS if standings}

    def _notes(self, times: Sequence[Times]) -> list[str]:
        first = times[0]
        notes = [self._truth.doubt] if self._truth.doubt else []
        notes += [
            f"Times of the real-time renderer are {first.method}, the median of {first.frame.frames} frames in "
            f"{len(next(iter(self._measured.values()))[0].recordings)} rounds over all settings.",
            "On the Pareto front is what is faster than every better setting there by more than the spreads of the two "
            "times together.",
            "An effect's own error is that of the frame if all else were exact (RMSE); FLIP is of its buffer alone.",
        ]
        if any(item.bakes for listed in self._measured.values() for item in listed):
            notes.append(
                "What an effect bakes is made once, before the first frame, and is in no frame's time: wall time with "
                "the compilation of its shaders, once or (where it is short) the median over the rounds."
            )
        notes += sorted({t.doubt for t in times if t.doubt})
        lit = [item for name, listed in self._measured.items() if self._of_light(name) for item in listed]
        floors = [item.errors["frame"]["flip"].floor for item in lit]
        if floors and floors[0] is not None:
            notes.append(
                "FLIP is biased by the reference's noise, for the settings and for the path tracer: between two halves "
                f"of the reference it is {show_number(floors[0])}. Nearer to 0 than that it says little; more samples "
                "(--spp) lower it."
            )
        if self._curve:
            notes.append(
                "The path tracer's times are wall time per image with compiled kernels and a built scene; at few "
                "samples most of it is what launching a kernel from Python takes. Its images are independent of the "
                "reference and of each other."
            )
        return notes


def has_passes(plan: Plan, name: str) -> bool:
    """Whether an effect has passes that can be timed; coverage and texture filtering are in everyone's."""
    return any(step.effect == name for step in plan.steps) or plan.effects[name][0].stage == "radiance"


def plan_visits(
    scene: Scene, choice: Choice, name: str | None, words: Sequence[str], grid: bool = True
) -> dict[str, list[Visit]]:
    """What to measure: one effect's settings, or (`name` None) those of every effect of the frame that has any.

    Args:
        words, grid: what `--knob` was given, and whether that makes a grid, see `knob_words.visits`.

    Raises:
        UsageError: the effect takes no part in the scene's frame, or there is nothing to vary.
        EffectError: an effect, a knob or a value does not exist; names the nearest.
    """
    plan = compile_plan(scene, effects(), choice)
    if name is not None:
        declaration = effect(name)
        if name not in plan.effects:
            raise UsageError(_absent(scene, choice, plan, name))
        return {name: visits(declaration, plan.effects[name][1], words, grid)}
    listed = {name: visits(e, knobs) for name, (e, knobs) in plan.effects.items() if declared(e)}
    if not listed:
        raise UsageError(f"no effect of {scene.name} has a knob to sweep; it has: {', '.join(plan.effects)}")
    return listed


def _absent(scene: Scene, choice: Choice, plan: Plan, name: str) -> str:
    """Why an effect cannot be swept, and what would help."""
    message = f"{name} takes no part in {scene.name}: {plan.why_absent(name)}; it has: {', '.join(plan.effects)}"
    preferred = compile_plan(scene, effects(), replace(choice, use=(name, *choice.use)))
    return message + (f"; `--use {name}` prefers it" if name in preferred.effects else "")


def _least(squared: Sequence[SquaredError]) -> SquaredError:
    """The least that is finite, if any is."""
    return min(squared, key=lambda error: error.value if np.isfinite(error.value) else np.inf)


def _digest(images: Iterable[np.ndarray]) -> bytes:
    """Equal for images that are equal bit for bit."""
    state = hashlib.blake2b(digest_size=16)
    for image in images:
        state.update(np.ascontiguousarray(image))
    return state.digest()


def _timing(time: Time) -> outcome.Timing:
    return outcome.Timing(time.median, time.mad, time.frames)
