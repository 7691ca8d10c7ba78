"""Flat mirrors: the lit scene drawn again from behind each, by a mirrored camera."""

from lightmeter.scenes.model import Scene

from ...effect import Effect, Knob
from ...reflections.knobs import AMBIENT, CHANNELS, ambient_radiance
from ...reflections.mirrors import SMOOTH, flat_mirrors


def unneeded(scene: Scene) -> str:
    """Why the scene does not need it."""
    return "" if flat_mirrors(scene) else f"no flat shape of a roughness of {SMOOTH} or less mirrors towards the camera"


EFFECT = Effect(
    name="planar_mirror",
    terms=("indirect",),
    summary="The scene is drawn again as each flat mirror shows it; other surfaces get constant ambient light.",
    citation="Diefenbach & Badler 1997, Multi-Pass Pipeline Rendering: Realism for Dynamic Environments (mirrored "
    "view); Lengyel 2005, Oblique View Frustum Depth Projection and Clipping",
    knobs=(
        Knob("mirrors", 2, "How many flat mirrors are drawn, the largest first.", low=1, high=8, sweep=(1, 2, 4)),
        Knob(
            "scale",
            1.0,
            "Side of a mirror's picture, as a share of the frame's.",
            low=0.05,
            high=2.0,
            sweep=(0.25, 0.5, 1.0),
        ),
        AMBIENT,
    ),
    rank=1,
    channels=CHANNELS,
    unneeded=unneeded,
    uniforms=ambient_radiance,
)
