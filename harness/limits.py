"""lightmeter.toml: which limits must hold, for which scenes.

    [defaults]
    size = "256x256"
    spp = 64

    [[limit]]
    scene = "scenes/*.toml"     # a pattern relative to this file, or a library name
    of = "frame"                # or an effect's name
    metric = "flip"
    max = 0.12                  # min for metrics that are better when larger
    set = { shadow_map.resolution = 2048 }

What a limit does not say, `[defaults]` says for it.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, Field, model_validator

from lightmeter import options
from lightmeter.conditions import Conditions, KnobValue
from lightmeter.failures import UsageError
from lightmeter.scenes.files import read_bytes
from lightmeter.scenes.validation import Strict, read_toml

LARGEST = 2**20
"""Bytes of a limits file."""

FRAME = "frame"

Name = Annotated[str, Field(strict=True, min_length=1, max_length=1000)]
Names = tuple[Name, ...]
Bound = Annotated[float, Field(strict=True, allow_inf_nan=False)]


def _size(text: str) -> str:
    options.size(text, "a size")
    return text


class Setting(Strict):
    """How a scene is compared; a limit's own keys go before those of `[defaults]`."""

    size: Annotated[str, AfterValidator(_size)] | None = None
    spp: Annotated[int, Field(strict=True, ge=options.MIN_BATCHES, le=options.MAX_SPP)] | None = None
    seconds: Annotated[float, Field(strict=True, gt=0, le=1e6, allow_inf_nan=False)] | None = None
    seed: Annotated[int, Field(strict=True, ge=0, lt=2**32)] | None = None
    camera: str | Annotated[int, Field(strict=True, ge=0)] | None = None
    only: Names = ()
    without: Names = ()
    use: Names = ()
    set: dict[str, KnobValue | dict[str, KnobValue]] = Field(
        default={}, description='Knobs: {shadow_map.resolution = 2048}, or {"shadow_map.resolution" = 2048}.'
    )

    @model_validator(mode="after")
    def _one_budget(self):
        if self.spp is not None and self.seconds is not None:
            raise ValueError("spp and seconds: give one of them")
        return self


class LimitEntry(Setting):
    """One `[[limit]]`."""

    scene: Name
    of: Name = FRAME
    metric: Name
    max: Bound | None = None
    min: Bound | None = None

    @model_validator(mode="after")
    def _one_bound(self):
        if (self.max is None) == (self.min is None):
            raise ValueError("a limit needs either max or min")
        return self


class LimitsFile(Strict):
    """The whole of lightmeter.toml."""

    defaults: Setting = Setting()
    limit: tuple[LimitEntry, ...] = ()


@dataclass(frozen=True)
class Limit:
    """A bound on one number.

    Attributes:
        place: where it is written, for messages.
        scene: the pattern or name as it is written.
        of: "frame", or an effect's name.
        high, low: the bound; exactly one of them is given.
        variant: what sets its conditions apart from `[defaults]`, in words.
    """

    place: str
    scene: str
    of: str
    metric: str
    high: float | None
    low: float | None
    conditions: Conditions
    variant: str = ""

    @property
    def words(self) -> str:
        """ "flip <= 0.12"."""
        return f"{self.metric} <= {self.high:g}" if self.high is not None else f"{self.metric} >= {self.low:g}"


def read_limits(path: Path) -> list[Limit]:
    """The limits of a file, in its order.

    Raises:
        SceneError, UsageError: it is missing, no TOML, or does not follow the schema; the message names the place.
    """
    file = read_toml(read_bytes(path, LARGEST), LimitsFile, str(path))
    if not file.limit:
        raise UsageError(
            f"{path}: it holds no limit: expected at least one [[limit]] with scene, metric and max or min"
        )
    return [_limit(entry, file.defaults, f"{path}: limit[{index}]") for index, entry in enumerate(file.limit)]


def _limit(entry: LimitEntry, defaults: Setting, place: str) -> Limit:
    usual, conditions = _conditions(defaults, defaults, place), _conditions(entry, defaults, place)
    variant = conditions.beside(usual)
    return Limit(place, entry.scene, entry.of, entry.metric, entry.max, entry.min, conditions, variant)


def _conditions(setting: Setting, defaults: Setting, place: str) -> Conditions:
    """The conditions that a setting asks for, where it says nothing those of the defaults."""

    def said(name: str) -> Any:
        return getattr(setting if name in setting.model_fields_set else defaults, name)

    budgeted = setting if setting.model_fields_set & {"spp", "seconds"} else defaults
    spp = None if budgeted.seconds is not None else budgeted.spp or options.DEFAULT_SPP
    return Conditions(
        size=options.size(said("size") or options.DEFAULT_SIZE),
        budget=options.Budget(spp, budgeted.seconds),
        seed=said("seed") or 0,
        camera=said("camera"),
        only=said("only"),
        without=said("without"),
        use=said("use"),
        settings=tuple(sorted((_knobs(defaults, place) | _knobs(setting, place)).values())),
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
