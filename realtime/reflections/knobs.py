"""The knobs that techniques for reflections share, and the uniforms that follow from them."""

from typing import Any

from lightmeter.scenes.model import Light, Scene

from ..effect import Knob, Knobs
from ..effects.constant_ambient import uniforms as ambient_uniforms

CHANNELS = ("position", "normal", "roughness", "base_color", "metallic", "specular")
AMBIENT = Knob(
    "ambient",
    0.5,
    "What arrives from other surfaces where nothing is reflected, and at what is reflected: constant ambient light, "
    "with the knob `indirect` of constant_ambient.",
    low=0.0,
    high=10.0,
    sweep=(0.0, 0.25, 0.5, 1.0),
)
SAMPLES = Knob(
    "samples",
    1,
    "Directions of the specular lobe for each pixel; 1: the mirror's direction alone, however rough the surface is.",
    low=1,
    high=256,
    sweep=(1, 4, 16),
)
SIZE = Knob(
    "size", 128, "Side of each of a cube's six faces.", unit="texels", low=8, high=2048, sweep=(32, 64, 128, 256, 512)
)


def ambient_radiance(scene: Scene, knobs: Knobs, light: Light | None = None) -> dict[str, Any]:
    """The uniform `ambient_radiance`: of constant ambient light from other surfaces."""
    ambient = ambient_uniforms(scene, {"indirect": knobs["ambient"]}, light)
    return {"ambient_radiance": ambient["indirect_radiance"]}
