"""The main job: one scene, two renderers, and every approximation against its truth."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from lightmeter.device import fingerprint
from lightmeter.groundtruth.content import points_key
from lightmeter.groundtruth.store import Series, Store
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.finite import find_non_finite
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.mse import RADIANCE
from lightmeter.metrics.registry import measure_all
from lightmeter.options import Budget
from lightmeter.progress import Report, silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform, twin
from lightmeter.realtime.graph import Choice, Plan, Step, compile_plan
from lightmeter.realtime.renderer import Capture, Frame, Renderer, Times
from lightmeter.realtime.timing import Time
from lightmeter.reports import results as outcome
from lightmeter.scenes.model import Scene
from lightmeter.stacking import mean_samples, stack_points
from lightmeter.truth import FAMILIES, ExactBatch, Truth

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
    "flip_hdr",
    "delta_e_2000",
)
EFFECT_METRICS = ("rmse", "nrmse", "relative_bias", "ssim", "flip")
CLOSURE_METRICS = ("rmse", "nrmse")
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


@dataclass(frozen=True, eq=False)
class Outcome:
    """What a comparison found.

    Attributes:
        results: the numbers.
        frame: the real-time frame.
        reference: K batches of the truth.
        sides: effect to what was compared.
        display: the frame's display transform.
    """

    results: outcome.Results
    frame: Frame
    reference: list[np.ndarray]
    sides: dict[str, Sides]
    display: Callable[[np.ndarray], np.ndarray]
    plan: Plan


@dataclass
class _Sums:
    """Batches of an effect's two sides, as they come."""

    tested: list[np.ndarray] = field(default_factory=list)
    truth: list[np.ndarray] = field(default_factory=list)


def compare(
    scene: Scene,
    size: tuple[int, int],
    budget: Budget | None = None,
    seed: int = 0,
    choice: Choice | None = None,
    store: Store | None = None,
    folder: Path | None = None,
    report: Report = silent,
    say: Callable[[str], None] = lambda _message: None,
) -> Outcome:
    """Render both sides and measure.

    Args:
        size: width and height in pixels.
        seed: names the random numbers of the truth.
        store: where batches and oracles are kept; None: nowhere.
        folder: a reference made by `lightmeter reference`, taken as it is.
        report: told of progress.
        say: told of what the user should know.

    Raises:
        EffectError: the choice names what does not exist.
        DeviceError, NoRendererError: a renderer cannot run here.
    """
    plan = compile_plan(scene, effects(), choice)
    device = Device()
    renderer = Renderer(device, plan, size)
    frame = renderer.render()
    report("frame time", 0, 1)
    times = renderer.measure()
    report("frame time", 1, 1)
    truth = Truth(scene, size, budget or Budget(), seed, store=store, folder=folder, report=report, say=say)
    reference = truth.reference
    if reference.reused:
        say(f"reused {reference.reused} of {truth.batches} reference batches")
    display = display_transform(plan)
    sides = _effect_sides(renderer, truth, report)
    sides |= _display_sides(plan, reference.batches)
    closed = closure_batches(renderer, truth, report)

    measured = _Measured(display, report, total=len(sides) + 2)
    results = outcome.Results(
        scene=scene.name,
        size=size,
        device=fingerprint(device.renderer, device.version),
        reference=outcome.Reference(
            reference.spp * truth.batches, truth.batches, reference.seconds, reference.reused == truth.batches
        ),
        frame=outcome.Frame(
            measured.metrics(FRAME_METRICS, Sides([frame.radiance], reference.batches), groups=4), _timing(times.frame)
        ),
        effects=tuple(
            outcome.Effect(
                effect=name,
                terms=plan.effects[name][0].terms,
                knobs=dict(plan.effects[name][1]),
                metrics=measured.metrics(EFFECT_METRICS, sides[name]) if name in sides else {},
                time_ms=_timing(times.of(name)),
            )
            for name in _order(plan)
        ),
        closure=_closure_result(measured, Sides(list(closed), reference.batches)),
        left_out=tuple(outcome.LeftOut(item.what, item.why) for item in plan.left_out),
        nonfinite=_nonfinite(frame, sides),
        notes=scene.notes + _notes(renderer, times),
        not_approximated=plan.not_approximated,
        passes=tuple(outcome.PassTime(name, effect, t.median, t.mad) for name, effect, t in times.passes),
    )
    return Outcome(results, frame, reference.batches, sides, display, plan)


