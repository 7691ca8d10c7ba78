"""A `.gltf` or `.glb` file taken apart: its JSON, and its binary chunk (glTF 2.0, sections 4 and 2.5)."""

import json
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lightmeter.scenes.errors import SceneError, shown
from lightmeter.scenes.files import read_bytes

MOST_VALUES = 4_000_000
"""Values in the JSON; more would need gigabytes once parsed."""


@dataclass(frozen=True)
class Container:
    """What a file holds.

    Attributes:
        path: the file; other files are named relative to its folder.
        content: the JSON object.
        binary: the GLB's binary chunk, or None.
    """

    path: Path
    content: dict[str, Any]
    binary: memoryview | None

    @property
    def where(self) -> str:
        """The file, for messages."""
        return str(self.path)


def open_container(path: Path) -> Container:
    """Reads a `.gltf` or `.glb`; which of the two it is, its first bytes say.

    Raises:
        SceneError: the file is missing, truncated, or its JSON is not valid.
    """
    data = read_bytes(path)
    where = str(path)
    if data[:4] == b"glTF":
        text, binary = _chunks(data, where)
    else:
        text, binary = data, None
    return Container(path, _object(text, where), binary)


def _chunks(data: bytes, where: str) -> tuple[bytes, memoryview | None]:
    """The JSON and binary chunks of a GLB."""
    if len(data) < 20:
        raise SceneError("the GLB is truncated", where=where, expected="20 bytes or more", actual=f"{len(data)}")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise SceneError("this GLB version is not supported", where=where, expected="2", actual=f"{version}")
    if length > len(data):
        raise SceneError("the GLB is truncated", where=where, expected=f"{length} bytes", actual=f"{len(data)}")
    text, binary, at = None, None, 12
    while at + 8 <= length:
        size, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + size > length:
            raise SceneError(
                "a GLB chunk is truncated",
                where=f"{where}: byte {at}",
                expected=f"{size} bytes",
                actual=f"{length - at - 8}",
            )
        if text is None:
            if kind != b"JSON":
                raise SceneError("the GLB's first chunk is not JSON", where=f"{where}: byte {at}", actual=shown(kind))
            text = data[at + 8 : at + 8 + size]
        elif kind == b"BIN\0" and binary is None:
            binary = memoryview(data)[at + 8 : at + 8 + size]
        at += 8 + size + (-size % 4)
    if text is None:
        raise SceneError("the GLB has no JSON chunk", where=where)
    return text, binary


def _object(text: bytes, where: str) -> dict[str, Any]:
    values = text.count(b",") + text.count(b"[") + text.count(b"{")
    if values > MOST_VALUES:
        raise SceneError(
            "the JSON is too large", where=where, expected=f"at most {MOST_VALUES} values", actual=f"{values}"
        )
    try:
        content = json.loads(text.decode("utf-8"), parse_constant=_refuse)
    except RecursionError:
        raise SceneError("the JSON is nested too deeply", where=where) from None
    except ValueError as error:  # JSONDecodeError, UnicodeDecodeError, and integers of thousands of digits
        raise SceneError(f"this is no valid JSON ({str(error)[:200]})", where=where) from None
    if not isinstance(content, dict):
        raise SceneError("this is no glTF", where=where, expected="a JSON object", actual=shown(content))
    return content


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON number")
