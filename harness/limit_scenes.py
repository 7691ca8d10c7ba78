"""Which scenes a limit speaks of."""

import re
from fnmatch import fnmatchcase
from pathlib import Path

from lightmeter.failures import UsageError
from lightmeter.hints import nearest

SUFFIXES = (".toml", ".gltf", ".glb")


def find_scenes(pattern: str, file: Path, place: str) -> list[str]:
    """The scenes that `pattern` names: one of the library, stiff ones ("stiff/*": those that are rendered), or files,
    found from the limits file's folder.

    Raises:
        UsageError: there are none; names the nearest.
    """
    from lightmeter.scenes import library

    if pattern in library.names():
        return [pattern]
    if stiff := _stiff(pattern):
        return stiff
    folder = file.parent
    found = _files(pattern, folder, file)
    if found:
        return found
    there = [*library.names(), *(_relative(path, folder) for path in _neighbours(pattern, folder, file))]
    kind = "matches no scene file" if _is_pattern(pattern) else "is no scene of the library and no scene file"
    raise UsageError(f"{place}.scene: {pattern!r} {kind} in {folder.resolve()}; {nearest(pattern, there)}")


def same_scene(asked: str, scene: str) -> bool:
    """Whether a word of the command line names a limit's scene."""
    return asked == scene or (
        Path(asked).suffix in SUFFIXES
        and Path(scene).suffix in SUFFIXES
        and Path(asked).resolve() == Path(scene).resolve()
    )


def _stiff(pattern: str) -> list[str]:
    from lightmeter.scenes.stiff import CASES, PREFIX

    names = [PREFIX + name for name, case in CASES.items() if not case.refused]
    return [name for name in names if fnmatchcase(name, pattern)] if pattern.startswith(PREFIX) else []


def _files(pattern: str, folder: Path, file: Path) -> list[str]:
    """Scene files that match, sorted; the limits file itself is none."""
    if not _is_pattern(pattern):
        path = folder / pattern
        return [str(path)] if path.suffix.lower() in SUFFIXES and path.is_file() else []
    if Path(pattern).is_absolute():
        return []
    try:
        matches = sorted(folder.glob(pattern))
    except (ValueError, NotImplementedError):
        return []
    return [str(p) for p in matches if p.suffix.lower() in SUFFIXES and p.is_file() and not _same(p, file)]


def _neighbours(pattern: str, folder: Path, file: Path) -> list[Path]:
    """Scene files beside what the pattern speaks of, for a hint."""
    beside = folder / re.split(r"[*?\[]", pattern)[0].rpartition("/")[0]
    found = [p for where in {folder, beside} if where.is_dir() for p in where.iterdir() if p.suffix in SUFFIXES]
    return [path for path in found if not _same(path, file)][:200]


def _is_pattern(text: str) -> bool:
    return any(mark in text for mark in "*?[")


def _relative(path: Path, folder: Path) -> str:
    return str(path.relative_to(folder)) if path.is_relative_to(folder) else str(path)


def _same(a: Path, b: Path) -> bool:
    return a.resolve() == b.resolve()
