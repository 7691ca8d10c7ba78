"""Shadow maps: one for directional and spot lights, a cube of six for point lights and emissive surfaces."""

from ...effect import Effect
from ...shadows.knobs import COMPARING, RESOLUTION, biases

EFFECT = Effect(
    name="shadow_map",
    terms=("visibility",),
    summary="A depth map seen from the light says what it reaches: hard, or filtered over neighbouring texels.",
    citation="Williams 1978, Casting Curved Shadows on Curved Surfaces; Reeves, Salesin & Cook 1987, Rendering "
    "Antialiased Shadows with Depth Maps (percentage-closer filtering); Isidoro 2006, Shadow Mapping: GPU-based Tips "
    "and Techniques (a rotated Poisson disk); Holbert 2011, Saying Goodbye to Shadow Acne (normal offset); Wang & "
    "Molnar 1994, Second-Depth Shadow Mapping (faces=back)",
    knobs=(RESOLUTION, *COMPARING, *biases()),
    channels=("position", "normal"),
)
