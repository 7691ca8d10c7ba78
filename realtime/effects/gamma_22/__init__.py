"""A pure power law in place of sRGB's curve."""

from ...effect import Effect, Knob
from ...pictures.codes import DITHER, dither_defines

EFFECT = Effect(
    name="gamma_22",
    terms=("encode",),
    summary="A power law, the usual short cut for the sRGB curve, written to 8 bits.",
    citation="Poynton 1998, The Rehabilitation of Gamma",
    knobs=(
        Knob("gamma", 2.2, "The display's exponent.", low=1.0, high=4.0, sweep=(1.8, 2.0, 2.2, 2.4)),
        DITHER,
    ),
    defines=dither_defines,
    rank=1,
)
