"""The results as JSON: the file `results.json` that other tools read.

The file is strict JSON (RFC 8259), which has no way to write a number that is not finite. So:

- a number that is not finite is written as the string "NaN", "Infinity" or "-Infinity". A reader that does
  arithmetic stops there, which is the point: a NaN is a failure and must not pass as a number;
- `null` means "there is none": no interval, no time, no closure.

Reading turns the three strings back into floats in every field that is a number. Knobs, device entries and
notes are kept as they stand.
"""

import json
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, TypeVar

from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.shadow_error import ShadowPart
from lightmeter.reports.one_step import write_text
from lightmeter.reports.results import (
    SCHEMA,
    AmbientError,
    Attribution,
    BounceShare,
    Candidate,
    Closure,
    Effect,
    FailedCandidate,
    Finding,
    Frame,
    LayerError,
    LeftOut,
    LightShadow,
    NonFinite,
    ObjectError,
    PassTime,
    Player,
    RayError,
    RayPart,
    Reference,
    Results,
    Timing,
    Together,
)

_NONFINITE = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}

T = TypeVar("T")


class ResultsError(ValueError):
    """A results document that cannot be read; the message says where, what was expected and what was found."""


def to_json(results: Any) -> str:
    """A `Results`, or another dataclass of numbers, as strict JSON text.

    UTF-8, keys in the order of the classes, with a final line break.
    """
    return json.dumps(_plain(results), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def write_json(path: str | os.PathLike[str], results: Any) -> Path:
    """Write `to_json(results)` in one step."""
    return write_text(path, to_json(results))


def from_json(text: str) -> Results:
    """The results that `to_json` wrote.

    Raises:
        ResultsError: text that is not strict JSON, another schema, or a key that is missing or of a wrong type.
    """
    try:
        document = json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        raise ResultsError(f"results: not JSON at line {error.lineno}, column {error.colno}: {error.msg}") from None
    top = _Node(document, "results")
    schema = top.get("schema").integer()
    if schema != SCHEMA:
        raise ResultsError(
            f"results.schema: expected {SCHEMA}, found {schema}: made by another version of lightmeter; "
            "make the results again with this one"
        )
    width, height = (item.integer() for item in top.get("size").items(2))
    return Results(
        scene=top.get("scene").text(),
        size=(width, height),
        frame=_frame(top.get("frame")),
        device=top.get("device").mapping(),
        reference=top.get("reference").maybe(_reference),
        effects=tuple(_effect(item) for item in top.get("effects").items()),
        closure=top.get("closure").maybe(_closure),
        left_out=tuple(
            LeftOut(item.get("what").text(), item.get("why").text()) for item in top.get("left_out").items()
        ),
        nonfinite=_nonfinite(top.get("nonfinite")),
        notes=top.get("notes", []).texts(),
        not_approximated=top.get("not_approximated", []).texts(),
        passes=tuple(_pass_time(item) for item in top.get("passes", []).items()),
        attribution=top.get("attribution", None).maybe(_attribution),
        display_attribution=top.get("display_attribution", None).maybe(_attribution),
        objects=tuple(_object_error(item) for item in top.get("objects", []).items()),
        rays=tuple(_ray_error(item) for item in top.get("rays", []).items()),
        shadows=tuple(_light_shadow(item) for item in top.get("shadows", []).items()),
        ambient=tuple(_ambient_error(item) for item in top.get("ambient", []).items()),
        bounces=tuple(_bounce_share(item) for item in top.get("bounces", []).items()),
        candidates=tuple(_candidate(item) for item in top.get("candidates", []).items()),
        failed_candidates=tuple(
            FailedCandidate(item.get("name").text(), item.get("why").text())
            for item in top.get("failed_candidates", []).items()
        ),
    )


def _plain(value: Any) -> Any:
    """`value` as what strict JSON can hold."""
    if isinstance(value, Measurement):
        return _plain_measurement(value)
    if is_dataclass(value) and not isinstance(value, type):
        names = [item.name for item in fields(value)]
        if isinstance(value, Results):
            names = ["schema", *[name for name in names if name != "schema"]]
        return {name: _plain(getattr(value, name)) for name in names}
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, str):
        return value
    if tolist := getattr(value, "tolist", None):  # a NumPy scalar or array, without importing NumPy
        return _plain(tolist())
    if isinstance(value, (Sequence, set, frozenset)):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"
    if value is None or isinstance(value, (bool, int, float)):
        return value
    return str(value)


