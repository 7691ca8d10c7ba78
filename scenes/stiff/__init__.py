"""Stiff scenes: each at one edge of what the arithmetic or the sampling of either side can do.

They are no part of the built-in library: they are looked at for what breaks, not for what is approximated. Any command
takes one as `stiff/NAME`.
"""

from collections.abc import Sequence
from dataclasses import replace

from lightmeter.scenes.errors import SceneError, nearest, shown
from lightmeter.scenes.model import Scene
from lightmeter.scenes.stiff import coordinates, images, lights, materials, triangles
from lightmeter.scenes.stiff.case import StiffCase
from lightmeter.scenes.stiff.copies import copies

CASES: dict[str, StiffCase] = {
    **coordinates.CASES,
    **triangles.CASES,
    **lights.CASES,
    **images.CASES,
    **materials.CASES,
}
"""By name."""

PREFIX = "stiff/"
FILES = (".toml", ".gltf", ".glb")


def chosen(names: Sequence[str] = ()) -> dict[str, StiffCase]:
    """The cases of these names, all without any; for a scene's file or library name, that scene and its copies.

    Raises:
        SceneError: there is none of that name, or the file is wrong.
    """
    found = {name: case for name, case in CASES.items() if not names or name in names}
    for name in names:
        if name not in CASES:
            found |= copies(_source(name))
    return found


def load_stiff(name: str) -> Scene:
    """The scene that `stiff/NAME` names.

    Raises:
        SceneError: there is none of that name, or it is refused for its fault.
    """
    case = CASES.get(name.removeprefix(PREFIX))
    if case is None:
        raise SceneError(
            f"there is no scene {shown(name)}", remedy=nearest(name, [f"{PREFIX}{known}" for known in CASES])
        )
    return replace(case.scene(), name=name, summary=case.what)


def _source(name: str) -> str:
    """The name of a scene that is no stiff one."""
    from lightmeter.scenes import library

    if not name.lower().endswith(FILES) and name not in library.names():
        raise SceneError(
            f"there is no stiff scene {shown(name)}",
            expected="one of them, a name in the library, a .toml, a .gltf or a .glb",
            remedy=nearest(name, CASES),
        )
    return name
