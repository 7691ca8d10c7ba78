"""The material's parameters in the G-buffer with 8 bits each."""

from ... import layout
from ...effect import Effect, Knob, Knobs


def stores(knobs: Knobs) -> dict[str, str]:
    """The formats of the base colour and of the other parameters."""
    return {"base_color": str(knobs["albedo"]), "parameters": str(knobs["parameters"])}


EFFECT = Effect(
    name="packed_material",
    terms=("material",),
    summary="The G-buffer keeps the base colour, and roughness, metallic, specular and occlusion, in 8 bits each.",
    citation="Saito & Takahashi 1990, Comprehensible Rendering of 3-D Shapes (G-buffers); IEC 61966-2-1 (sRGB)",
    knobs=(
        Knob(
            "albedo",
            "srgb8",
            "The base colour: 32-bit floats, or 8 bits each of linear or sRGB-encoded values.",
            choices=("fp32", *layout.BASE_COLORS),
            sweep=("fp32", *layout.BASE_COLORS),
        ),
        Knob(
            "parameters",
            "unorm8",
            "The other four: 32-bit floats, or 8 bits each.",
            choices=("fp32", "unorm8"),
            sweep=("fp32", "unorm8"),
        ),
    ),
    part="format of parameters",
    optional=True,
    stores=stores,
)
