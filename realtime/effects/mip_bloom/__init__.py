"""Bloom through a chain of ever smaller pictures."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="mip_bloom",
    terms=("glare",),
    summary="The picture is halved several times and added up again on the way back; a small share of it takes the "
    "picture's place.",
    citation="Jimenez 2014, Next Generation Post Processing in Call of Duty: Advanced Warfare, SIGGRAPH course",
    knobs=(
        Knob(
            "strength",
            0.02,
            "Share of the light that is spread.",
            low=0.0,
            high=1.0,
            sweep=(0.005, 0.01, 0.02, 0.04, 0.1),
        ),
        Knob("levels", 6, "How often the picture is halved.", low=1, high=10, sweep=(3, 4, 5, 6, 7)),
        Knob(
            "spread",
            0.5,
            "Share that each smaller picture has of what is spread, over the one twice its size.",
            low=0.0,
            high=1.0,
            sweep=(0.3, 0.5, 0.7, 0.85),
        ),
    ),
)
