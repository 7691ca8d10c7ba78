"""Limits held from Python: `hold` for a scene, `hold_images` for two images. A user's own test needs no file.

verdicts = hold("posts", ["flip <= 0.12", "shadow_map.rmse <= 0.02", "shadow_map.time_ratio to frame <= 0.5"])
assert all(verdict.status == "PASS" for verdict in verdicts)
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from lightmeter import options
from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.gathering import check_all
from lightmeter.conditions import Conditions, KnobValue
from lightmeter.failures import UsageError
from lightmeter.gating import decide
from lightmeter.groundtruth.scattering import SCATTERINGS, SINGLE
from lightmeter.groundtruth.store import Store
from lightmeter.hints import nearest
from lightmeter.image_pair import ImagePair
from lightmeter.limit import FRAME, Limit
from lightmeter.limit_text import FORM, parse_limit
from lightmeter.limits import DEFAULT_SPP
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import find_metric
from lightmeter.planning import check_metric, check_target, make_case
from lightmeter.reports.verdict import Verdict
from lightmeter.scenes.model import Scene
from lightmeter.scenes.optics.color import srgb_encode
from lightmeter.trials import Trial, start_trials
from lightmeter.verdict import bound_of, explain_verdict, judge

Knobs = Mapping[str, Mapping[str, KnobValue]]


def conditions(
    size: str | tuple[int, int] = options.DEFAULT_SIZE,
    spp: int = DEFAULT_SPP,
    seed: int = 0,
    camera: str | int | None = None,
    only: Sequence[str] = (),
    without: Sequence[str] = (),
    use: Sequence[str] = (),
    knobs: Knobs | None = None,
    truth: str = SINGLE,
) -> Conditions:
    """How a scene is judged: the keys of `[defaults]` in lightmeter.toml; `knobs` is its `set`.

    Args:
        size: "128x128", or (width, height).
        spp: samples per pixel at most.
        knobs: {"shadow_map": {"resolution": 256}}.
        truth: "single" or "multiscatter".

    Raises:
        UsageError: the size, the samples or the seed are out of range, there is no such truth, or the knobs have
            another form.
    """
    width, height = options.size(size if isinstance(size, str) else "x".join(map(str, size)), "size")
    if not options.MIN_BATCHES <= spp <= options.MAX_SPP:
        raise UsageError(f"spp: expected {options.MIN_BATCHES} to {options.MAX_SPP}, got {spp}")
    if not 0 <= seed < 1 << 32:
        raise UsageError(f"seed: expected 0 to {(1 << 32) - 1}, got {seed}")
    if truth not in SCATTERINGS:
        raise UsageError(f"truth: there is no {truth!r}; {nearest(truth, SCATTERINGS)}")
    for effect, of in (knobs or {}).items():
        if not isinstance(of, Mapping):
            raise UsageError(f"knobs: expected {{EFFECT: {{KNOB: VALUE}}}}, got {of!r} for {effect!r}")
    settings = sorted((effect, knob, value) for effect, of in (knobs or {}).items() for knob, value in of.items())
    choice = tuple(only), tuple(without), tuple(use), tuple(settings)
    return Conditions((width, height), spp, seed, camera, *choice, truth)


def hold(
    scene: str | Path | Scene,
    limits: Sequence[str | Limit],
    how: Conditions | None = None,
    *,
    seconds: float | None = None,
    confidence: float = options.DEFAULT_CONFIDENCE,
    store: Store | None = None,
    candidate: Candidate | str | Path | None = None,
) -> list[Verdict]:
    """Judge a scene's frame and effects, or another renderer's frame of it.

    Args:
        scene: a library name, a path, or a scene.
        limits: as text (`limit_text.FORM`), or `Limit` objects, which bring their own conditions.
        how: `conditions(…)` for the limits given as text; the usual ones when None.
        seconds: for all limits together; None: until the samples are spent.
        confidence: that no verdict is wrong.
        store: where batches are kept; None: nowhere.
        candidate: the other renderer, or its frame's file; limits are then on its frame and layers. None: ours.

    Returns:
        A verdict for each limit, in their order.

    Raises:
        UsageError: a limit, an effect, a metric or the scene makes no sense.
    """
    trials = hold_trials(scene, limits, how, seconds, confidence, store, candidate)
    return [trial.verdict for trial in trials if trial.verdict]


def hold_trials(
    scene: str | Path | Scene,
    limits: Sequence[str | Limit],
    how: Conditions | None = None,
    seconds: float | None = None,
    confidence: float = options.DEFAULT_CONFIDENCE,
    store: Store | None = None,
    candidate: Candidate | str | Path | None = None,
) -> list[Trial]:
    """As `hold`, with what the verdicts rest on: cases, and images for a report (`gate_pictures.error_maps`)."""
    _check(limits, confidence)
    options.check_seconds(seconds, "seconds")
    source = scene if isinstance(scene, Scene) else str(scene)
    usual = how or conditions()
    other = _candidate(candidate)
    cases = {}
    pairs = []
    for given in limits:
        limit = given if isinstance(given, Limit) else parse_limit(given, usual, str(source))
        if limit.regression is not None:
            raise UsageError(f"{limit.place}: a regression needs a baseline: hold it with `lightmeter gate`")
        limit = replace(limit, candidate=other.name) if other else limit
        check_metric(limit)
        if limit.conditions not in cases:
            cases[limit.conditions] = make_case(source, limit, store, (other,) if other else ())
        check_target(limit, cases[limit.conditions])
        pairs.append((limit, cases[limit.conditions]))
    trials = start_trials(pairs, confidence)
    decide(trials, seconds)
    return trials


def _candidate(given: Candidate | str | Path | None) -> Candidate | None:
    """A candidate that can be asked for a frame."""
    if given is None:
        return None
    found = given if isinstance(given, Candidate) else Candidate(Path(given).name, "file", str(given))
    check_all([found])
    return found


def hold_images(
    tested: ImagePair | np.ndarray,
    reference: np.ndarray | None,
    limits: Sequence[str],
    *,
    confidence: float = options.DEFAULT_CONFIDENCE,
) -> list[Verdict]:
    """Judge an image by another one, or by several batches of it.

    Args:
        tested: (H, W, 3) scene-linear; or a pair that `image_pair.pair` read from two files, and no `reference`.
        reference: (H, W, 3), taken as exact; or (K, H, W, 3), K independent noisy batches of it.
        limits: as text, of the frame. Scene-linear images are clipped and encoded as sRGB for display metrics.

    Returns:
        A verdict for each limit, in their order: of the image as it is, so that one is UNDECIDED only where the
        reference comes as batches.

    Raises:
        UsageError: a limit makes no sense for images.
        InputError: the images cannot be compared.
    """
    _check(limits, confidence)
    return [_image_verdict(tested, reference, text, 1 - (1 - confidence) / len(limits)) for text in limits]


def _check(limits: Sequence[str | Limit], confidence: float) -> None:
    if not limits:
        raise UsageError(f"there is no limit to hold: expected at least one, {FORM}")
    options.check_confidence(confidence, "confidence")


def _image_verdict(tested: ImagePair | np.ndarray, reference: np.ndarray | None, text: str, confidence: float):
    limit = parse_limit(text, conditions(), "images")
    if limit.of != FRAME or limit.is_time or limit.region.words:
        raise UsageError(f"{limit.place}: two images have no effects, times or regions: expected METRIC <= NUMBER")
    check_metric(limit)
    metric, bound = find_metric(limit.metric), bound_of(limit)
    shown = metric.domain == "display"
    options = {}
    if isinstance(tested, ImagePair):
        sides = (tested.tested_shown, tested.reference_shown) if shown else (tested.tested, tested.reference)
    else:
        assert reference is not None
        sides = np.asarray(tested), np.asarray(reference)
        options = {"display": lambda image: srgb_encode(np.clip(image, 0.0, 1.0))} if shown else {}
    two_sided = confidence if bound.magnitude else 1 - 2 * (1 - confidence)
    comparison = Comparison(*sides, confidence=two_sided)
    found = metric.function(comparison, **options)
    status = judge(bound, found)
    unit = "" if "W/sr" in found.unit else found.unit
    return Verdict(
        name=f"images/{FRAME}/{limit.metric}",
        status=status,
        measurement=replace(found, unit=unit),
        limit=limit.words,
        message=explain_verdict(limit, found, status),
        scene="images",
        of=FRAME,
        metric=limit.metric,
        high=limit.high,
        low=limit.low,
        looks=1,
        error=1 - confidence,
        pixels=comparison.width * comparison.height,
        reason="the reference's noise leaves it open" if status == "UNDECIDED" else "",
    )
