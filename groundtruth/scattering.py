"""Which truth: what a rough surface does with light that its facets send to other facets.

With one bounce it is lost, and rough metals are dark; with all bounces it goes on until it leaves the microsurface.
"""

from lightmeter.scenes.errors import nearest

SINGLE, MULTISCATTER = "single", "multiscatter"
SCATTERINGS = {
    SINGLE: "one bounce on the microsurface, glTF's definition",
    MULTISCATTER: "all bounces on the microsurface, Heitz et al. 2016",
}


def check_scattering(name: str) -> None:
    """Raises ValueError unless there is such a truth."""
    if name not in SCATTERINGS:
        raise ValueError(f"there is no truth {name!r}; {nearest(name, SCATTERINGS)}")
