"""Which truth: what a rough surface does with light that its facets send to other facets.

With one bounce it is lost, and rough metals are dark; with all bounces it goes on until it leaves the microsurface.
"""

from typing import TYPE_CHECKING

from lightmeter.scenes.errors import SceneError, nearest

if TYPE_CHECKING:  # the command line's words are read without NumPy
    from lightmeter.scenes.model import Scene

SINGLE, MULTISCATTER = "single", "multiscatter"
SCATTERINGS = {
    SINGLE: "one bounce on the microsurface, glTF's definition",
    MULTISCATTER: "all bounces on the microsurface, Heitz et al. 2016",
}


def check_scattering(name: str, scene: "Scene") -> None:
    """Raises unless there is such a truth, and the scene has it.

    Raises:
        ValueError: there is none of that name.
        SceneError: a material has layers: the walk is defined on the base's microsurface alone.
    """
    if name not in SCATTERINGS:
        raise ValueError(f"there is no truth {name!r}; {nearest(name, SCATTERINGS)}")
    if name == MULTISCATTER:
        layered = [shape for shape in scene.shapes if shape.material.layers]
        if layered:
            raise SceneError(
                f"the truth {MULTISCATTER!r} is not defined for clear coat, sheen and anisotropy",
                where=f"shape {layered[0].name!r}",
                remedy=f"take the truth {SINGLE!r}, or leave these layers out",
            )
