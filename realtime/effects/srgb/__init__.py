"""The sRGB transfer function, exactly."""

from ...effect import Effect
from ...pictures.codes import DITHER, dither_defines

EFFECT = Effect(
    name="srgb",
    terms=("encode",),
    summary="The piecewise sRGB curve, written to 8 bits.",
    citation="IEC 61966-2-1:1999",
    knobs=(DITHER,),
    defines=dither_defines,
)
