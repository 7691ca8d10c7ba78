"""Shadow maps: one for directional and spot lights, a cube of six for point lights and emissive surfaces."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="shadow_map",
    terms=("visibility",),
    summary="A depth map seen from the light says what it reaches; hard, or filtered over 3 × 3 texels.",
    citation="Williams 1978, Casting Curved Shadows on Curved Surfaces; Reeves, Salesin & Cook 1987, Rendering "
    "Antialiased Shadows with Depth Maps (percentage-closer filtering)",
    knobs=(
        Knob(
            "resolution",
            1024,
            "Side of the map, or of each of a cube's six faces.",
            unit="texels",
            low=16,
            high=8192,
            sweep=(128, 256, 512, 1024, 2048, 4096),
        ),
        Knob(
            "filter",
            "pcf3",
            "One comparison, or the mean of 3 × 3 neighbouring ones.",
            choices=("hard", "pcf3"),
            sweep=("hard", "pcf3"),
        ),
        Knob(
            "bias",
            0.5,
            "How far a point is moved towards the light before it is compared.",
            unit="texels",
            low=0.0,
            high=100.0,
            sweep=(0.0, 0.5, 1.0, 2.0),
        ),
        Knob(
            "slope_bias",
            1.0,
            "The same, times the slope against the light and the filter's radius.",
            low=0.0,
            high=100.0,
            sweep=(0.0, 0.5, 1.0, 2.0),
        ),
    ),
    channels=("position", "normal"),
)