def _order(plan: Plan) -> list[str]:
    """The effects in the order they are drawn; those without a step (coverage, material) last."""
    drawn = dict.fromkeys(step.effect for step in plan.steps)
    return [*drawn, *(name for name in plan.effects if name not in drawn)]


def _effect_sides(renderer: Renderer, truth: Truth, report: Report) -> dict[str, Sides]:
    """Every effect that shades, filters or samples, against its oracle at the frame's own points."""
    plan, offsets = renderer.plan, _some(renderer.offsets)
    captures = [renderer.capture(tuple(offset)) for offset in offsets]
    points = stack_points([capture.points for capture in captures])
    exact_points = truth.exact_material(points)
    spp = max(1, truth.reference.spp // len(offsets))
    shading = {step.effect for step in plan.steps if step.writes[0] not in ("tone", "encode")}
    sums = {name: _Sums() for name in shading}
    material, coverage = plan.effect_of("material"), plan.effect_of("coverage")
    for name in (material, coverage):
        if name is not None:
            sums[name] = _Sums()
    for batch in range(truth.batches):
        report("oracles at the frame's points", batch, truth.batches)
        at_frame = truth.batch(points, batch, "frame", spp)
        for name in shading:
            tested, exact = _contribution(plan, name, captures, at_frame)
            sums[name].tested.append(mean_samples(tested))
            sums[name].truth.append(mean_samples(exact))
        same = exact_points is points
        exact = at_frame if same else truth.batch(exact_points, batch, "exact material", spp)
        if material is not None:
            sums[material].tested.append(at_frame.composition())
            sums[material].truth.append(exact.composition())
        if coverage is not None:
            sums[coverage].tested.append(exact.composition())
    report("oracles at the frame's points", truth.batches, truth.batches)
    if coverage is not None:
        sums[coverage].truth = truth.reference.batches
    return {name: Sides(s.tested, s.truth) for name, s in sums.items()}


def _some(offsets: np.ndarray) -> np.ndarray:
    """At most `MOST_SAMPLES` of the offsets, evenly chosen."""
    if len(offsets) <= MOST_SAMPLES:
        return offsets
    return offsets[np.linspace(0, len(offsets) - 1, MOST_SAMPLES).round().astype(int)]


def _contribution(plan: Plan, name: str, captures: list[Capture], exact: ExactBatch) -> tuple[np.ndarray, np.ndarray]:
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
        elif term == "indirect":
            tested += captured(lambda c: c.frame["indirect"])
            truth += exact.indirect

    for step in plan.steps:
        if step.effect == name:
            for term in step.writes:
                add(step, term)
    return tested.astype(np.float32), truth.astype(np.float32)


def _display_sides(plan: Plan, reference: list[np.ndarray]) -> dict[str, Sides]:
    """Tone and encode against their own oracles, on the reference's mean image."""
    from lightmeter.groundtruth.oracles import encode, tone

    image = np.mean(reference, axis=0, dtype=np.float64) * 2.0**plan.scene.camera.exposure
    found = {}
    shown = np.clip(image, 0.0, 1.0)
    if name := plan.effect_of("tone"):
        shown = twin(plan, "tone")(image, plan.effects[name][1])
        found[name] = Sides([shown.astype(np.float32)], [tone.evaluate(image.astype(np.float32))], "display-linear")
    if name := plan.effect_of("encode"):
        encoded = twin(plan, "encode")(shown, plan.effects[name][1])
        found[name] = Sides([encoded.astype(np.float32)], [encode.evaluate(shown).astype(np.float32)], "display")
    return found


def closure_batches(
    renderer: Renderer,
    truth: Truth,
    report: Report = silent,
    samples: int = MOST_SAMPLES,
    emission_spp: int = 32,
    spp: int | None = None,
) -> np.ndarray:
    """(K, H, W, 3) float32: images with every term exact, each at sub-pixel offsets of its own.

    Args:
        samples: sub-pixel offsets per batch, at most.
        emission_spp: samples per pixel of the control variate: the edge of a bright lamp holds most of what shared
            sub-pixel offsets leave uncertain, and what is seen to emit can be traced by itself.
        spp: the oracles' samples per point and offset; by default they get the reference's, shared by the offsets.
    """
    from lightmeter.groundtruth.oracles import coverage

    count, samples = truth.batches, min(truth.reference.spp, samples)
    spp = spp or max(1, truth.reference.spp // samples)
    # The centre's points stand for the rasteriser: another one, or other shaders, and nothing stale is recalled.
    series = Series.of(
        "closure",
        truth.scene,
        truth.size,
        truth.reference.spp,
        truth.seed,
        samples=(samples, emission_spp, spp),
        points=points_key(renderer.capture(terms=False).points),
    )
    offsets = coverage.evaluate(count, samples, seed=truth.seed + FAMILIES["closure"]) - 0.5

    def make(batch: int) -> np.ndarray:
        places = offsets[batch]
        seen = [renderer.capture(tuple(place), terms=False).points for place in places]
        exact = truth.batch(truth.exact_material(stack_points(seen)), batch, "closure", spp, keep=False)
        return (exact.composition() + truth.emission_variate(places, batch, emission_spp)).astype(np.float32)

    images = []
    for batch in range(count):
        report("closure", batch, count)
        if truth.store is None:
            images.append(make(batch))
        else:
            layers, _ = truth.store.recall(series, f"batch-{batch:04d}", lambda b=batch: {"": make(b)})
            images.append(layers[""])
    report("closure", count, count)
    return np.stack(images)


class _Measured:
    """Computes metrics, and tells how far it is."""

    def __init__(self, display: Callable[[np.ndarray], np.ndarray], report: Report, total: int) -> None:
        self._display, self._report, self._total, self._done = display, report, total, 0

    def metrics(self, names: tuple[str, ...], sides: Sides, groups: int = 0) -> dict[str, Measurement]:
        """The named metrics of two sides; `groups` jackknife replicates correct those that noise biases."""
        tested = sides.tested[0] if len(sides.tested) == 1 else sides.tested
        comparison = Comparison(tested, sides.truth)
        display = self._display if sides.space == "scene-linear" else clipped
        # SSIM's window is 7 pixels wide; a smaller image has none.
        usable = [n for n in names if n != "ssim" or min(comparison.height, comparison.width) >= 7]
        perceptual = {"ssim", "flip", "delta_e_2000"} & set(usable)
        options = {"display": display, "groups": groups} if perceptual else {}
        found = measure_all(usable, comparison, **options)
        if sides.space != "scene-linear":  # a display value is a pure number
            found = {name: replace(m, unit="" if m.unit == RADIANCE else m.unit) for name, m in found.items()}
        self._done += 1
        self._report("metrics", self._done, self._total)
        return found


def clipped(image: np.ndarray) -> np.ndarray:
    return np.clip(image, 0.0, 1.0)


def _closure_result(measured: _Measured, sides: Sides) -> outcome.Closure:
    found = measured.metrics((*CLOSURE_METRICS, "relative_bias"), sides)
    bias = found.pop("relative_bias")
    return outcome.Closure(found, bias)


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


def _notes(renderer: Renderer, times: Times) -> tuple[str, ...]:
    notes = [f"Times are {times.method}, the median of {times.frame.frames} frames."]
    if len(renderer.offsets) > MOST_SAMPLES:
        notes.append(
            f"The frame has {len(renderer.offsets)} samples a pixel; its effects are held against their oracles at "
            f"{MOST_SAMPLES} of them."
        )
    return tuple(notes)
