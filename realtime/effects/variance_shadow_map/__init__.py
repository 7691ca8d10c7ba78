"""Variance shadow maps: mean and variance of the depths around a point bound what of the light reaches it."""

from ...effect import Effect, Knob
from ...shadows.knobs import BLEEDING, BLUR, RESOLUTION, biases, with_default

EFFECT = Effect(
    name="variance_shadow_map",
    terms=("visibility",),
    summary="Two moments of the depth are averaged like a picture; Chebyshev's inequality takes them for a visibility.",
    citation="Donnelly & Lauritzen 2006, Variance Shadow Maps, eq. 5; Lauritzen 2007, Summed-Area Variance Shadow "
    "Maps, GPU Gems 3, chapter 8 (light bleeding)",
    knobs=(
        with_default(RESOLUTION, 512),
        BLUR,
        with_default(BLEEDING, 0.2),
        Knob(
            "least_variance",
            1e-6,
            "The variance is taken for this at least, in squares of the scene's depth as the light sees it.",
            low=1e-12,
            high=0.01,
            sweep=(1e-8, 1e-6, 1e-4),
        ),
        *biases(),
    ),
    rank=1,
    channels=("position", "normal"),
)
