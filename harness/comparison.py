"""The main job: one scene, two renderers, and every approximation against its truth."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lightmeter.absences import remedies, unheard
from lightmeter.ambient_errors import ambient_errors
from lightmeter.attribution import Shares, attribute
from lightmeter.bounce_errors import bounce_errors
from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.gathering import Gathered, gather
from lightmeter.candidates.side_by_side import SideBySide, compare_candidates
from lightmeter.closure import closure_batches
from lightmeter.device import fingerprint
from lightmeter.display_shares import attribute_display
from lightmeter.families import Families, composition
from lightmeter.groundtruth.scattering import SINGLE
from lightmeter.groundtruth.store import Store
from lightmeter.measuring import Question, answers
from lightmeter.metrics.finite import find_non_finite
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.sequential import LEAST_COUNT, effective_count, squared_contributions
from lightmeter.object_errors import object_errors
from lightmeter.options import Budget
from lightmeter.progress import Report, silent
from lightmeter.ray_errors import ray_errors
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, Plan, compile_plan
from lightmeter.realtime.renderer import Frame, Renderer
from lightmeter.realtime.timing import Time, Times
from lightmeter.reports import results as outcome
from lightmeter.scenes.model import Scene
from lightmeter.shadow_errors import shadow_errors
from lightmeter.sides import MOST_SAMPLES, FramePoints, Sides, display_sides, effect_sides
from lightmeter.substitution import players
from lightmeter.truth import Truth

FRAME_METRICS = (
    "rmse",
    "nrmse",
    "relmse",
    "mae",
    "bias",
    "relative_bias",
    "psnr",
    "ssim",
    "flip",
    "rms_p99",
    "rms_worst_tile",
    "flip_p99",
    "flip_worst_tile",
)
COSTLY_METRICS = ("flip_hdr", "delta_e_2000")
"""Of the frame as well, but with their noise floor only: a replicate of these costs a fifth of a second at 512²."""
EFFECT_METRICS = ("rmse", "nrmse", "relative_bias", "ssim", "flip")
CLOSURE_METRICS = ("rmse", "nrmse", "relative_bias")
_FRAME, _COSTLY, _CLOSURE = "the frame", "the frame, costly", "the closure"
"""Names of questions that no effect can have."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """What a comparison found.

    Attributes:
        results: the numbers.
        frame: the real-time frame.
        reference: K batches of the truth.
        sides: effect to what was compared.
        display: the frame's display transform.
        shares: of the frame's error; None where they were not asked for, or the frame is not finite.
        lacking: term that no effect approximates to the image without it and with it, everything else exact.
        others: frames of other renderers.
    """

    results: outcome.Results
    frame: Frame
    reference: list[np.ndarray]
    sides: dict[str, Sides]
    display: Callable[[np.ndarray], np.ndarray]
    plan: Plan
    shares: Shares | None
    lacking: dict[str, Sides]
    others: SideBySide


def compare(
    scene: Scene,
    size: tuple[int, int],
    budget: Budget | None = None,
    seed: int = 0,
    choice: Choice | None = None,
    store: Store | None = None,
    folder: Path | None = None,
    scattering: str = SINGLE,
    against: str | None = None,
    shares: bool = True,
    report: Report = silent,
    say: Callable[[str], None] = lambda _message: None,
    candidates: Sequence[Candidate] = (),
    candidates_folder: Path | None = None,
) -> Outcome:
    """Render both sides and measure.

    Args:
        size: width and height in pixels.
        seed: names the random numbers of the truth.
        store: where batches and oracles are kept; None: nowhere.
        folder: a reference made by `lightmeter reference`, taken as it is.
        scattering: which truth, see `groundtruth.scattering`.
        against: another truth that candidates are held against too; its reference is rendered.
        shares: whether the frame's error is shared out among the effects.
        report: told of progress.
        say: told of what the user should know.
        candidates: other renderers, whose frames are measured beside ours.
        candidates_folder: where what they are given and what they leave is kept; None: nowhere.

    Raises:
        EffectError: the choice names what does not exist.
        DeviceError, NoRendererError: a renderer cannot run here.
        UsageError: no candidate gave a frame, or one does not fit the scene.
    """
    plan = compile_plan(scene, effects(), choice)
    how = {"store": store, "report": report, "say": say}
    truth = Truth(plan.true_scene, size, budget or Budget(), seed, folder=folder, scattering=scattering, **how)
    if folder is not None:
        _ = truth.reference  # one that does not fit is told at once
    device = Device()
    renderer = Renderer(device, plan, size)
    frame = renderer.render()
    display = display_transform(plan, frame.radiance)
    # Before the truth, which may take long: a command that fails is told at once.
    gathered = gather(candidates, scene, size, display, candidates_folder, report) if candidates else Gathered()
    report("frame time", 0, 1)
    times = renderer.measure()
    report("frame time", 1, 1)
    reference = truth.reference
    if reference.reused:
        say(f"reused {reference.reused} of {truth.batches} reference batches")
    at = FramePoints.of(renderer, truth)
    sides = effect_sides(renderer, truth, report, at) | display_sides(plan, reference.batches)
    bad = _nonfinite(frame, sides)
    shared, lacking = None, {}
    if shares and not bad.total():
        families, among = Families(renderer, truth, frame.radiance, at, report), players(plan)
        shared = attribute(among, plan.effects, families, reference.batches, display, report)
        lacking = {name: _lacking(families, tuple(among), name) for name in among if name not in plan.effects}
        closed = composition(families.layers(tuple(among)), tuple(among)).astype(np.float32)
    else:
        closed = closure_batches(renderer, truth, report=report)
    closed = Sides(list(closed), reference.batches)
    whole = Sides([frame.radiance], reference.batches)
    questions = {_COSTLY: Question(COSTLY_METRICS, whole), _FRAME: Question(FRAME_METRICS, whole, bounds=True)}
    questions |= {_CLOSURE: Question(CLOSURE_METRICS, closed)}
    questions |= {name: Question(EFFECT_METRICS, side) for name, side in sides.items()}
    measured = answers(questions, display, report)
    frame_metrics = measured[_FRAME] | measured[_COSTLY]
    ours = frame_metrics, _timing(times.frame), times.method
    other = Truth(scene, size, budget or Budget(), seed, scattering=against, **how) if against else None
    others = compare_candidates(
        gathered, renderer, truth, frame.radiance, ours, display, FRAME_METRICS, shares, report, other
    )
    results = outcome.Results(
        scene=scene.name,
        size=size,
        device=fingerprint(device.renderer, device.version),
        reference=truth.facts,
        frame=outcome.Frame(frame_metrics, _timing(times.frame)),
        effects=tuple(_effect_result(name, renderer, measured[name], times, shared) for name in _order(plan)),
        closure=_closure_result(measured[_CLOSURE]),
        left_out=tuple(outcome.LeftOut(item.what, item.why) for item in plan.left_out),
        nonfinite=bad,
        notes=scene.notes
        + unheard(plan, choice)
        + remedies(plan)
        + ((truth.doubt,) if truth.doubt else ())
        + _notes(renderer, times)
        + others.notes
        + few_carry(frame.radiance, reference.batches),
        not_approximated=plan.not_approximated,
        passes=tuple(outcome.PassTime(name, effect, t.median, t.mad) for name, effect, t in times.passes),
        attribution=shared.attribution if shared else None,
        display_attribution=attribute_display(plan, reference.batches) if shared else None,
        objects=object_errors(
            scene, renderer.capture(terms=False).points.shape, frame.radiance, reference.batches, display
        ),
        shadows=() if bad.total() else shadow_errors(renderer, truth, at),
        rays=() if bad.total() else ray_errors(renderer, truth, at),
        ambient=() if bad.total() else ambient_errors(renderer, truth, at),
        bounces=() if bad.total() else bounce_errors(renderer, truth, at),
        candidates=others.results,
        failed_candidates=gathered.failed,
    )
    return Outcome(results, frame, reference.batches, sides, display, plan, shared, lacking, others)


def _lacking(families: Families, everyone: tuple[str, ...], term: str) -> Sides:
    """The image without a term that no effect gives, and with it; everything else is exact."""
    others = tuple(name for name in everyone if name != term)
    without, with_it = (composition(families.layers(exact), exact) for exact in (others, everyone))
    return Sides([image.astype(np.float32) for image in without], [image.astype(np.float32) for image in with_it])


def _order(plan: Plan) -> list[str]:
    """The effects in the order they are drawn; those without a step (coverage, material) last."""
    drawn = dict.fromkeys(step.effect for step in plan.steps)
    return [*drawn, *(name for name in plan.effects if name not in drawn)]


def _effect_result(
    name: str, renderer: Renderer, measured: dict[str, Measurement], times: Times, shares: Shares | None
) -> outcome.Effect:
    effect, knobs = renderer.plan.effects[name]
    return outcome.Effect(
        effect=name,
        terms=renderer.plan.terms_of(name),
        knobs=dict(knobs),
        metrics=measured,
        time_ms=_timing(times.of(name)),
        bake_ms=renderer.baking.milliseconds.get(name),
        share=_share(shares, name),
        bytes_per_pixel=effect.bytes_per_pixel(knobs),
    )


def _share(shares: Shares | None, effect: str) -> dict[str, Measurement]:
    """An effect's shares; none of a display effect, which acts on the finished image."""
    players = shares.attribution.players if shares else ()
    return next((dict(player.share) for player in players if player.name == effect), {})


