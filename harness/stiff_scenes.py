"""Both sides of every stiff scene: whether they are finite, how far apart, and what a change of scale changes."""

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from shlex import quote

import numpy as np

from lightmeter.groundtruth.batches import reference
from lightmeter.groundtruth.offset_check import check_offset, is_far
from lightmeter.metrics.bias import bias
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.finite import find_non_finite
from lightmeter.metrics.mse import nrmse, rmse
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, Plan, compile_plan
from lightmeter.realtime.renderer import Capture, Renderer
from lightmeter.reports.stiff_results import NOISY, Finding, StiffPictures, blamed
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.stiff import CASES, PREFIX
from lightmeter.scenes.stiff.case import StiffCase

SPP, BATCHES = 8, 8
See = Callable[[str, StiffPictures], None]


@dataclass(frozen=True, eq=False)
class _Sides:
    plan: Plan
    frame: np.ndarray
    truth: np.ndarray
    capture: Capture | None

    @property
    def mean(self) -> float:
        return float(np.mean(self.truth, dtype=np.float64))


def examine(
    cases: Mapping[str, StiffCase],
    everything: Mapping[str, StiffCase],
    seed: int = 0,
    choice: Choice | None = None,
    words: str = "",
    see: See | None = None,
) -> Iterator[Finding]:
    """Renders every case on both sides.

    Args:
        everything: where the cases that others must look like are found.
        seed: of the references; the same for all, so that a scene and its copy draw the same paths.
        choice: of effects.
        words: seed and choice, as the command line says them.
        see: shown both sides of each.
    """
    device, kept = Device(), {}
    originals = {case.like for case in cases.values()}

    def sides(name: str) -> _Sides:
        if name not in kept:
            captured = name in originals or bool(everything[name].like)
            made = _render(device, everything[name], seed, captured, choice)
            if name not in originals:
                return made
            kept[name] = made
        return kept[name]

    for name, case in cases.items():
        started = time.perf_counter()
        found = Finding(name, case.what, case.size, like=case.like, scale=case.scale)
        try:
            made = sides(name)
        except SceneError as error:
            found = replace(found, words=str(error), refused=True)
        else:
            if see is not None:
                see(name, _pictures(made))
            found = _judge(found, made)
            if found.finite and case.like:
                found = _beside(found, made, sides(case.like))
        again = _commands(name, case, found.refused, words)
        yield replace(found, commands=again, seconds=time.perf_counter() - started)


def _commands(name: str, case: StiffCase, refused: bool, words: str) -> tuple[str, ...]:
    """How it is rendered again; the copies of a scene of the user's own are rendered with it."""
    library = name in CASES
    again = f"lightmeter stress --scenes {quote(name if library else case.like or name)}{words}"
    if refused or (case.like and not library):
        return (again,)
    words += "".join(f" --set {effect}.{knob}={value:g}" for effect, knob, value in case.settings)
    width, height = case.size
    called = quote(PREFIX + name if library else name)
    return again, f"lightmeter compare {called} --size {width}x{height}{words}"


def _render(device: Device, case: StiffCase, seed: int, captured: bool, choice: Choice | None) -> _Sides:
    scene = case.scene()
    plan = compile_plan(scene, effects(), _settled(choice or Choice(), case))
    renderer = Renderer(device, plan, case.size)
    frame = renderer.render().radiance
    capture = renderer.capture() if captured else None
    truth = reference(plan.true_scene, case.size, spp=SPP, batches=BATCHES, seed=seed).batches
    return _Sides(plan, frame, truth, capture)


def _settled(choice: Choice, case: StiffCase) -> Choice:
    """The choice with the case's own settings, where it says nothing else."""
    settings = {effect: dict(knobs) for effect, knobs in choice.settings.items()}
    for effect, knob, value in case.settings:
        settings.setdefault(effect, {}).setdefault(knob, value)
    return replace(choice, settings=settings)


