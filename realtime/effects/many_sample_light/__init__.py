"""An emissive surface as many point lights on it: what converges to the truth, and what it costs."""

from ...effect import Effect, Knob
from ...emissive import emissive

EFFECT = Effect(
    name="many_sample_light",
    terms=("direct",),
    summary="An emissive surface is lit with as many points on it, evenly by area, other ones for neighbouring pixels.",
    citation="Shirley, Wang & Zimmerman 1996, Monte Carlo Techniques for Direct Lighting Calculations, section 3 (area "
    "sampling); Keller & Heidrich 2001, Interleaved Sampling",
    knobs=(
        Knob("samples", 16, "Points on the light for each pixel.", low=1, high=1024, sweep=(1, 4, 16, 64, 256)),
        Knob(
            "tile",
            4,
            "Side of the square of pixels that have points of their own; 1: the same ones for all, which shows as "
            "copies of a highlight, where other ones show as noise.",
            unit="pixels",
            low=1,
            high=16,
            sweep=(1, 2, 4, 8),
        ),
    ),
    rank=3,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    lights=emissive,
)
