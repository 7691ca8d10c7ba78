"""Names of the declared functions, and which of them an effect's shaders reach."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from ..declared_twins import declared_twins
from ..discovery import effect
from ..effect import EffectError, nearest
from ..shaders import INCLUDE, SHARED
from ..twin import Twin
from .judging import judged_slots


@dataclass(frozen=True)
class Subject:
    """A function to stress."""

    name: str
    twin: Twin
    folder: Path


def subjects() -> list[Subject]:
    """Every declared function whose results have digits."""
    seen: Counter[str] = Counter()
    found = []
    for folder, twin in declared_twins():
        name = f"{'shared' if folder == SHARED else folder.name}/{twin.function}"
        seen[name] += 1
        if judged_slots(twin):
            found.append(Subject(name if seen[name] == 1 else f"{name}#{seen[name]}", twin, folder))
    return found


def of_effects(names: list[str]) -> list[Subject]:
    """Those in the effects' own files and in the shared ones that these include; all where no effect is named.

    Raises:
        EffectError: there is no such effect.
    """
    if not names:
        return subjects()
    wanted = {path for name in names for path in _files(effect(name).folder)}
    return [s for s in subjects() if _place(s) in wanted]


def named(name: str, among: list[Subject]) -> list[Subject]:
    """The functions of that name: OWNER/FUNCTION, with #2 for the second declaration, or FUNCTION alone.

    Raises:
        EffectError: there is none; names the nearest.
    """
    found = [s for s in among if name in (s.name, s.twin.function)]
    if not found:
        known = [s.name for s in among] + [s.twin.function for s in among]
        raise EffectError(f"there is no function {name!r} to stress; {nearest(name, known)}")
    return found


def _place(subject: Subject) -> Path:
    own = subject.folder / subject.twin.file
    return own if own.is_file() else SHARED / subject.twin.file


def _files(folder: Path | None) -> set[Path]:
    assert folder is not None
    found: set[Path] = set()
    waiting = sorted(folder.glob("*.glsl")) + sorted(folder.glob("*.frag"))
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            for name in INCLUDE.findall(path.read_text(encoding="utf-8")):
                own = folder / name
                waiting.append(own if own.is_file() else SHARED / name)
    return found
