"""GLSL sources: `#include "file.glsl"` and the `#define`s of what a pass really gets. GLSL 4.10, for macOS."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

SHARED = Path(__file__).parent / "shaders"
INCLUDE = re.compile(r'^\s*#include\s+"([^"]+)"\s*$', re.MULTILINE)


@dataclass(frozen=True)
class Source:
    """A complete shader text."""

    text: str


def source(body: str, defines: Mapping[str, object] | None = None, folder: Path | None = None) -> Source:
    """A shader from its body: version, defines, then the body with its includes, each file once.

    Args:
        body: GLSL text, or the name of a file among the shared shaders.
        defines: names to values; True stands for a name without a value, False and None for no define.
        folder: an effect's folder, searched before the shared shaders.
    """
    if body.endswith((".glsl", ".frag", ".vert")) and "\n" not in body:
        body = _read(body, folder)
    lines = ["#version 410"]
    for name, value in (defines or {}).items():
        if value is not None and value is not False:
            lines.append(f"#define {name}" if value is True else f"#define {name} {_literal(value)}")
    return Source("\n".join(lines) + "\n" + _include(body, folder, set()))


def _literal(value: object) -> str:
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, tuple):
        return f"vec{len(value)}({', '.join(repr(float(x)) for x in value)})"
    return str(value)


def _read(name: str, folder: Path | None) -> str:
    for place in (folder, SHARED):
        if place is not None and (place / name).is_file():
            return (place / name).read_text(encoding="utf-8")
    raise FileNotFoundError(f"no shader file {name!r} in {folder or SHARED} or {SHARED}")


def _include(body: str, folder: Path | None, seen: set[str]) -> str:
    def insert(match: re.Match) -> str:
        name = match[1]
        if name in seen:
            return ""
        seen.add(name)
        return _include(_read(name, folder), folder, seen)

    return INCLUDE.sub(insert, body)


def explain(message: str, text: str) -> str:
    """A driver's message with the source lines it speaks of."""
    numbers = {int(n) for n in re.findall(r"\b\d+:(\d+)", message)}
    lines = text.splitlines()
    shown = [f"{n:4}  {lines[n - 1]}" for n in sorted(numbers) if 0 < n <= len(lines)]
    return "a shader did not compile\n" + message.strip() + "\n" + "\n".join(shown)
