"""Hill's fit of the ACES display transform, between two matrices."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="hill",
    terms=("tone",),
    summary="A rational fit of ACES' reference and output transforms, between two matrices that mix the channels "
    "as they do.",
    citation="Hill 2016, ACES fit in Baking Lab (Pettineo, MJP), ACES.hlsl",
    rank=1,
    knobs=(
        Knob(
            "prescale",
            1.0,
            "Factor on the radiance before the curve; three.js has 1.67, to look as bright as Narkowicz's fit.",
            low=0.0,
            high=100.0,
            sweep=(0.8, 1.0, 1.25, 1.67),
        ),
    ),
)
