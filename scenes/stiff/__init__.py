"""Stiff scenes: each at one edge of what the arithmetic or the sampling of either side can do.

They are no part of the built-in library: they are looked at for what breaks, not for what is approximated.
"""

from collections.abc import Sequence

from lightmeter.scenes.errors import SceneError, nearest, shown
from lightmeter.scenes.stiff import coordinates, images, lights, materials, triangles
from lightmeter.scenes.stiff.case import StiffCase

CASES: dict[str, StiffCase] = {
    **coordinates.CASES,
    **triangles.CASES,
    **lights.CASES,
    **images.CASES,
    **materials.CASES,
}
"""By name."""


def chosen(names: Sequence[str] = ()) -> dict[str, StiffCase]:
    """The cases of these names, all without any.

    Raises:
        SceneError: there is none of that name.
    """
    for name in names:
        if name not in CASES:
            raise SceneError(f"there is no stiff scene {shown(name)}", remedy=nearest(name, CASES))
    return {name: case for name, case in CASES.items() if not names or name in names}
