"""A cube map of the lit scene, baked once at its middle and looked up by direction."""

from ...effect import Effect
from ...reflections.knobs import AMBIENT, CHANNELS, SAMPLES, SIZE, ambient_radiance
from ...reflections.mirrors import nothing_mirrors

EFFECT = Effect(
    name="static_cube_map",
    terms=("indirect",),
    summary="What stands around the middle of the scene is reflected everywhere, as if it were infinitely far away.",
    citation="Blinn & Newell 1976, Texture and Reflection in Computer Generated Images; Greene 1986, Environment "
    "Mapping and Other Applications of World Projections (cube)",
    knobs=(SIZE, SAMPLES, AMBIENT),
    rank=2,
    channels=CHANNELS,
    unneeded=nothing_mirrors,
    uniforms=ambient_radiance,
    defines=lambda knobs: {"SAMPLES": int(knobs["samples"]), "CUBES": 1},
)
