"""Which cases limits are on, and whether they can be decided at all. Nothing is rendered here."""

from collections.abc import Sequence
from functools import cache
from pathlib import Path

from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.layer_names import LAYERS, find_layers
from lightmeter.cases import Case, choice_of
from lightmeter.conditions import Conditions
from lightmeter.device import Fingerprint, device_digest, fingerprint
from lightmeter.failures import UsageError, user_failures
from lightmeter.groundtruth.store import Store
from lightmeter.hints import nearest
from lightmeter.limit import FRAME, MASKED, TIME_RATIO, TIMES, Limit
from lightmeter.limit_scenes import find_scenes, same_scene
from lightmeter.metrics.input_error import InputError
from lightmeter.metrics.registry import METRICS, find_metric
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Plan, compile_plan
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene


def plan_cases(
    limits: Sequence[Limit],
    file: Path,
    asked: Sequence[str] = (),
    store: Store | None = None,
    candidates: Sequence[Candidate] = (),
) -> list[tuple[Limit, Case]]:
    """Every limit with the case it is on. Everything is checked here, before anything is rendered.

    Args:
        file: the limits file.
        asked: names or paths of scenes; empty: all that the limits name.
        candidates: the other renderers that limits may be on.

    Returns:
        A list of (limit, case); limits under the same conditions share a case.

    Raises:
        UsageError: a scene, an effect or a metric does not exist, or a limit cannot be decided; names the place.
    """
    found: list[tuple[str, Limit]] = []
    for limit in limits:
        check_metric(limit)
        found += [(source, limit) for source in find_scenes(limit.scene, file, limit.place)]
    sources = list(dict.fromkeys(source for source, _ in found))
    for word in asked:
        if not any(same_scene(word, source) for source in sources):
            raise UsageError(f"{file} has no limit for the scene {word!r}; {nearest(word, sources)}")
    chosen = {s for s in sources if not asked or any(same_scene(word, s) for word in asked)}
    cases: dict[tuple[str, Conditions], Case] = {}
    pairs = []
    for source, limit in found:
        if source in chosen:
            key = source, limit.conditions
            if key not in cases:
                cases[key] = make_case(source, limit, store, candidates)
            check_target(limit, cases[key])
            pairs.append((limit, cases[key]))
    return pairs


def make_case(source: str | Scene, limit: Limit, store: Store | None, candidates: Sequence[Candidate] = ()) -> Case:
    """The case of a limit on a scene.

    Raises:
        UsageError: the scene cannot be read, or the choice of effects makes no sense.
    """
    conditions = limit.conditions
    try:
        scene = source if isinstance(source, Scene) else load(source, conditions.camera)
        plan = compile_plan(scene, effects(), choice_of(conditions))
    except user_failures() as error:
        raise UsageError(f"{limit.place}: {error}") from None
    name = scene.name if isinstance(source, Scene) else source
    name = f"{name} [{limit.variant}]" if limit.variant else name
    return Case(name, scene, conditions, plan, shared_device, store, candidates)


@cache
def shared_device() -> Device:
    """One context serves every case."""
    return Device()


@cache
def this_device() -> Fingerprint:
    """The fingerprint of the machine, with its GL."""
    device = shared_device()
    return fingerprint(device.renderer, device.version)


def check_metric(limit: Limit) -> None:
    """The metric exists, and the bound is on its bad side.

    Raises:
        UsageError: it does not, or is not.
    """
    if limit.is_time:
        _check_time(limit)
        return
    if limit.metric == MASKED:
        _check_masked(limit)
        return
    for key in ("to", "device"):
        if getattr(limit, key) is not None:
            raise UsageError(f"{limit.place}.{key}: it is for {' and '.join(TIMES)}, and the metric is {limit.metric}")
    if limit.metric not in METRICS and limit.metric.startswith("time"):
        raise UsageError(f"{limit.place}.metric: there is no metric {limit.metric!r}; {nearest(limit.metric, TIMES)}")
    try:
        metric = find_metric(limit.metric)
    except InputError as error:
        raise UsageError(f"{limit.place}.metric: {error}") from None
    if metric.larger_is_worse and limit.low is not None:
        raise UsageError(f"{limit.place}: {metric.name} is worse when larger: expected max, got min")
    if not metric.larger_is_worse and limit.high is not None:
        raise UsageError(f"{limit.place}: {metric.name} is better when larger: expected min, got max")
    if metric.signed and limit.high is not None and limit.high < 0:
        raise UsageError(f"{limit.place}: {metric.name} is judged by its magnitude: expected max of 0 or more")


