"""Positions and normals of the G-buffer in fewer bytes than 32-bit floats take."""

from ... import layout
from ...effect import Effect, Knob, Knobs


def stores(knobs: Knobs) -> dict[str, str]:
    """The formats of position and normal."""
    position = str(knobs["position"])
    if position == "depth":
        position = f"{knobs['depth_encoding']}{knobs['depth_bits']}"
    return {"position": position, "normal": str(knobs["normal"])}


EFFECT = Effect(
    name="packed_surface",
    terms=("surface",),
    summary="The G-buffer keeps positions (or the depth that they are rebuilt from) and normals in few bytes.",
    citation="Cigolle et al. 2014, A Survey of Efficient Representations for Independent Unit Vectors (octahedral "
    "normals); Reed 2015, Depth Precision Visualized (reversed depth)",
    knobs=(
        Knob(
            "position",
            "fp16",
            "Stored in floats of 32 or 16 bits, or rebuilt from the depth and the pixel.",
            choices=("fp32", "fp16", "depth"),
            sweep=("fp32", "fp16", "depth"),
        ),
        Knob(
            "depth_encoding",
            "reversed",
            "Of a depth: the distance itself, or as projections have it: 1 at the far plane, reversed at the near.",
            choices=layout.DEPTH_ENCODINGS,
            sweep=layout.DEPTH_ENCODINGS,
        ),
        Knob(
            "depth_bits",
            32,
            "Of a depth: whole numbers of 16 or 24 bits, or a float of 32.",
            unit="bits",
            choices=tuple(layout.DEPTH_BITS),
            sweep=tuple(layout.DEPTH_BITS),
        ),
        Knob(
            "normal",
            "oct8",
            "Floats of 32 or 16 bits, or an octahedron's two coordinates of 8, 12 or 16 bits.",
            choices=("fp32", *layout.NORMALS),
            sweep=("fp32", *layout.NORMALS),
        ),
    ),
    part="format of position and normal",
    optional=True,
    stores=stores,
)
