"""From pydantic's complaints to one message with a place, a value and a remedy."""

import re
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from lightmeter.scenes.errors import SceneError, nearest, shown


class Strict(BaseModel):
    """A table that knows all its keys."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @model_validator(mode="before")
    @classmethod
    def _known_keys(cls, data: Any) -> Any:
        if isinstance(data, dict):
            valid = [field.alias or name for name, field in cls.model_fields.items()]
            for key in data:
                if key not in valid:
                    raise PydanticCustomError("unknown_key", "unknown key", {"key": str(key), "valid": valid})
        return data


_WORDS = {
    "greater than or equal to": "at least",
    "less than or equal to": "at most",
    "greater than": "above",
    "less than": "below",
    "valid tuple": "list",
    "valid list": "list",
    "valid number": "number",
    "valid string": "string",
    "a valid boolean": "true or false",
    "valid integer": "whole number",
    "a valid dictionary or object to extract fields from": "a table",
    "a valid dictionary or instance of": "a table for",
    "a valid dictionary": "a table",
}
"""Pydantic's words, and a scene author's."""


def dotted(path: tuple[int | str, ...]) -> str:
    """`("shapes", 2, "material")` as `shapes[2].material`."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            plain = re.fullmatch(r"[A-Za-z0-9_-]+", part) is not None
            text += ("." if text else "") + (part if plain else shown(part))
    return text


def explain(error: ValidationError, data: object, where: str) -> SceneError:
    """The first complaint about `data`, as a message; it says how many more there are."""
    complaints = error.errors(include_url=False)
    first = complaints[0]
    kind, context = first["type"], first.get("ctx") or {}
    path = _written(first["loc"], data, missing=kind == "missing")
    what, expected, actual, remedy = first["msg"], "", shown(first.get("input")), ""
    if kind == "unknown_key":
        what, actual = f"unknown key {shown(context['key'])}", ""
        remedy = nearest(context["key"], context["valid"])
    elif kind == "missing":
        short = isinstance(first["loc"][-1], int)
        what, actual = "the list is too short" if short else "a required key is missing", ""
    elif kind == "union_tag_not_found":
        what, actual = "the key 'type' is missing", ""
    elif kind in ("union_tag_invalid", "literal_error", "enum"):
        names = re.findall(r"'([^']*)'", str(context.get("expected_tags") or context.get("expected")))
        given = context.get("tag", first.get("input"))
        path += ("type",) if kind == "union_tag_invalid" else ()
        what, expected, actual = "this value is not known", "one of " + ", ".join(names), shown(given)
        if isinstance(given, str) and "did you mean" in nearest(given, names):
            remedy = nearest(given, names)
    elif kind == "value_error" and isinstance(context.get("error"), SceneError):
        inner = context["error"]
        what, expected, actual, remedy = inner.what, inner.expected, inner.actual, inner.remedy
    elif kind == "value_error":
        what, actual = str(context.get("error", what)), ""
    elif what.startswith("Input should be "):
        what, expected = "this value is not valid", what.removeprefix("Input should be ")
        for theirs, ours in _WORDS.items():
            expected = expected.replace(theirs, ours)
    more = len(complaints) - 1
    if more:
        remedy = f"{remedy}; " if remedy else ""
        remedy += f"{more} more fault{'s' if more > 1 else ''} in this file"
    place = dotted(path)
    return SceneError(
        what,
        where=f"{where}: {place}" if place else where,
        expected=expected,
        actual=actual,
        remedy=remedy,
    )


def _written(loc: tuple[int | str, ...], data: object, *, missing: bool) -> tuple[int | str, ...]:
    """The part of pydantic's location that the user wrote: without the names of union branches."""
    path: list[int | str] = []
    for step, part in enumerate(loc):
        present = (isinstance(data, dict) and part in data) or (
            isinstance(data, list) and isinstance(part, int) and part < len(data)
        )
        if present:
            path.append(part)
            data = data[part]  # type: ignore[index]
        elif missing and step == len(loc) - 1:
            path.append(part)
    return tuple(path)


Table = TypeVar("Table", bound=BaseModel)


def read_toml(data: bytes, model: type[Table], where: str) -> Table:
    """A TOML file's content as `model`.

    Raises:
        SceneError: it is no TOML, or does not follow the model.
    """
    import tomllib

    try:
        content = tomllib.loads(data.decode("utf-8"))
    except RecursionError:
        raise SceneError("this TOML is nested too deeply", where=where) from None
    except ValueError as error:  # TOMLDecodeError and UnicodeDecodeError are ValueErrors
        raise SceneError(f"this is no TOML ({str(error)[:200]})", where=where) from None
    try:
        return model.model_validate(content)
    except ValidationError as error:
        raise explain(error, content, where) from None
