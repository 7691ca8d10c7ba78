"""Error against run time: every setting of an effect measured for both, and the path tracer beside them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.gathering import gather
from lightmeter.candidates.judging import judge
from lightmeter.convergence import convergence
from lightmeter.device import fingerprint
from lightmeter.failures import UsageError
from lightmeter.knob_words import Visit, declared, visits
from lightmeter.measuring import Question, answers
from lightmeter.metrics.measurement import Measurement
from lightmeter.progress import Report, silent
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


@dataclass(eq=False)
class Measured:
    """A setting as far as it has been measured."""

    plan: Plan
    visit: Visit
    errors: Mapping[str, Mapping[str, Measurement]]
    recordings: list[Recording] = field(default_factory=list)


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
        everything = [item for listed in self._measured.values() for item in listed]
        total = (ROUNDS - 1) * len(everything)
        for number in range(ROUNDS - 1):
            # Forth and back, so that a steady drift cancels.
            order = everything[:: -1 if number % 2 == 0 else 1]
            for done, item in enumerate(order):
                self._report("times", number * len(everything) + done, total)
                # One renderer at a time: maps of every setting at once may not fit the device's memory.
                item.recordings.append(self._renderer(item.plan).record(FRAMES, WARM_UP))
        self._report("times", total, total)
        for point in convergence(self._truth, self._display, self._goal(), self._curve_seconds, self._report):
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
        reference = self._truth.reference
        times = [summarise(item.recordings) for listed in self._measured.values() for item in listed]
        swept = [self._swept(name, listed) for name, listed in self._measured.items() if listed]
        return found.Sweep(
            schema=found.SCHEMA,
            scene=self._truth.scene.name,
            size=self._truth.size,
            device=fingerprint(self._device.renderer, self._device.version),
            reference=outcome.Reference(
                reference.spp * self._truth.batches,
                self._truth.batches,
                reference.seconds,
                reference.reused == self._truth.batches,
                self._truth.scattering,
            ),
            effects=tuple(found.ranked(effect, self._curve) for effect in swept),
            path_tracer=tuple(self._curve),
            notes=(*self._truth.scene.notes, *self._notes(times), *self._of_others),
            complete=self._complete,
            others=self._others,
        )

    def _renderer(self, plan: Plan) -> Renderer:
        return Renderer(self._device, plan, self._truth.size)

    def _measure(self, name: str, visit: Visit) -> Measured:
        """Both errors of a setting, and its first round of times."""
        settings = {**self._choice.settings, name: visit.knobs}
        plan = compile_plan(self._truth.scene, effects(), replace(self._choice, settings=settings))
        renderer = self._renderer(plan)
        whole = Sides([renderer.render().radiance], list(self._truth.reference.batches))
        sides = {"effect": self._own_sides(renderer, name), "frame": whole}
        questions = {view: Question(found.METRICS, side) for view, side in sides.items()}
        errors = answers(questions, self._display, silent)
        return Measured(plan, visit, errors, [renderer.record(FRAMES, WARM_UP)])

    def _own_sides(self, renderer: Renderer, name: str) -> Sides:
        terms = renderer.plan.terms_of(name)
        if terms[0] in DISPLAY_TERMS:
            return display_sides(renderer.plan, list(self._truth.reference.batches))[name]
        if terms == ("coverage",) and renderer.plan.effects[name][0].stage == "samples":
            return coverage_sides(renderer, self._truth, silent)
        return effect_sides(renderer, self._truth, silent, only=(name,))[name]

    def _swept(self, name: str, listed: Sequence[Measured]) -> found.SweptEffect:
        declaration = self._plan.effects[name][0]
        passes = has_passes(self._plan, name)
        return found.SweptEffect(
            effect=name,
            terms=self._plan.terms_of(name),
            own_time="its passes" if passes else "the whole frame",
            comparable=declaration.stage != "display" and not set(declaration.terms) & set(DISPLAY_TERMS),
            settings=tuple(self._setting(name, item, passes) for item in listed),
        )

    def _setting(self, name: str, item: Measured, passes: bool) -> found.Setting:
        times = summarise(item.recordings)
        own = times.of(name) if passes else times.frame
        return found.Setting(
            knobs=dict(item.visit.knobs),
            varied=item.visit.varied,
            current=item.visit.knobs == self._plan.effects[name][1],
            effect=found.Standing(_timing(own), item.errors["effect"]),
            frame=found.Standing(_timing(times.frame), item.errors["frame"]),
        )

    def _goal(self) -> dict[str, float]:
        """The least error that the path tracer's is held against, by metric."""
        standings = [
            setting.standing(view)
            for name, listed in self._measured.items()
            for swept in [self._swept(name, listed)]
            for setting in swept.settings
            for view in found.VIEWS
            if swept.comparable or view == "frame"
        ]
        return {metric: min(s.metrics[metric].value for s in standings) for metric in found.METRICS}

    def _notes(self, times: Sequence[Times]) -> list[str]:
        first = times[0]
        notes = [
            f"Times of the real-time renderer are {first.method}, the median of {first.frame.frames} frames in "
            f"{len(next(iter(self._measured.values()))[0].recordings)} rounds over all settings.",
            "An effect's own error is that of the frame if all else were exact (RMSE); FLIP is of its buffer alone.",
        ]
        notes += sorted({t.doubt for t in times if t.doubt})
        floors = [e["frame"]["flip"].floor for listed in self._measured.values() for e in (m.errors for m in listed)]
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


def plan_visits(scene: Scene, choice: Choice, name: str | None, words: Sequence[str]) -> dict[str, list[Visit]]:
    """What to measure: one effect's settings, or (`name` None) those of every effect of the frame that has any.

    Args:
        words: what `--knob` was given, see `knob_words.visits`.

    Raises:
        UsageError: the effect takes no part in the scene's frame, or there is nothing to vary.
        EffectError: an effect, a knob or a value does not exist; names the nearest.
    """
    plan = compile_plan(scene, effects(), choice)
    if name is not None:
        declaration = effect(name)
        if name not in plan.effects:
            raise UsageError(_absent(scene, choice, plan, name))
        return {name: visits(declaration, plan.effects[name][1], words)}
    listed = {name: visits(e, knobs) for name, (e, knobs) in plan.effects.items() if declared(e)}
    if not listed:
        raise UsageError(f"no effect of {scene.name} has a knob to sweep; it has: {', '.join(plan.effects)}")
    return listed


def _absent(scene: Scene, choice: Choice, plan: Plan, name: str) -> str:
    """Why an effect cannot be swept, and what would help."""
    message = f"{name} takes no part in {scene.name}: {plan.why_absent(name)}; it has: {', '.join(plan.effects)}"
    preferred = compile_plan(scene, effects(), replace(choice, use=(name, *choice.use)))
    return message + (f"; `--use {name}` prefers it" if name in preferred.effects else "")


def _timing(time: Time | None) -> outcome.Timing:
    assert time is not None
    return outcome.Timing(time.median, time.mad, time.frames)
