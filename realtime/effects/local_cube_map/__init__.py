"""A cube map of the lit scene, baked once at its middle, with the scene's box as what it shows."""

from typing import Any

from lightmeter.scenes.model import Light, Scene

from ...effect import Effect, Knob, Knobs
from ...reflections.cubes import proxy
from ...reflections.knobs import AMBIENT, CHANNELS, SAMPLES, SIZE, ambient_radiance
from ...reflections.mirrors import nothing_mirrors


def uniforms(scene: Scene, knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """The proxy's corners, and ambient light."""
    return proxy(scene, float(knobs["box"])) | ambient_radiance(scene, knobs, light)


EFFECT = Effect(
    name="local_cube_map",
    terms=("indirect",),
    summary="What stands around the middle of the scene is reflected as if it lay on the walls of the scene's box.",
    citation="Lagarde & Zanuttini 2012, Local Image-based Lighting With Parallax-corrected Cubemaps (SIGGRAPH talk)",
    knobs=(
        SIZE,
        SAMPLES,
        AMBIENT,
        Knob(
            "box",
            1.0,
            "Size of the box that stands for what is reflected, as a share of the scene's own box.",
            low=0.01,
            high=100.0,
            sweep=(0.5, 1.0, 2.0),
        ),
    ),
    rank=3,
    channels=CHANNELS,
    unneeded=nothing_mirrors,
    uniforms=uniforms,
    defines=lambda knobs: {"SAMPLES": int(knobs["samples"]), "CUBES": 1},
)
