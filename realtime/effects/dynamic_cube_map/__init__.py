"""A cube map of the lit scene about each mirroring object, drawn anew every frame."""

from lightmeter.scenes.model import Scene

from ...effect import Effect, Knob
from ...reflections.knobs import AMBIENT, CHANNELS, SAMPLES, SIZE, ambient_radiance
from ...reflections.mirrors import SMOOTH, mirroring_shapes


def unneeded(scene: Scene) -> str:
    """Why the scene does not need it."""
    return "" if mirroring_shapes(scene) else f"no shape that is not flat mirrors with a roughness of {SMOOTH} or less"


EFFECT = Effect(
    name="dynamic_cube_map",
    terms=("indirect",),
    summary="Each smooth object that is not flat reflects what its middle sees; others get constant ambient light.",
    citation="Greene 1986, Environment Mapping and Other Applications of World Projections",
    knobs=(
        SIZE,
        Knob("cubes", 2, "How many objects have a cube map of their own, the largest first.", low=1, high=8),
        SAMPLES,
        AMBIENT,
    ),
    rank=4,
    channels=CHANNELS,
    unneeded=unneeded,
    uniforms=ambient_radiance,
    defines=lambda knobs: {"SAMPLES": int(knobs["samples"])},
)
