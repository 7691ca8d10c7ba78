"""lightmeter.toml: which limits must hold, for which scenes.

    [budget]
    seconds = 300               # for all limits together; none: until the samples are spent
    confidence = 0.999          # that no verdict of the run is wrong

    [defaults]
    size = "256x256"
    spp = 1024                  # samples per pixel at most
    truth = "single"            # or "multiscatter", see groundtruth/scattering.py

    [[limit]]
    scene = "scenes/*.toml"     # a pattern relative to this file, or a library name
    of = "frame"                # or an effect's name
    metric = "flip"
    max = 0.12                  # min for metrics that are better when larger
    set = { shadow_map.resolution = 2048 }

    [[limit]]
    scene = "posts"
    metric = "rmse"
    regression = 0.02           # no worse than the stored baseline by 2 %
    region = { background = false }

    [[limit]]
    scene = "posts"
    of = "shadow_map"
    metric = "time_ratio"
    to = "frame"
    max = 0.6

    [[candidate]]               # another renderer, see candidates/configured.py
    name = "our engine"
    command = "engine {gltf} {camera_json} {w} {h} {exr}"

    [[limit]]
    scene = "posts"
    candidate = "our engine"
    metric = "flip"
    max = 0.2

    [[stress]]                  # on the arithmetic of shading functions, see stress_limits.py
    function = "d_ggx"
    alpha = 0.002               # and up
    metric = "digits"
    min = 3

    [[stress]]                  # on stiff scenes, see stiff_limits.py
    scene = "*"
    metric = "faults"
    max = 0

What a limit does not say, `[defaults]` says for it.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

from pydantic import AfterValidator, Field, model_validator

from lightmeter import options
from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.configured import CandidateEntry
from lightmeter.conditions import Conditions, KnobValue
from lightmeter.failures import UsageError
from lightmeter.groundtruth.scattering import SCATTERINGS, SINGLE
from lightmeter.limit import FRAME, Limit
from lightmeter.regions import EVERYWHERE, Region
from lightmeter.scenes.files import read_bytes
from lightmeter.scenes.validation import Strict, read_toml
from lightmeter.stress_limits import StressEntry

LARGEST = 2**20
"""Bytes of a limits file."""

DEFAULT_SPP = 1024
BASELINE = "lightmeter.baseline.json"

Name = Annotated[str, Field(strict=True, min_length=1, max_length=1000)]
Names = tuple[Name, ...]
Bound = Annotated[float, Field(strict=True, allow_inf_nan=False)]


def _size(text: str) -> str:
    options.size(text, "a size")
    return text


ScatteringName = Literal["single", "multiscatter"]
assert set(get_args(ScatteringName)) == set(SCATTERINGS)


class Setting(Strict):
    """How a scene is judged; a limit's own keys go before those of `[defaults]`."""

    size: Annotated[str, AfterValidator(_size)] | None = None
    spp: Annotated[int, Field(strict=True, ge=options.MIN_BATCHES, le=options.MAX_SPP)] | None = None
    seed: Annotated[int, Field(strict=True, ge=0, lt=2**32)] | None = None
    truth: ScatteringName | None = None
    camera: str | Annotated[int, Field(strict=True, ge=0)] | None = None
    only: Names = ()
    without: Names = ()
    use: Names = ()
    set: dict[str, KnobValue | dict[str, KnobValue]] = Field(
        default={}, description='Knobs: {shadow_map.resolution = 2048}, or {"shadow_map.resolution" = 2048}.'
    )


class RegionEntry(Strict):
    """Where a limit applies: one of the three."""

    background: Annotated[bool, Field(strict=True)] | None = None
    object: Name | Names | None = None
    material: Name | Names | None = None

    @model_validator(mode="after")
    def _one(self):
        if len(self.model_fields_set) != 1:
            raise ValueError("a region is one of background = false, object = NAME and material = NAME")
        if self.background is True or not (self.background is False or self.object or self.material):
            raise ValueError("a region is background = false, or at least one name")
        return self

    @property
    def region(self) -> Region:
        """The region that is meant."""
        kind = next(iter(self.model_fields_set))
        if kind == "background":
            return Region("surfaces")
        names = getattr(self, kind)
        return Region(kind, (names,) if isinstance(names, str) else names)


class LimitEntry(Setting):
    """One `[[limit]]`."""

    scene: Name
    of: Name = FRAME
    metric: Name
    max: Bound | None = None
    min: Bound | None = None
    regression: Annotated[float, Field(strict=True, gt=0, le=10, allow_inf_nan=False)] | None = None
    to: Name | None = None
    device: Name | None = None
    candidate: Name | None = None
    region: RegionEntry | None = None

    @model_validator(mode="after")
    def _one_bound(self):
        if sum(bound is not None for bound in (self.max, self.min, self.regression)) != 1:
            raise ValueError("a limit needs one of max, min and regression: either max or min is a number's bound")
        return self


