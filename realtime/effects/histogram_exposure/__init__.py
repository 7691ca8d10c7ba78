"""Automatic exposure from a histogram of luminance."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="histogram_exposure",
    terms=("exposure",),
    summary="Pixels are counted in bins of the luminance's logarithm; the darkest and brightest are left out and the "
    "bins' middles averaged.",
    citation="Vlachos 2008, Post Processing in The Orange Box",
    rank=-1,
    knobs=(
        Knob("bins", 64, "How many there are.", low=2, high=1024, sweep=(8, 16, 32, 64, 128, 256)),
        Knob("low", -14.0, "Where the first bin begins; darker pixels are in it.", unit="stops", low=-64.0, high=63.0),
        Knob("high", 10.0, "Where the last bin ends; brighter pixels are in it.", unit="stops", low=-63.0, high=64.0),
        Knob(
            "stride",
            2,
            "Every so many-th pixel of every so many-th row counts.",
            unit="pixels",
            low=1,
            high=16,
            sweep=(1, 2, 4, 8),
        ),
    ),
)
