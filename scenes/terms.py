"""The terms: the pieces of light transport and of the camera chain that effects approximate (design, section 3)."""

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Term:
    """One exactly defined piece of the picture.

    Attributes:
        scope: "gbuffer" (a variant of the surface points), "light" (once per light), "frame" (once), or
            "display" (after the scene-linear image).
        neutral: what the composition takes where no effect approximates the term: 0, or 1 for a visibility.
    """

    name: str
    meaning: str
    scope: Literal["gbuffer", "light", "frame", "display"]
    neutral: float = 0.0


TERMS = {
    term.name: term
    for term in (
        Term("surface", "the true shape's position and normal", "gbuffer"),
        Term("material", "unfiltered, unpacked texture values at the point", "gbuffer"),
        Term("direct", "unshadowed radiance reflected from a light", "light"),
        Term("visibility", "shadowed over unshadowed reflected radiance of a light", "light", 1.0),
        Term("environment", "unoccluded radiance reflected from the environment", "frame"),
        Term("environment_visibility", "occluded over unoccluded environment", "frame", 1.0),
        Term("indirect", "radiance scattered by other surfaces, one bounce or more", "frame"),
        Term("transmission", "radiance mirrored by and refracted through dielectric solids", "frame"),
        Term("coverage", "box filter over the pixel", "gbuffer"),
        Term("glare", "image convolved with the aperture's diffraction", "display"),
        Term("exposure", "the metering rule on the exact luminances", "display"),
        Term("tone", "the reference display transform, scene-linear to display-linear", "display"),
        Term("encode", "IEC 61966-2-1, display-linear to code values", "display"),
    )
}