def _judge(found: Finding, made: _Sides) -> Finding:
    """The frame against the reference. A row of the reference that is not finite counts on from batch to batch."""
    whole = {"frame": made.frame, "reference": np.concatenate(list(made.truth))}
    bad = {side: places for side, image in whole.items() if (places := find_non_finite(image))}
    if bad:
        words = [f"{side}: {places}" for side, places in bad.items()]
        return replace(found, finite=False, faults=sum(b.pixels for b in bad.values()), words="; ".join(words))
    words = []
    if is_far(made.plan.true_scene):
        check = check_offset(made.plan.true_scene, found.size)
        words += [] if check.holds else [check.words]
    found = replace(found, doubt="; ".join(words))
    if not made.mean > 0:
        words.append(f"the reference is black, and the frame at most {float(made.frame.max()):.3g}")
        return replace(found, black=True, words="; ".join(words))
    error = nrmse(Comparison(made.frame, made.truth))
    variance = np.var(made.truth, axis=0, ddof=1, dtype=np.float64).mean() / len(made.truth)
    noise = float(np.sqrt(variance)) / made.mean
    if noise > NOISY:
        words.append(f"the reference has not converged: its noise is {100 * noise:.3g} % of its mean")
    return replace(found, error=error.value, low=error.low, high=error.high, noise=noise, words="; ".join(words))


def _beside(found: Finding, made: _Sides, original: _Sides) -> Finding:
    """A scene against the one that it must look like."""
    truth = Comparison(made.truth, original.truth)
    square, shift = rmse(truth), bias(truth)
    lows = [
        value for value in (square.low, shift.low, None if shift.high is None else -shift.high) if value is not None
    ]
    if not original.mean > 0:
        return found
    found = replace(
        found,
        frame_changed=_rms(made.frame, original.frame) / original.mean,
        truth_changed=max(0.0, *lows) / original.mean,
        blame=tuple(_blame(made, original)),
    )
    return found if found.scale == 1 else replace(found, lengths=_lengths(made.plan, found))


def _lengths(plan: Plan, found: Finding) -> tuple[str, ...]:
    """The knobs in metres of what changed: in a scene of another size they mean something else."""
    changed = [(name, *plan.effects[name]) for name, _ in blamed(found) if name in plan.effects]
    return tuple(
        f"{name}.{knob.name} = {values[knob.name]:g} m"
        for name, effect, values in changed
        for knob in effect.knobs
        if knob.unit == "m" and values[knob.name]
    )


def _pictures(made: _Sides) -> StiffPictures:
    """Both sides as they are displayed; what is not finite as NaN."""
    truth = made.truth.mean(axis=0, dtype=np.float64).astype(np.float32)
    with np.errstate(invalid="ignore"):
        difference = np.sqrt(np.mean((made.frame.astype(np.float64) - truth) ** 2, axis=2))
    show = display_transform(made.plan)

    def shown(image: np.ndarray) -> np.ndarray:
        finite = np.isfinite(image)
        return np.where(finite, show(np.where(finite, image, 0)), np.nan)

    return StiffPictures(shown(made.frame), shown(truth), difference / made.mean if made.mean > 0 else None)


def _blame(made: _Sides, original: _Sides) -> Iterator[tuple[str, float]]:
    """What each effect drew, beside what it drew of the original, over that one's mean; the worst first."""
    mine, theirs = made.capture, original.capture
    assert mine is not None
    assert theirs is not None
    changed: dict[str, float] = {}
    for step in original.plan.steps:
        for term in step.writes:
            if step.light is None:
                pair = mine.frame.get(term), theirs.frame.get(term)
            else:
                pair = (getattr(capture, term, {}).get(step.light) for capture in (mine, theirs))
            one, other = pair
            if one is not None and other is not None and np.any(other):
                share = _rms(one, other) / float(np.abs(other).mean(dtype=np.float64))
                changed[step.effect] = max(changed.get(step.effect, 0.0), share)
    yield from sorted(changed.items(), key=lambda item: -item[1])


def _rms(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.sqrt(np.mean((one.astype(np.float64) - other) ** 2)))
