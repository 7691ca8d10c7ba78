"""Reinhard's curve, with or without a white point, on channels or on the luminance."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="reinhard",
    terms=("tone",),
    summary="x over 1 + x, lifted so that a white point becomes 1; of each channel, or of the luminance.",
    citation="Reinhard et al. 2002, Photographic Tone Reproduction for Digital Images, eq. 3 and 4",
    rank=2,
    defines=lambda knobs: {"ON_LUMINANCE": knobs["on"] == "luminance"},
    knobs=(
        Knob(
            "white",
            4.0,
            "What becomes 1; large: only the brightest light there is.",
            low=0.1,
            high=1e6,
            sweep=(1.5, 4.0, 16.0, 1e6),
        ),
        Knob(
            "on",
            "luminance",
            "What the curve is applied to; a colour's channels keep their ratio, or do not.",
            choices=("luminance", "channels"),
            sweep=("luminance", "channels"),
        ),
        Knob(
            "prescale", 1.0, "Factor on the radiance before the curve.", low=0.0, high=100.0, sweep=(0.5, 0.7, 1.0, 1.4)
        ),
    ),
)
