"""Holds limits: every scene is compared once per distinct conditions, and every limit judged by what came out."""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from lightmeter.comparison import Outcome, compare
from lightmeter.conditions import Conditions
from lightmeter.failures import UsageError, user_failures
from lightmeter.groundtruth.store import Store
from lightmeter.hints import nearest
from lightmeter.limit_scenes import find_scenes, same_scene
from lightmeter.limits import FRAME, Limit
from lightmeter.measuring import Question, answer
from lightmeter.metrics.input_error import InputError
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.registry import find_metric
from lightmeter.progress import Report, silent
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, Plan, compile_plan
from lightmeter.reports.junit import Verdict
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene
from lightmeter.sides import Sides
from lightmeter.verdict import explain_verdict, judge


@dataclass(frozen=True, eq=False)
class Task:
    """One comparison, and the limits that it decides.

    Attributes:
        name: the scene as the user names it, with what sets this comparison apart from `[defaults]`; unique.
    """

    name: str
    scene: Scene
    conditions: Conditions
    limits: tuple[Limit, ...]

    @property
    def choice(self) -> Choice:
        """The effects that take part."""
        return _choice(self.conditions)


@dataclass(frozen=True, eq=False)
class Judged:
    """A task's outcome and its limits' verdicts, in the order of `task.limits`."""

    task: Task
    outcome: Outcome
    verdicts: tuple[Verdict, ...]


def plan_tasks(limits: Sequence[Limit], file: Path, asked: Sequence[str] = ()) -> list[Task]:
    """The comparisons that the limits need. Everything is checked here, before anything is rendered.

    Args:
        file: the limits file.
        asked: names or paths of scenes; empty: all that the limits name.

    Raises:
        UsageError: a scene, an effect or a metric does not exist, or a limit cannot be decided; names the place.
    """
    groups: dict[tuple[str, Conditions], list[Limit]] = {}
    for limit in limits:
        _check_metric(limit)
        for source in find_scenes(limit.scene, file, limit.place):
            groups.setdefault((source, limit.conditions), []).append(limit)
    sources = list(dict.fromkeys(source for source, _ in groups))
    for word in asked:
        if not any(same_scene(word, source) for source in sources):
            raise UsageError(f"{file} has no limit for the scene {word!r}; {nearest(word, sources)}")
    chosen = {s for s in sources if not asked or any(same_scene(word, s) for word in asked)}
    return [
        _task(source, conditions, tuple(found)) for (source, conditions), found in groups.items() if source in chosen
    ]


def run_tasks(
    tasks: Sequence[Task],
    store: Store | None = None,
    report: Report = silent,
    say: Callable[[str], None] = lambda _message: None,
) -> Iterator[Judged]:
    """Compare and judge, one task after the other."""
    for done, task in enumerate(tasks):
        report("scenes", done, len(tasks))
        start = time.perf_counter()
        c = task.conditions
        outcome = compare(task.scene, c.size, c.budget, c.seed, task.choice, store=store, report=report, say=say)
        measured = [_measurement(outcome, limit) for limit in task.limits]
        seconds = (time.perf_counter() - start) / len(task.limits)
        pairs = zip(task.limits, measured, strict=True)
        yield Judged(task, outcome, tuple(_verdict(task, limit, m, seconds) for limit, m in pairs))
    report("scenes", len(tasks), len(tasks))


def _verdict(task: Task, limit: Limit, measurement: Measurement, seconds: float) -> Verdict:
    status = judge(limit, measurement)
    return Verdict(
        name=f"{task.name}/{limit.of}/{limit.metric}",
        status=status,
        measurement=measurement,
        limit=limit.words,
        message=explain_verdict(limit, measurement, status),
        seconds=seconds,
    )


def _check_metric(limit: Limit) -> None:
    """The metric exists, and the bound is on its bad side."""
    try:
        metric = find_metric(limit.metric)
    except InputError as error:
        raise UsageError(f"{limit.place}.metric: {error}") from None
    if metric.larger_is_worse and limit.high is None:
        raise UsageError(f"{limit.place}: {metric.name} is worse when larger: expected max, got min")
    if not metric.larger_is_worse and limit.low is None:
        raise UsageError(f"{limit.place}: {metric.name} is better when larger: expected min, got max")
    if metric.signed and limit.high is not None and limit.high < 0:
        raise UsageError(f"{limit.place}: {metric.name} is judged by its magnitude: expected max of 0 or more")


def _task(source: str, conditions: Conditions, limits: tuple[Limit, ...]) -> Task:
    """A task whose limits can all be decided."""
    place = limits[0].place
    try:
        scene = load(source, conditions.camera)
        plan = compile_plan(scene, effects(), _choice(conditions))
    except user_failures() as error:
        raise UsageError(f"{place}: {error}") from None
    for limit in limits:
        _check_target(limit, plan, source)
    variant = limits[0].variant
    return Task(f"{source} [{variant}]" if variant else source, scene, conditions, limits)


def _check_target(limit: Limit, plan: Plan, source: str) -> None:
    """What the limit is on takes part in the scene's frame."""
    if limit.of == FRAME or limit.of in plan.effects:
        return
    known = effects()
    if limit.of not in known:
        raise UsageError(f"{limit.place}.of: there is no effect {limit.of!r}; {nearest(limit.of, [FRAME, *known])}")
    why = next((item.why for item in plan.left_out if item.what == limit.of), "nothing in this frame needs it")
    there = ", ".join([FRAME, *plan.effects])
    raise UsageError(f"{limit.place}.of: {limit.of} takes no part in {source}: {why}; it has: {there}")


def _choice(conditions: Conditions) -> Choice:
    settings: dict[str, dict] = {}
    for effect, knob, value in conditions.settings:
        settings.setdefault(effect, {})[knob] = value
    return Choice(conditions.only, conditions.without, conditions.use, settings)


def _measurement(outcome: Outcome, limit: Limit) -> Measurement:
    """The number that a limit is on: from the results, or measured now."""
    if limit.of == FRAME:
        known = outcome.results.frame.metrics
        sides = Sides([outcome.frame.radiance], outcome.reference)
    else:
        known = next(effect.metrics for effect in outcome.results.effects if effect.effect == limit.of)
        sides = outcome.sides[limit.of]
    if limit.metric in known:
        return known[limit.metric]
    return answer(Question((limit.metric,), sides, bounds=True), outcome.display)[limit.metric]
