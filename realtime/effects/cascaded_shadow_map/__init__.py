"""Cascaded shadow maps: finer maps for what is nearer to the camera."""

from lightmeter.scenes.model import DirectionalLight, Light, Scene

from ...effect import Effect, Knob
from ...shadows.knobs import COMPARING, RESOLUTION, biases


def directional(_scene: Scene, light: Light) -> bool:
    """Every light without a position."""
    return isinstance(light, DirectionalLight)


EFFECT = Effect(
    name="cascaded_shadow_map",
    terms=("visibility",),
    summary="Slices of what the camera sees have a map each: near shadows are as fine on the screen as far ones.",
    citation="Engel 2006, Cascaded Shadow Maps; Zhang, Sun, Xu & Lun 2006, Parallel-Split Shadow Maps for Large-Scale "
    "Virtual Environments, eq. 6 (the practical split scheme)",
    knobs=(
        RESOLUTION,
        Knob("cascades", 4, "How many slices there are.", low=1, high=4, sweep=(1, 2, 3, 4)),
        Knob(
            "logarithmic",
            0.5,
            "How the slices are cut: 0 evenly in depth, 1 logarithmically, and what lies between.",
            low=0.0,
            high=1.0,
            sweep=(0.0, 0.25, 0.5, 0.75, 1.0),
        ),
        *COMPARING,
        *biases(),
    ),
    rank=1,
    channels=("position", "normal"),
    lights=directional,
)
