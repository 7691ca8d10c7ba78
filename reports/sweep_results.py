"""The results of a sweep: what each setting of an effect costs and how wrong it is; its JSON and its CSV.

`to_json` of `reports.results` writes it, by the rules that hold there for numbers that are not finite.
"""

import csv
import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from lightmeter.reports.crossover import Crossover, crossover
from lightmeter.reports.pareto import pareto_front
from lightmeter.reports.results import Metrics, Reference, Timing

SCHEMA = 1
METRICS = ("rmse", "flip")
"""What is measured of every setting: one metric of light and one of what is seen; of both, less is better."""
VIEWS = {"effect": "effect alone", "frame": "whole frame"}
"""What a setting is judged by: its own error beside its own time, or the frame's beside the frame's."""


@dataclass(frozen=True)
class Standing:
    """Error and time of a setting, and how it stands among the others.

    Attributes:
        time_ms: of the effect's passes, or of the frame.
        metrics: the error.
        front: metric to whether the setting is on the Pareto front.
        path_tracer: metric to when the path tracer is as good; without the metrics for which that cannot be said.
        as_good: whether its RMSE cannot be told from the least, by their difference over the same batches.
    """

    time_ms: Timing
    metrics: Metrics
    front: Mapping[str, bool] = field(default_factory=dict)
    path_tracer: Mapping[str, Crossover] = field(default_factory=dict)
    as_good: bool = False


@dataclass(frozen=True)
class Setting:
    """One setting of an effect.

    Attributes:
        knobs: every knob's value.
        varied: the knobs that set it apart from the current setting, or all that a grid varies.
        current: whether it is the setting that the sweep went out from.
        effect, frame: the two views.
        bake_ms: what was made once, before the first frame, took; None where nothing was.
    """

    knobs: Mapping[str, Any]
    varied: tuple[str, ...]
    current: bool
    effect: Standing
    frame: Standing
    bake_ms: float | None = None

    def standing(self, view: str) -> Standing:
        """The standing in one of `VIEWS`."""
        return self.effect if view == "effect" else self.frame

    @property
    def label(self) -> str:
        """What sets it apart: "resolution 512, filter hard"."""
        return _words(self.knobs, self.varied) or "current setting"


@dataclass(frozen=True)
class IdleKnob:
    """A knob of which some values, or all, make no difference to what is judged, bit for bit.

    Attributes:
        values: those that were tried and are not listed among the settings.
        least_ms, most_ms: what the effect took with them.
    """

    knob: str
    values: tuple[Any, ...]
    least_ms: float
    most_ms: float


@dataclass(frozen=True)
class SweptEffect:
    """An effect's settings.

    Attributes:
        effect: its name.
        terms: what it approximates.
        own_time: what its own time is: "its passes", or "the whole frame" where it has none of its own.
        comparable: whether its own error is one of radiance, as the path tracer's is.
        settings: in the order they were asked for.
        idle: knobs and values that were tried and make no difference.
    """

    effect: str
    terms: tuple[str, ...]
    own_time: str
    comparable: bool
    settings: tuple[Setting, ...]
    idle: tuple[IdleKnob, ...] = ()

    @property
    def views(self) -> tuple[str, ...]:
        """Those of `VIEWS` that tell its settings apart: what changes code values changes no light of the frame."""
        return tuple(VIEWS) if self.comparable else ("effect",)

    @property
    def bakes(self) -> bool:
        """Whether anything is made once, before the first frame."""
        return any(setting.bake_ms is not None for setting in self.settings)

    @property
    def here(self) -> str:
        """What the current setting is, where others are told by how they differ: "resolution 1024, bias 0.5"."""
        varied = dict.fromkeys(name for setting in self.settings for name in setting.varied)
        return next((_words(s.knobs, varied) for s in self.settings if s.current and not s.varied), "")


@dataclass(frozen=True)
class CurvePoint:
    """The path tracer at a number of samples per pixel: its time per image, and the image's error."""

    spp: int
    time_ms: Timing
    metrics: Metrics


@dataclass(frozen=True)
class Other:
    """Another renderer's frame, beside which the settings stand.

    Attributes:
        time_ms: None where nothing is known.
        time_how: who measured it.
        time_whole: whether start-up and loading are within.
        metrics: those of `METRICS` that speak of it: of a display image no radiance.
        pixels: over how many.
    """

    name: str
    time_ms: Timing | None
    time_how: str
    time_whole: bool
    metrics: Metrics
    pixels: int


@dataclass(frozen=True)
class Sweep:
    """Everything that a sweep found. `size` is (width, height) in pixels.

    Attributes:
        complete: whether it ran to its end; an interrupted one holds what was done.
        others: candidates.
    """

    schema: int
    scene: str
    size: tuple[int, int]
    device: Mapping[str, Any]
    reference: Reference
    effects: tuple[SweptEffect, ...]
    path_tracer: tuple[CurvePoint, ...]
    notes: tuple[str, ...] = ()
    complete: bool = True
    others: tuple[Other, ...] = ()


