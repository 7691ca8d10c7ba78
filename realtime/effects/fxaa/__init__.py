"""Fast approximate anti-aliasing: edges are found in the encoded picture, and blended along their slant."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="fxaa",
    terms=("coverage",),
    summary="Where the code values' luma jumps, the edge is followed to both its ends, and a pixel takes as much of "
    "its neighbour across the edge as a line between the ends would cover.",
    citation="Lottes 2009, FXAA, NVIDIA white paper; the search of its version 3.11 (quality)",
    knobs=(
        Knob(
            "threshold",
            0.125,
            "Least difference of luma among the neighbours, over the largest of them, that counts as an edge.",
            low=0.0,
            high=1.0,
            sweep=(0.063, 0.125, 0.166, 0.25, 0.333),
        ),
        Knob("darkest", 0.0625, "Least difference of luma that counts as an edge in the dark.", low=0.0, high=1.0),
        Knob(
            "smoothing",
            0.75,
            "How much of what is smaller than a pixel is taken away; 0 keeps it all.",
            low=0.0,
            high=1.0,
            sweep=(0.0, 0.25, 0.5, 0.75, 1.0),
        ),
        Knob(
            "reach",
            12,
            "How far an edge is followed to each side.",
            unit="pixels",
            low=1,
            high=64,
            sweep=(2, 4, 8, 12, 24),
        ),
    ),
    part="filter",
    optional=True,
    stage="display",
)
