"""Rays followed inside a solid by its tangent planes."""

from ...effect import Effect, Knob
from ...glass.around import AROUND_KNOBS, around_uniforms, nothing_around

EFFECT = Effect(
    name="refraction_bounces",
    terms=("transmission",),
    summary="The refracted ray is followed inside from wall to wall, a cube map of the solid's tangent planes telling "
    "where; at each what leaves shows what is around, and the rest is mirrored on.",
    citation="Guy & Soler 2004, Graphics Gems Revisited: Rendering of Gemstones; Szirmay-Kalos "
    "et al. 2005, Approximate Ray-Tracing on the GPU with Distance Impostors",
    channels=("position", "normal", "absorption", "ior"),
    unneeded=nothing_around,
    uniforms=around_uniforms,
    defines=lambda knobs: {"BOUNCES": knobs["bounces"], "ITERATIONS": knobs["iterations"]},
    knobs=(
        Knob("bounces", 4, "How often light meets a wall inside.", low=1, high=16, sweep=(1, 2, 3, 4, 6, 8)),
        Knob("iterations", 6, "Guesses for where a ray meets a wall.", low=1, high=32, sweep=(1, 2, 3, 6, 12)),
        Knob(
            "size",
            256,
            "Side of each face of the cube map.",
            unit="texels",
            low=16,
            high=2048,
            sweep=(32, 64, 128, 256, 512),
        ),
        *AROUND_KNOBS,
        Knob("solids", 4, "Cube maps at most: the largest solids have one each, others show nothing.", low=1, high=8),
    ),
)
