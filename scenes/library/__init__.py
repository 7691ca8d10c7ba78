"""The built-in scenes: a TOML file each, or a Python module with `SUMMARY` and `scene()`.

A scene's name is its file's name, with `-` for `_`.
"""

from functools import cache
from importlib import import_module
from pathlib import Path

from lightmeter.scenes.model import Scene

_FOLDER = Path(__file__).parent


@cache
def _files() -> dict[str, Path]:
    found = [p for p in _FOLDER.iterdir() if p.suffix in (".toml", ".py") and not p.name.startswith("_")]
    return {p.stem.replace("_", "-"): p for p in sorted(found)}


def names() -> list[str]:
    """The built-in scenes' names, sorted."""
    return sorted(_files())


def path(name: str) -> Path:
    """The file of a built-in scene.

    Raises:
        SceneError: there is none of that name.
    """
    if name not in _files():
        from lightmeter.scenes.errors import SceneError, nearest, shown

        raise SceneError(f"there is no built-in scene {shown(name)}", remedy=nearest(name, names()))
    return _files()[name]


def summary(name: str) -> str:
    """What a built-in scene isolates, one sentence.

    Raises:
        SceneError: there is none of that name.
    """
    file = path(name)
    if file.suffix == ".py":
        return import_module(f"{__name__}.{file.stem}").SUMMARY
    import tomllib

    return tomllib.loads(file.read_text(encoding="utf-8"))["summary"]


def load(name: str) -> Scene:
    """A built-in scene.

    Raises:
        SceneError: there is none of that name.
    """
    file = path(name)
    if file.suffix == ".py":
        return import_module(f"{__name__}.{file.stem}").scene()
    from lightmeter.scenes.toml import load_toml

    return load_toml(file)