def show_knob(value: Any) -> str:
    """A knob's value as it is typed."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _words(knobs: Mapping[str, Any], names: Iterable[str]) -> str:
    return ", ".join(f"{name} {show_knob(knobs[name])}" for name in names)


def ranked(swept: SweptEffect, curve: Sequence[CurvePoint]) -> SweptEffect:
    """The same settings with their place on the front, and when the path tracer is as good."""
    views = {view: [s.standing(view) for s in swept.settings] for view in VIEWS}
    views |= {view: _ranked(views[view]) for view in swept.views}
    if swept.comparable:
        views = {view: [_crossed(standing, curve) for standing in standings] for view, standings in views.items()}
    settings = [
        replace(setting, effect=own, frame=frame)
        for setting, own, frame in zip(swept.settings, views["effect"], views["frame"], strict=True)
    ]
    return replace(swept, settings=tuple(settings))


def best(swept: SweptEffect, view: str, metric: str) -> Setting | None:
    """The setting of the least error; the faster of equals. None where none has a finite one."""
    on_front = [s for s in swept.settings if s.standing(view).front.get(metric)]

    def rank(setting: Setting) -> tuple[float, float]:
        standing = setting.standing(view)
        return standing.metrics[metric].value, standing.time_ms.median

    return min(on_front, key=rank, default=None)


def curve_of(points: Sequence[CurvePoint], metric: str) -> list[tuple[float, float]]:
    """(milliseconds, error) of the path tracer."""
    return [(point.time_ms.median, point.metrics[metric].value) for point in points]


def _ranked(standings: Sequence[Standing]) -> list[Standing]:
    spreads = [s.time_ms.mad for s in standings]
    fronts = {m: pareto_front([(s.time_ms.median, s.metrics[m].value) for s in standings], spreads) for m in METRICS}
    return [
        replace(standing, front={metric: front[index] for metric, front in fronts.items()})
        for index, standing in enumerate(standings)
    ]


def _crossed(standing: Standing, curve: Sequence[CurvePoint]) -> Standing:
    found = {m: crossover(curve_of(curve, m), standing.metrics[m].value) for m in METRICS}
    return replace(standing, path_tracer={metric: c for metric, c in found.items() if c is not None})


def to_csv(sweep: Sweep) -> str:
    """A row per setting, then one per point of the path tracer's curve, which has a frame and no effect.

    Columns are the knobs by name, and `VIEW_…` for both views: milliseconds with their median absolute deviation, and
    for every metric value, interval, whether the setting is on the front, and the path tracer's time with its relation
    ("=", "<=", ">"); and `bake_ms` where something is baked. A cell is empty where there is nothing.
    """
    rows = list(_rows(sweep))
    columns = list(dict.fromkeys(column for row in rows for column in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _rows(sweep: Sweep) -> Iterator[dict[str, Any]]:
    names = list(dict.fromkeys(knob for swept in sweep.effects for s in swept.settings for knob in s.knobs))
    for swept in sweep.effects:
        for setting in swept.settings:
            knobs = {name: show_knob(setting.knobs[name]) if name in setting.knobs else "" for name in names}
            row = {"what": swept.effect, "spp": "", **knobs, "current": int(setting.current)}
            for view in VIEWS:
                standing = setting.standing(view)
                row |= _cells(view, standing.time_ms, standing.metrics, standing)
            yield row if setting.bake_ms is None else row | {"bake_ms": setting.bake_ms}
    for point in sweep.path_tracer:
        yield {"what": "path tracer", "spp": point.spp} | _cells("frame", point.time_ms, point.metrics)
    for other in sweep.others:
        yield {"what": other.name, "spp": ""} | _cells("frame", other.time_ms, other.metrics)


def _cells(view: str, time: Timing | None, metrics: Metrics, standing: Standing | None = None) -> dict[str, Any]:
    cells: dict[str, Any] = {}
    if time is not None:
        cells |= {f"{view}_ms": time.median, f"{view}_ms_mad": time.mad, f"{view}_ms_frames": time.frames}
    for name, m in metrics.items():
        cells |= {f"{view}_{name}": m.value, f"{view}_{name}_low": m.low, f"{view}_{name}_high": m.high}
        if standing is None:
            continue
        cells[f"{view}_{name}_front"] = int(standing.front[name]) if name in standing.front else None
        crossed = standing.path_tracer.get(name)
        cells[f"{view}_{name}_path_tracer_ms"] = crossed.ms if crossed else None
        cells[f"{view}_{name}_path_tracer_relation"] = crossed.relation if crossed else None
    return cells
