"""Ghosts and a halo, as if light were reflected between a lens's surfaces."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="lens_flare",
    terms=("glare",),
    part="flare",
    optional=True,
    summary="Copies of what is bright, mirrored at the picture's middle, and a ring of it are added. Diffraction has "
    "neither: all of it is error.",
    citation="Chapman 2013, Pseudo Lens Flare",
    knobs=(
        Knob(
            "threshold",
            1.0,
            "Luminance above which light is reflected; only what exceeds it is taken.",
            unit="W/(sr·m²)",
            low=0.0,
            high=1e6,
        ),
        Knob("ghosts", 4, "How many mirrored copies there are.", low=0, high=16, sweep=(0, 2, 4, 8)),
        Knob("dispersal", 0.3, "Distance from one copy to the next, of that to the middle.", low=0.0, high=2.0),
        Knob("halo", 0.4, "The ring's radius, of the picture's height; 0: no ring.", low=0.0, high=1.0),
        Knob("chroma", 0.01, "How far red and blue lie apart, of the picture's width.", low=0.0, high=0.1),
        Knob("strength", 0.01, "What is added is multiplied with this.", low=0.0, high=10.0, sweep=(0.001, 0.01, 0.1)),
        Knob("divisor", 4, "Pixels along each side of a block: ghosts are of blocks.", unit="pixels", low=1, high=8),
    ),
)
