"""Narkowicz's fit of the ACES display transform, per channel."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="narkowicz",
    terms=("tone",),
    summary="A rational fit of ACES' filmic curve, applied to each channel of Rec. 709.",
    citation="Narkowicz 2016, ACES Filmic Tone Mapping Curve (largest error on its own curve 0.0138)",
    knobs=(
        Knob(
            "prescale",
            0.5,
            "Factor on the radiance before the curve: 0.5 meets the ACES 1.0 SDR view (the published error of 0.0138 "
            "comes out there), 0.6 is its author's advice, 1 is the fit as often pasted.",
            low=0.0,
            high=100.0,
            sweep=(0.4, 0.5, 0.6, 0.8, 1.0),
        ),
    ),
)
