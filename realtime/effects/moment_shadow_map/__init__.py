"""Moment shadow maps: four moments of the depths around a point bound what of the light reaches it."""

from ...effect import Effect, Knob
from ...shadows.knobs import BLEEDING, BLUR, RESOLUTION, biases, with_default

EFFECT = Effect(
    name="moment_shadow_map",
    terms=("visibility",),
    summary="Four moments of the depth are averaged like a picture; as much of a shadow as they prove is taken.",
    citation="Peters & Klein 2015, Moment Shadow Mapping (Hamburger, 4 moments); Peters, Münstermann, Wetzstein & "
    "Klein 2017, Improved Moment Shadow Maps (the bias at 32 bits)",
    knobs=(
        with_default(RESOLUTION, 512),
        BLUR,
        BLEEDING,
        Knob(
            "moment_bias",
            3e-7,
            "How far the moments are moved towards those of depths everywhere: against rounding, at the cost of leaks.",
            low=0.0,
            high=0.1,
            sweep=(3e-8, 3e-7, 3e-6, 3e-5),
        ),
        *biases(),
    ),
    rank=1,
    channels=("position", "normal"),
)
