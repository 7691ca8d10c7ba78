"""The results of a comparison in numbers; `results_json` writes and reads them.

The keys of the file `results.json` are these names and stay stable; `SCHEMA` counts up when one changes its meaning or
goes away (new keys may appear).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.shadow_error import ShadowPart

SCHEMA = 1

Metrics = Mapping[str, Measurement]


@dataclass(frozen=True)
class Timing:
    """Time of a pass or of a frame, in milliseconds: the median over `frames` frames and its spread."""

    median: float
    mad: float
    frames: int


@dataclass(frozen=True)
class PassTime:
    """Time of one pass, in milliseconds. `effect` is the effect it belongs to, "" for shared passes."""

    name: str
    effect: str
    median: float
    mad: float


@dataclass(frozen=True)
class Reference:
    """What the reference cost: `spp` samples per pixel in all, in `batches` independent batches; and which truth."""

    spp: int
    batches: int
    seconds: float
    cached: bool
    truth: str = "single"


@dataclass(frozen=True)
class Frame:
    """The whole frame against the reference; `time_ms` is None where nothing was timed (`diff`)."""

    metrics: Metrics
    time_ms: Timing | None = None


@dataclass(frozen=True)
class Effect:
    """One effect against its oracle at the same points.

    Attributes:
        effect: its name, which is also the name of its pair of pictures.
        terms: the terms it approximates.
        knobs: name to value, as used.
        metrics: the effect's own error.
        time_ms: None where the effect has no pass of its own.
        share: metric name to the effect's share of the image's error; empty where not measured.
        bake_ms: what was made once, before the first frame, took; None where nothing was.
        bytes_per_pixel: what the G-buffer's channels that it stores take; None where it stores none.
    """

    effect: str
    terms: tuple[str, ...]
    knobs: Mapping[str, Any] = field(default_factory=dict)
    metrics: Metrics = field(default_factory=dict)
    time_ms: Timing | None = None
    share: Metrics = field(default_factory=dict)
    bake_ms: float | None = None
    bytes_per_pixel: int | None = None


@dataclass(frozen=True)
class Closure:
    """The composition with every term exact, against the reference.

    `bias` is signed, as a fraction of the reference's mean: what the terms leave unexplained.
    """

    metrics: Metrics
    bias: Measurement


@dataclass(frozen=True)
class Player:
    """One approximation's part in the frame's error.

    Attributes:
        name: an effect's name, or that of a term which no effect approximates.
        terms: what becomes exact with it.
        approximated: whether it is an effect; else a term that the frame lacks.
        share: metric ("mse", "flip") to its Shapley share of the frame's error, signed.
        removed: metric to the error that goes away where it alone is made exact, signed.
    """

    name: str
    terms: tuple[str, ...]
    approximated: bool
    share: Metrics
    removed: Metrics


@dataclass(frozen=True)
class Together:
    """Two players whose errors make up for one another.

    Attributes:
        names: of both; one of them alone makes the frame worse where it is made exact.
        removed: metric to the error that goes away where both are made exact, signed.
    """

    names: tuple[str, str]
    removed: Metrics


@dataclass(frozen=True)
class Attribution:
    """How the frame's error is shared out: for each metric total = Σ share + residual.

    Attributes:
        total: metric to the frame's error.
        residual: metric to what is left with everything exact.
        players: in the order they are drawn.
        subsets: how many sets of exact players were evaluated.
        exhaustive: all sets were; else permutations were sampled.
        seconds_per_subset: metric to what one set cost.
        together: pairs of players that are worth making exact together, and not one of them alone.
    """

    total: Metrics
    residual: Metrics
    players: tuple[Player, ...]
    subsets: int
    exhaustive: bool
    seconds_per_subset: Mapping[str, float] = field(default_factory=dict)
    together: tuple[Together, ...] = ()


@dataclass(frozen=True)
class ObjectError:
    """How wrong the pixels of one object are.

    Attributes:
        name: the shape's name; "background" where nothing is seen.
        material: its material's name.
        pixels: how many show it.
        metrics: over those pixels.
        share: of the frame's squared error, 0 to 1 up to noise.
    """

    name: str
    material: str
    pixels: int
    metrics: Metrics
    share: Measurement


@dataclass(frozen=True)
class LightShadow:
    """What kind of mistake a light's shadow makes.

    Attributes:
        effect: which gives it.
        light: the light's name.
        rmse: in radiance, over all pixels.
        parts: "lit" (but should be dark) or "dark" (but should be lit), then the place, to its part of the squared
            error; see `metrics.shadow_error`.
    """

    effect: str
    light: str
    rmse: Measurement
    parts: Mapping[str, Mapping[str, ShadowPart]]


@dataclass(frozen=True)
class RayPart:
    """The pixels whose rays had one fate.

    Attributes:
        pixels: how many.
        share: of the effect's squared error; all parts' add up to 1.
    """

    pixels: int
    share: Measurement


@dataclass(frozen=True)
class RayError:
    """What becomes of the rays of an effect that marches some, and what that costs.

    Attributes:
        effect: which marches them.
        rmse: of the effect, in radiance, over all pixels.
        parts: the rays' fate to its part of the squared error: the verdicts that the effect declares, and "wrong" for
            those that met what they should not.
    """

    effect: str
    rmse: Measurement
    parts: Mapping[str, RayPart]


@dataclass(frozen=True)
class AmbientError:
    """How far an effect for ambient visibility is from one of the truths that it may be held against.

    Attributes:
        effect: which gives the visibility.
        truth: "term": occluded over unoccluded radiance; "occlusion": the open share of directions.
        radius: how far away a direction may be blocked, metres; None: anywhere.
        metrics: in radiance, weighted with the exact unoccluded environment.
    """

    effect: str
    truth: str
    radius: float | None
    metrics: Metrics


@dataclass(frozen=True)
class BounceShare:
    """How much of the light that other surfaces scatter an effect recovers; see `metrics.recovery`.

    Attributes:
        effect: which gives it.
        bounces: how often that light is scattered by other surfaces at most; None: as often as it is.
        share, energy, leaked, missing: pure numbers.
        rmse: in radiance.
    """

    effect: str
    bounces: int | None
    share: Measurement
    energy: Measurement
    leaked: Measurement
    missing: Measurement
    rmse: Measurement


@dataclass(frozen=True)
class LeftOut:
    """Something the scene or the plan holds and the comparison does not, and why."""

    what: str
    why: str


@dataclass(frozen=True)
class NonFinite:
    """Counts of pixels that are NaN or infinite in the tested images.

    Attributes:
        frame: count in the frame.
        effects: effect name to count; effects without any may be missing.
        where: "frame" or an effect's name to the first few positions (x, y), from the top left.
    """

    frame: int = 0
    effects: Mapping[str, int] = field(default_factory=dict)
    where: Mapping[str, tuple[tuple[int, int], ...]] = field(default_factory=dict)

    def total(self) -> int:
        """Count over the frame and all effects."""
        return self.frame + sum(self.effects.values())


@dataclass(frozen=True)
class Finding:
    """Something commonly wrong with a frame that was handed in: it is flipped, shifted, exposed otherwise.

    Attributes:
        fault: "flip", "shift", "field_of_view", "exposure", "transfer", "alpha" or "background".
        words: one sentence with its size.
        size: the size in numbers, by the fault's own names.
        corrected: whether it was corrected, as asked, before anything was measured.
    """

    fault: str
    words: str
    size: Mapping[str, float] = field(default_factory=dict)
    corrected: bool = False


@dataclass(frozen=True)
class LayerError:
    """A buffer that an engine handed in, against the oracle of its term at the same points.

    Attributes:
        layer: as the file names it ("visibility.0"), which is also the end of the name of its pair of pictures.
        term: what it is an approximation of.
        metrics: its own error, in radiance where it is a term of the light transport.
        pixels: over how many.
    """

    layer: str
    term: str
    metrics: Metrics
    pixels: int


@dataclass(frozen=True)
class Candidate:
    """A renderer's frame beside others, all over the same pixels.

    Attributes:
        name: as the user calls it, which is also the name of its pair of pictures; "lightmeter" is our own.
        source: "lightmeter", "file", "command" or "renderer".
        metrics: over `pixels` pixels.
        time_ms: None where nothing is known.
        time_how: who measured the time and what it holds.
        time_whole: whether start-up and loading are within the time, which was measured around the command.
        pixels: how many are compared: those that every engine supports.
        masked: reason to how many pixels are left out for it, of this engine alone.
        findings: what registration found.
        layers: its buffers for single terms.
        attribution: what the layers say of the frame's error; None where they do not make up the frame.
        nonfinite: how many pixels are NaN or infinite.
        engine, device: what made it, in the engine's own words.
        notes: what the reader should know.
        truths: truth to the frame's metrics against it; empty where there was but one.
        follows: the truth that it is surely nearer to; "" where that cannot be told.
    """

    name: str
    source: str
    metrics: Metrics
    time_ms: Timing | None = None
    time_how: str = ""
    time_whole: bool = False
    pixels: int = 0
    masked: Mapping[str, int] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
    layers: tuple[LayerError, ...] = ()
    attribution: Attribution | None = None
    nonfinite: int = 0
    engine: str = ""
    device: str = ""
    notes: tuple[str, ...] = ()
    truths: Mapping[str, Metrics] = field(default_factory=dict)
    follows: str = ""


@dataclass(frozen=True)
class FailedCandidate:
    """A candidate that gave no frame, and why."""

    name: str
    why: str


@dataclass(frozen=True)
class Results:
    """Everything a report says in numbers.

    `size` is (width, height) in pixels. `attribution` shares out the scene-linear image's error, `display_attribution`
    that of the display chain on the exact image, in code values. `candidates` are engines side by side, ours first;
    empty where none was handed in.
    """

    scene: str
    size: tuple[int, int]
    frame: Frame
    device: Mapping[str, Any] = field(default_factory=dict)
    reference: Reference | None = None
    effects: tuple[Effect, ...] = ()
    closure: Closure | None = None
    left_out: tuple[LeftOut, ...] = ()
    nonfinite: NonFinite = NonFinite()
    notes: tuple[str, ...] = ()
    not_approximated: tuple[str, ...] = ()
    passes: tuple[PassTime, ...] = ()
    attribution: Attribution | None = None
    display_attribution: Attribution | None = None
    objects: tuple[ObjectError, ...] = ()
    shadows: tuple[LightShadow, ...] = ()
    rays: tuple[RayError, ...] = ()
    ambient: tuple[AmbientError, ...] = ()
    bounces: tuple[BounceShare, ...] = ()
    candidates: tuple[Candidate, ...] = ()
    failed_candidates: tuple[FailedCandidate, ...] = ()
    schema: int = SCHEMA
