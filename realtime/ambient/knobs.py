"""The knobs that ambient visibility techniques share."""

from ..effect import Knob, Knobs

CHANNELS = ("position", "normal", "roughness", "base_color", "metallic", "specular")
"""What is read: the surface, and for the two parts of what it reflects its material."""

SPECULAR_OCCLUSIONS = {
    "same": "specular_as_diffuse",
    "none": "specular_unoccluded",
    "lagarde": "specular_lagarde",
    "cone": "specular_cone",
}
SPECULAR_OCCLUSION = Knob(
    "specular_occlusion",
    "lagarde",
    "What remains of the mirrored part: as of the scattered one; all; by a fit of the viewing angle and the roughness "
    "(Lagarde & de Rousiers 2014, listing 26); or the overlap of a visible cone with the lobe's (Oat & Sander 2007; "
    "Jimenez et al. 2016).",
    choices=tuple(SPECULAR_OCCLUSIONS),
    sweep=tuple(SPECULAR_OCCLUSIONS),
)
RESOLUTION = Knob(
    "resolution",
    "full",
    "Of the occlusion: every pixel, or every other one of every other row, interpolated within a surface.",
    choices=("full", "half"),
    sweep=("full", "half"),
)


def denoise(default: str) -> Knob:
    """What takes the pattern of 4 × 4 pixels away."""
    return Knob(
        "blur",
        default,
        "The mean over the pattern's 4 × 4 pixels, all of them or those of the same surface.",
        choices=("none", "box4", "bilateral"),
        sweep=("none", "box4", "bilateral"),
    )


def radius(default: float) -> Knob:
    """How far away occluders are looked for."""
    return Knob(
        "radius",
        default,
        "Occluders farther away count for nothing.",
        unit="m",
        low=1e-3,
        high=1e4,
        sweep=(0.1, 0.25, 0.5, 1.0, 2.0, 4.0),
    )


def specular_defines(knobs: Knobs) -> dict[str, object]:
    """The GLSL function that stands for the specular occlusion."""
    return {"SPECULAR_OCCLUSION": SPECULAR_OCCLUSIONS[str(knobs["specular_occlusion"])]}


def scale(knobs: Knobs) -> int:
    """Pixels per texel of the occlusion, across and down."""
    return {"full": 1, "half": 2}[str(knobs["resolution"])]