class BudgetEntry(Strict):
    """What all verdicts together may cost and how sure they must be."""

    seconds: Annotated[float, Field(strict=True, gt=0, le=1e6, allow_inf_nan=False)] | None = None
    confidence: Annotated[float, Field(strict=True, ge=0.5, lt=1, allow_inf_nan=False)] = options.DEFAULT_CONFIDENCE


class LimitsFile(Strict):
    """The whole of lightmeter.toml."""

    baseline: Name = BASELINE
    budget: BudgetEntry = BudgetEntry()
    defaults: Setting = Setting()
    candidate: tuple[CandidateEntry, ...] = ()
    limit: tuple[LimitEntry, ...] = ()
    stress: tuple[StressEntry, ...] = ()


@dataclass(frozen=True)
class Rules:
    """What a limits file says.

    Attributes:
        baseline: the file of stored values.
        seconds: for all verdicts together; None: no limit.
        confidence: that no verdict is wrong.
        candidates: the renderers that limits may be on.
        stress: limits on the arithmetic of shading functions.
    """

    limits: tuple[Limit, ...]
    baseline: Path
    seconds: float | None
    confidence: float
    candidates: tuple[Candidate, ...] = ()
    stress: tuple[StressEntry, ...] = ()


def read_rules(path: Path) -> Rules:
    """What a limits file says, its limits in its order.

    Raises:
        SceneError, UsageError: it is missing, no TOML, or does not follow the schema; the message names the place.
    """
    file = read_toml(read_bytes(path, LARGEST), LimitsFile, str(path))
    if not file.limit and not file.stress:
        raise UsageError(
            f"{path}: it holds no limit: expected at least one [[limit]] with scene, metric and max, min or regression"
        )
    limits = tuple(_limit(entry, file.defaults, f"{path}: limit[{index}]") for index, entry in enumerate(file.limit))
    candidates = tuple(entry.candidate(path.parent) for entry in file.candidate)
    baseline, budget = path.parent / file.baseline, file.budget
    return Rules(limits, baseline, budget.seconds, budget.confidence, candidates, file.stress)


def read_candidates(path: Path) -> tuple[Candidate, ...]:
    """The candidates that a limits file describes, whether it holds limits or not.

    Raises:
        SceneError: it is missing, no TOML, or does not follow the schema; the message names the place.
    """
    file = read_toml(read_bytes(path, LARGEST), LimitsFile, str(path))
    return tuple(entry.candidate(path.parent) for entry in file.candidate)


def _limit(entry: LimitEntry, defaults: Setting, place: str) -> Limit:
    usual, conditions = _conditions(defaults, defaults, place), _conditions(entry, defaults, place)
    return Limit(
        place,
        entry.scene,
        entry.of,
        entry.metric,
        entry.max,
        entry.min,
        conditions,
        conditions.beside(usual),
        entry.regression,
        entry.to,
        entry.device,
        entry.region.region if entry.region else EVERYWHERE,
        entry.candidate,
    )


def _conditions(setting: Setting, defaults: Setting, place: str) -> Conditions:
    """The conditions that a setting asks for, where it says nothing those of the defaults."""

    def said(name: str) -> Any:
        return getattr(setting if name in setting.model_fields_set else defaults, name)

    return Conditions(
        size=options.size(said("size") or options.DEFAULT_SIZE),
        spp=said("spp") or DEFAULT_SPP,
        seed=said("seed") or 0,
        camera=said("camera"),
        only=said("only"),
        without=said("without"),
        use=said("use"),
        settings=tuple(sorted((_knobs(defaults, place) | _knobs(setting, place)).values())),
        scattering=said("truth") or SINGLE,
    )


def _knobs(setting: Setting, place: str) -> dict[tuple[str, str], tuple[str, str, KnobValue]]:
    """Effect and knob to (effect, knob, value)."""
    found: dict[tuple[str, str], tuple[str, str, KnobValue]] = {}
    for key, value in setting.set.items():
        if isinstance(value, dict):
            found |= {(key, knob): (key, knob, inner) for knob, inner in value.items()}
            continue
        effect, dot, knob = key.partition(".")
        if not (effect and dot and knob):
            raise UsageError(f"{place}.set: expected EFFECT.KNOB = VALUE, got the key {key!r}")
        found[effect, knob] = (effect, knob, value)
    return found