def _closure_result(found: dict[str, Measurement]) -> outcome.Closure:
    return outcome.Closure({name: found[name] for name in found if name != "relative_bias"}, found["relative_bias"])


def _timing(time: Time | None) -> outcome.Timing | None:
    return None if time is None else outcome.Timing(time.median, time.mad, time.frames)


def _nonfinite(frame: Frame, sides: dict[str, Sides]) -> outcome.NonFinite:
    found = {name: find_non_finite(side.tested[0]) for name, side in sides.items()}
    whole = find_non_finite(frame.radiance)
    where = {
        name: tuple((column, row) for row, column in item.first)
        for name, item in {"frame": whole, **found}.items()
        if item
    }
    return outcome.NonFinite(whole.pixels, {name: item.pixels for name, item in found.items() if item}, where)


def few_carry(frame: np.ndarray, reference: Sequence[np.ndarray]) -> tuple[str, ...]:
    """A note where few samples carry the spread of the frame's squared error: its interval may be too short then."""
    count = effective_count(squared_contributions([(frame - batch).reshape(-1, 3) for batch in reference]))
    if not count < LEAST_COUNT:
        return ()
    return (
        f"Few samples carry the reference's noise (in effect {count:.0f}): fireflies, and others may not have been "
        "drawn yet. Intervals may be too short; more samples per pixel help.",
    )


def _notes(renderer: Renderer, times: Times) -> tuple[str, ...]:
    notes = [f"Times are {times.method}, the median of {times.frame.frames} frames."]
    notes += [times.doubt] if times.doubt else []
    if len(renderer.offsets) > MOST_SAMPLES:
        notes.append(
            f"The frame has {len(renderer.offsets)} samples a pixel; its effects are held against their oracles at "
            f"{MOST_SAMPLES} of them."
        )
    return tuple(notes)