def _plain_measurement(measurement: Measurement) -> dict[str, Any]:
    """A metric's object: `floor` and `corrected` only where the metric has them."""
    names = ["value", "low", "high", "unit", "how"]
    names += [name for name in ("floor", "corrected") if getattr(measurement, name) is not None]
    return {name: _plain(getattr(measurement, name)) for name in names}


def _refuse_constant(name: str) -> Any:
    raise ResultsError(f"results: found the bare word {name}, which is not JSON; expected it in quotes")


class _Node:
    """A value of the document and the path to it, so that an error can say where it is."""

    def __init__(self, value: Any, path: str) -> None:
        self.value = value
        self.path = path

    def get(self, key: str, default: Any = ...) -> "_Node":
        if not isinstance(self.value, dict):
            raise self.wrong("an object")
        if key not in self.value and default is ...:
            raise ResultsError(f"{self.path}.{key}: missing; keys found: {', '.join(self.value) or 'none'}")
        return _Node(self.value.get(key, default), f"{self.path}.{key}")

    def wrong(self, expected: str) -> ResultsError:
        return ResultsError(f"{self.path}: expected {expected}, found {json.dumps(self.value)[:60]}")

    def maybe(self, read: "Callable[[_Node], T]") -> "T | None":
        return None if self.value is None else read(self)

    def mapping(self) -> dict[str, Any]:
        if not isinstance(self.value, dict):
            raise self.wrong("an object")
        return self.value

    def items(self, count: int | None = None) -> list["_Node"]:
        if not isinstance(self.value, list) or (count is not None and len(self.value) != count):
            raise self.wrong("a list" if count is None else f"a list of {count}")
        return [_Node(item, f"{self.path}[{index}]") for index, item in enumerate(self.value)]

    def nodes(self) -> dict[str, "_Node"]:
        return {key: _Node(item, f"{self.path}.{key}") for key, item in self.mapping().items()}

    def text(self) -> str:
        if not isinstance(self.value, str):
            raise self.wrong("a text")
        return self.value

    def texts(self) -> tuple[str, ...]:
        return tuple(item.text() for item in self.items())

    def integer(self) -> int:
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            raise self.wrong("a whole number")
        return self.value

    def number(self) -> float:
        if isinstance(self.value, str) and self.value in _NONFINITE:
            return _NONFINITE[self.value]
        if isinstance(self.value, bool) or not isinstance(self.value, (int, float)):
            raise self.wrong('a number, "NaN", "Infinity" or "-Infinity"')
        return float(self.value)

    def flag(self) -> bool:
        if not isinstance(self.value, bool):
            raise self.wrong("true or false")
        return self.value


def _measurement(node: _Node) -> Measurement:
    return Measurement(
        value=node.get("value").number(),
        low=node.get("low", None).maybe(_Node.number),
        high=node.get("high", None).maybe(_Node.number),
        unit=node.get("unit", "").text(),
        how=node.get("how", "").text(),
        floor=node.get("floor", None).maybe(_Node.number),
        corrected=node.get("corrected", None).maybe(_Node.number),
    )


def _metrics(node: _Node) -> dict[str, Measurement]:
    return {name: _measurement(item) for name, item in node.nodes().items()}


def _timing(node: _Node) -> Timing:
    return Timing(node.get("median").number(), node.get("mad").number(), node.get("frames").integer())


def _reference(node: _Node) -> Reference:
    return Reference(
        spp=node.get("spp").integer(),
        batches=node.get("batches").integer(),
        seconds=node.get("seconds").number(),
        cached=node.get("cached").flag(),
        truth=node.get("truth", "single").text(),
    )


def _frame(node: _Node) -> Frame:
    return Frame(_metrics(node.get("metrics")), node.get("time_ms", None).maybe(_timing))


def _effect(node: _Node) -> Effect:
    return Effect(
        effect=node.get("effect").text(),
        terms=node.get("terms").texts(),
        knobs=node.get("knobs", {}).mapping(),
        metrics=_metrics(node.get("metrics")),
        time_ms=node.get("time_ms", None).maybe(_timing),
        bake_ms=node.get("bake_ms", None).maybe(_Node.number),
        share=_metrics(node.get("share", {})),
        bytes_per_pixel=node.get("bytes_per_pixel", None).maybe(_Node.integer),
    )


def _closure(node: _Node) -> Closure:
    return Closure(_metrics(node.get("metrics")), _measurement(node.get("bias")))


def _pass_time(node: _Node) -> PassTime:
    return PassTime(
        name=node.get("name").text(),
        effect=node.get("effect").text(),
        median=node.get("median").number(),
        mad=node.get("mad").number(),
    )


