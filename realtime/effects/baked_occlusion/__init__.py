"""Ambient occlusion that is baked into the vertices and interpolated between them."""

from ...ambient.knobs import CHANNELS, SPECULAR_OCCLUSION, specular_defines
from ...effect import Effect, Knob

EFFECT = Effect(
    name="baked_occlusion",
    terms=("environment_visibility",),
    summary="The open share of directions at every vertex, found once by depth maps from all around, is interpolated.",
    citation="Zhukov, Iones & Kronin 1998, An Ambient Light Illumination Model; Pharr & Green 2004, Ambient Occlusion, "
    "GPU Gems, chapter 17 (depth maps from many directions)",
    knobs=(
        Knob(
            "directions",
            256,
            "Depth maps, evenly around the scene; a vertex sees half of them.",
            low=8,
            high=4096,
            sweep=(32, 64, 128, 256, 512),
        ),
        Knob("map", 512, "Side of a depth map, which holds the whole scene.", unit="texels", low=32, high=4096),
        Knob(
            "bias",
            1.5,
            "How far a vertex is moved along its normal before it is compared.",
            unit="texels",
            low=0.0,
            high=32.0,
            sweep=(0.0, 0.5, 1.0, 1.5, 3.0),
        ),
        Knob(
            "spacing",
            0.0,
            "Triangles are divided until vertices are this close; 0: the scene's own vertices.",
            unit="m",
            low=0.0,
            high=1e4,
            sweep=(0.0, 1.0, 0.5, 0.25, 0.125),
        ),
        SPECULAR_OCCLUSION,
    ),
    rank=3,
    optional=True,
    channels=CHANNELS,
    defines=specular_defines,
)
