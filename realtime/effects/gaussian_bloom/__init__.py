"""Bloom as a blurred copy of what is bright, added to the picture."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="gaussian_bloom",
    terms=("glare",),
    summary="What is brighter than a threshold is blurred by a Gaussian and added to the picture.",
    citation="James & O'Rorke 2004, Real-Time Glow, GPU Gems chapter 21",
    rank=1,
    knobs=(
        Knob(
            "threshold",
            1.0,
            "Luminance above which light blooms; only what exceeds it is taken.",
            unit="W/(sr·m²)",
            low=0.0,
            high=1e6,
            sweep=(0.0, 1.0, 4.0),
        ),
        Knob(
            "sigma",
            0.02,
            "Standard deviation of the Gaussian, of the picture's height.",
            low=1e-4,
            high=0.25,
            sweep=(0.005, 0.01, 0.02, 0.04),
        ),
        Knob(
            "strength", 0.04, "What the blurred light is multiplied with.", low=0.0, high=10.0, sweep=(0.01, 0.04, 0.2)
        ),
        Knob(
            "divisor",
            4,
            "Pixels along each side of a block: the blur is of a picture of blocks.",
            unit="pixels",
            low=1,
            high=8,
            sweep=(1, 2, 4, 8),
        ),
    ),
)