def _attribution(node: _Node) -> Attribution:
    return Attribution(
        total=_metrics(node.get("total")),
        residual=_metrics(node.get("residual")),
        players=tuple(_player(item) for item in node.get("players").items()),
        subsets=node.get("subsets").integer(),
        exhaustive=node.get("exhaustive").flag(),
        seconds_per_subset={name: item.number() for name, item in node.get("seconds_per_subset", {}).nodes().items()},
        together=tuple(_together(item) for item in node.get("together", []).items()),
    )


def _together(node: _Node) -> Together:
    first, second = node.get("names").items(2)
    return Together((first.text(), second.text()), _metrics(node.get("removed")))


def _player(node: _Node) -> Player:
    return Player(
        name=node.get("name").text(),
        terms=node.get("terms").texts(),
        approximated=node.get("approximated").flag(),
        share=_metrics(node.get("share")),
        removed=_metrics(node.get("removed")),
    )


def _object_error(node: _Node) -> ObjectError:
    return ObjectError(
        name=node.get("name").text(),
        material=node.get("material").text(),
        pixels=node.get("pixels").integer(),
        metrics=_metrics(node.get("metrics")),
        share=_measurement(node.get("share")),
    )


def _light_shadow(node: _Node) -> LightShadow:
    return LightShadow(
        effect=node.get("effect").text(),
        light=node.get("light").text(),
        rmse=_measurement(node.get("rmse")),
        parts={
            kind: {name: _shadow_part(part) for name, part in places.nodes().items()}
            for kind, places in node.get("parts").nodes().items()
        },
    )


def _ray_error(node: _Node) -> RayError:
    return RayError(
        effect=node.get("effect").text(),
        rmse=_measurement(node.get("rmse")),
        parts={
            fate: RayPart(part.get("pixels").integer(), _measurement(part.get("share")))
            for fate, part in node.get("parts").nodes().items()
        },
    )


def _ambient_error(node: _Node) -> AmbientError:
    return AmbientError(
        effect=node.get("effect").text(),
        truth=node.get("truth").text(),
        radius=node.get("radius").maybe(_Node.number),
        metrics=_metrics(node.get("metrics")),
    )


def _bounce_share(node: _Node) -> BounceShare:
    numbers = {name: _measurement(node.get(name)) for name in ("share", "energy", "leaked", "missing", "rmse")}
    return BounceShare(node.get("effect").text(), node.get("bounces", None).maybe(_Node.integer), **numbers)


def _shadow_part(node: _Node) -> ShadowPart:
    return ShadowPart(node.get("pixels").integer(), _measurement(node.get("share")))


def _candidate(node: _Node) -> Candidate:
    return Candidate(
        name=node.get("name").text(),
        source=node.get("source").text(),
        metrics=_metrics(node.get("metrics")),
        time_ms=node.get("time_ms", None).maybe(_timing),
        time_how=node.get("time_how", "").text(),
        time_whole=node.get("time_whole", False).flag(),
        pixels=node.get("pixels").integer(),
        masked={reason: count.integer() for reason, count in node.get("masked", {}).nodes().items()},
        findings=tuple(_finding(item) for item in node.get("findings", []).items()),
        layers=tuple(_layer_error(item) for item in node.get("layers", []).items()),
        attribution=node.get("attribution", None).maybe(_attribution),
        nonfinite=node.get("nonfinite", 0).integer(),
        engine=node.get("engine", "").text(),
        device=node.get("device", "").text(),
        notes=node.get("notes", []).texts(),
        truths={name: _metrics(item) for name, item in node.get("truths", {}).nodes().items()},
        follows=node.get("follows", "").text(),
    )


def _finding(node: _Node) -> Finding:
    return Finding(
        fault=node.get("fault").text(),
        words=node.get("words").text(),
        size={name: item.number() for name, item in node.get("size", {}).nodes().items()},
        corrected=node.get("corrected").flag(),
    )


def _layer_error(node: _Node) -> LayerError:
    return LayerError(
        layer=node.get("layer").text(),
        term=node.get("term").text(),
        metrics=_metrics(node.get("metrics")),
        pixels=node.get("pixels").integer(),
    )


def _nonfinite(node: _Node) -> NonFinite:
    where = {}
    for name, places in node.get("where", {}).nodes().items():
        pairs = [place.items(2) for place in places.items()]
        where[name] = tuple((x.integer(), y.integer()) for x, y in pairs)
    return NonFinite(
        frame=node.get("frame").integer(),
        effects={name: count.integer() for name, count in node.get("effects").nodes().items()},
        where=where,
    )
