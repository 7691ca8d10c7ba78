"""Both sides of every stiff scene: whether they are finite, how far apart, and what a change of scale changes."""

import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from lightmeter.groundtruth.batches import reference
from lightmeter.groundtruth.offset_check import check_offset, is_far
from lightmeter.metrics.bias import bias
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.finite import find_non_finite
from lightmeter.metrics.mse import rmse
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Plan, compile_plan
from lightmeter.realtime.renderer import Capture, Renderer
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.stiff.case import StiffCase

SPP, BATCHES = 8, 8
NOISY = 0.1
"""Of the mean: beyond it an error of a tenth of the mean is lost in noise. The plain scene has 4 %."""


@dataclass(frozen=True)
class Finding:
    """What became of a stiff scene. Every figure is over the mean of the reference, and None where it has no meaning.

    Attributes:
        error: RMS of the frame less the reference, its noise taken out.
        noise: RMS standard error of the reference's mean: what slow convergence looks like.
        frame_changed: RMS of the frame less that of the scene it must look like.
        truth_changed: the same of the reference: what of it is not noise, at 95 %.
        blame: effects (or "gbuffer"), the worst first, with the share by which what they drew changed.
        words: what is not finite, refused, or not to be trusted, and why; "" where all is well.
        finite: whether both images are; True where the scene is refused.
    """

    name: str
    what: str
    size: tuple[int, int]
    error: float | None = None
    noise: float | None = None
    frame_changed: float | None = None
    truth_changed: float | None = None
    blame: tuple[tuple[str, float], ...] = ()
    words: str = ""
    refused: bool = False
    finite: bool = True
    seconds: float = 0.0


@dataclass(frozen=True, eq=False)
class _Sides:
    plan: Plan
    frame: np.ndarray
    truth: np.ndarray
    capture: Capture | None

    @property
    def mean(self) -> float:
        return float(np.mean(self.truth, dtype=np.float64))


def examine(cases: Mapping[str, StiffCase], everything: Mapping[str, StiffCase], seed: int = 0) -> Iterator[Finding]:
    """Renders every case on both sides.

    Args:
        everything: where the cases that others must look like are found.
        seed: of the references; the same for all, so that a scene and its copy draw the same paths.
    """
    device, kept = Device(), {}
    originals = {case.like for case in cases.values()}

    def sides(name: str) -> _Sides:
        if name not in kept:
            made = _render(device, everything[name], seed, name in originals or bool(everything[name].like))
            if name not in originals:
                return made
            kept[name] = made
        return kept[name]

    for name, case in cases.items():
        started = time.perf_counter()
        found = Finding(name, case.what, case.size)
        try:
            made = sides(name)
        except SceneError as error:
            found = replace(found, words=str(error), refused=True)
        else:
            found = _judge(found, made)
            if found.finite and case.like:
                found = _beside(found, made, sides(case.like))
        yield replace(found, seconds=time.perf_counter() - started)


def _render(device: Device, case: StiffCase, seed: int, captured: bool) -> _Sides:
    scene = case.scene()
    plan = compile_plan(scene, effects())
    renderer = Renderer(device, plan, case.size)
    frame = renderer.render().radiance
    capture = renderer.capture() if captured else None
    truth = reference(plan.true_scene, case.size, spp=SPP, batches=BATCHES, seed=seed).batches
    return _Sides(plan, frame, truth, capture)


def _judge(found: Finding, made: _Sides) -> Finding:
    """The frame against the reference. A row of the reference that is not finite counts on from batch to batch."""
    whole = {"frame": made.frame, "reference": np.concatenate(list(made.truth))}
    words = [f"{side}: {bad}" for side, image in whole.items() if (bad := find_non_finite(image))]
    if words:
        return replace(found, finite=False, words="; ".join(words))
    if is_far(made.plan.true_scene):
        check = check_offset(made.plan.true_scene, found.size)
        words += [] if check.holds else [check.words]
    if not made.mean > 0:
        words.append(f"the reference is black, and the frame at most {float(made.frame.max()):.3g}")
        return replace(found, words="; ".join(words))
    error = rmse(Comparison(made.frame, made.truth)).value / made.mean
    variance = np.var(made.truth, axis=0, ddof=1, dtype=np.float64).mean() / len(made.truth)
    noise = float(np.sqrt(variance)) / made.mean
    if noise > NOISY:
        words.append(f"the reference has not converged: its noise is {100 * noise:.3g} % of its mean")
    return replace(found, error=error, noise=noise, words="; ".join(words))


def _beside(found: Finding, made: _Sides, original: _Sides) -> Finding:
    """A scene against the one that it must look like."""
    truth = Comparison(made.truth, original.truth)
    square, shift = rmse(truth), bias(truth)
    lows = [
        value for value in (square.low, shift.low, None if shift.high is None else -shift.high) if value is not None
    ]
    return replace(
        found,
        frame_changed=_rms(made.frame, original.frame) / original.mean,
        truth_changed=max(0.0, *lows) / original.mean,
        blame=tuple(_blame(made, original)),
    )


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
