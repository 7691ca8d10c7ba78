"""Automatic exposure from a small picture of logarithms."""

from ...effect import Effect, Knob

EFFECT = Effect(
    name="log_average_exposure",
    terms=("exposure",),
    summary="The logarithm of the luminance is looked up at the places of a small square grid and averaged by mip "
    "levels; no pixel is left out.",
    citation="Reinhard et al. 2002, Photographic Tone Reproduction for Digital Images, eq. 1",
    knobs=(
        Knob(
            "side",
            64,
            "Lookups along each side.",
            choices=(1, 2, 4, 8, 16, 32, 64, 128, 256, 512),
            sweep=(4, 16, 64, 256),
        ),
    ),
)