def _check_masked(limit: Limit) -> None:
    if limit.candidate is None:
        raise UsageError(f"{limit.place}: {MASKED} is of a candidate: expected candidate = NAME")
    if limit.high is None or limit.region.words or limit.of != FRAME:
        raise UsageError(f"{limit.place}: {MASKED} is a fraction of the whole frame: expected max alone, 0 to 1")


def _check_time(limit: Limit) -> None:
    if limit.candidate is not None:
        raise UsageError(
            f"{limit.place}.candidate: times of other renderers are reported by `compare`, and not limited here"
        )
    if limit.region.words:
        raise UsageError(f"{limit.place}.region: a time has no region")
    if limit.regression is not None:
        raise UsageError(
            f"{limit.place}.regression: times of other runs are not comparable; limit a time_ratio with max"
        )
    if limit.metric == TIME_RATIO:
        if limit.device is not None:
            raise UsageError(f"{limit.place}.device: a ratio of times holds on every device; leave it out")
        if limit.of == FRAME:
            raise UsageError(f"{limit.place}.of: a time_ratio is an effect's, got {FRAME!r}")
        if limit.of == (limit.to or FRAME):
            raise UsageError(f"{limit.place}.to: expected {FRAME!r} or another effect, got {limit.to!r} itself")
        return
    if limit.to is not None:
        raise UsageError(f"{limit.place}.to: it is for time_ratio, and the metric is {limit.metric}")
    if limit.device is None:
        raise UsageError(
            f"{limit.place}: milliseconds hold on one device only: expected device = DIGEST of the one it is written "
            f'for; this machine\'s is device = "{device_digest(this_device())}". A time_ratio holds everywhere'
        )


def check_target(limit: Limit, case: Case) -> None:
    """What the limit is on takes part in the scene's frame, and its region is there.

    Raises:
        UsageError: it does not, or is not.
    """
    if limit.candidate is not None:
        _check_candidate(limit, case)
    else:
        _check_effect(limit, limit.of, "of", case)
    if limit.metric == TIME_RATIO:
        _check_effect(limit, limit.to or FRAME, "to", case)
    limit.region.check(case.scene, limit.place)


def _check_candidate(limit: Limit, case: Case) -> None:
    if limit.candidate not in case.candidates:
        hint = nearest(str(limit.candidate), case.candidates)
        raise UsageError(f"{limit.place}.candidate: there is no candidate {limit.candidate!r}; {hint}")
    layers, others = find_layers([limit.of])
    if limit.of != FRAME and (others or not LAYERS[layers[0].kind].term):
        known = [FRAME, *(name for name, layer in LAYERS.items() if layer.term)]
        raise UsageError(f"{limit.place}.of: a candidate has no {limit.of!r} to judge; {nearest(limit.of, known)}")


def _check_effect(limit: Limit, name: str, key: str, case: Case) -> None:
    plan: Plan = case.plan
    if name == FRAME:
        return
    known = effects()
    if name not in known:
        raise UsageError(f"{limit.place}.{key}: there is no effect {name!r}; {nearest(name, [FRAME, *known])}")
    if name not in plan.effects:
        why, there = plan.why_absent(name), ", ".join([FRAME, *plan.effects])
        raise UsageError(f"{limit.place}.{key}: {name} takes no part in {case.name}: {why}; it has: {there}")
    if limit.is_time and name != plan.sampler and not any(step.effect == name for step in plan.steps):
        raise UsageError(f"{limit.place}.{key}: {name} draws no pass of its own, so that it has no time")
    if not limit.is_time and plan.effects[name][0].stage != "samples":
        raise UsageError(
            f"{limit.place}.{key}: {name} does not filter linearly, so that its error is told at the mean of all "
            f"batches and has no interval to decide by; `lightmeter compare {case.name}` tells it"
        )
