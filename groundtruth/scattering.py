"""Which truth: what a rough surface does with light that its facets send to other facets."""

from lightmeter.scenes.errors import nearest

SINGLE, MULTISCATTER = "single", "multiscatter"
SCATTERINGS = {
    SINGLE: "glTF's definition: light bounces once on the microsurface, and what meets another facet is lost",
    MULTISCATTER: "light bounces on the microsurface until it leaves it (Heitz et al. 2016)",
}


def check_scattering(name: str) -> None:
    """Raises ValueError unless there is such a truth."""
    if name not in SCATTERINGS:
        raise ValueError(f"there is no truth {name!r}; {nearest(name, SCATTERINGS)}")
