"""Minnaert: Lambert with limbs that are darker, or brighter, than a matt ball's."""

from ... import punctual
from ...effect import Effect, Knob

EFFECT = Effect(
    name="minnaert",
    terms=("direct",),
    summary="The whole base colour, a metal's too, times a power of the cosines to light and viewer.",
    citation="Minnaert 1941, The Reciprocity Principle in Lunar Photometry; BRDF base/π · (n·l · n·v)^(k − 1)",
    knobs=(
        Knob(
            "exponent",
            0.8,
            "Minnaert's k: 1 is Lambert, below (the Moon's is near 0.5) the limb is brighter and grazing views return "
            "more than they get, above it is darker.",
            low=0.0,
            high=4.0,
            sweep=(0.5, 0.65, 0.8, 1.0, 1.25, 1.5),
        ),
    ),
    rank=1,
    channels=("position", "normal", "base_color"),
    lights=punctual.punctual,
    uniforms=punctual.uniforms,
)
