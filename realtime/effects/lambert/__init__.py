"""Lambert: the base colour, the same in all directions."""

from ... import punctual
from ...effect import Effect

EFFECT = Effect(
    name="lambert",
    terms=("direct",),
    summary="The whole base colour, a metal's too, is scattered alike in all directions; there is no highlight.",
    citation="Lambert 1760, Photometria; BRDF base/π",
    rank=1,
    channels=("position", "normal", "base_color"),
    lights=punctual.punctual,
    uniforms=punctual.uniforms,
)
