"""A rectangle, disk or sphere that emits, lit with as one point of it: for the lobe, the one the reflection meets."""

import math
from typing import Any

import numpy as np

from lightmeter.scenes.emitters import emitter
from lightmeter.scenes.luminaires import Rectangle, Sphere, recognise
from lightmeter.scenes.model import AreaLight, Light, Scene

from ...effect import Effect, Knob, Knobs

WIDENINGS = {"none": 0.0, "karis": 1 / 3, "mirror": 1 / 2}


def recognised(scene: Scene, light: Light) -> bool:
    """Emissive rectangles, disks and spheres."""
    return isinstance(light, AreaLight) and recognise(scene.shapes[light.shape].world) is not None


def uniforms(scene: Scene, knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """The light's place, size and mean radiance."""
    luminaire = recognise(scene.shapes[light.shape].world) if isinstance(light, AreaLight) else None
    if luminaire is None or not isinstance(light, AreaLight):
        raise TypeError("representative_point takes emissive rectangles, disks and spheres only")
    facts = emitter(scene, light)
    round_light = not isinstance(luminaire, Rectangle)
    extent = np.full(2, luminaire.radius) if not isinstance(luminaire, Rectangle) else luminaire.extent
    return {
        "light_centre": luminaire.centre,
        "light_radiance": facts.radiance,
        "light_axes": np.zeros((3, 3)) if isinstance(luminaire, Sphere) else luminaire.axes,
        "light_extent": extent,
        # π·a·b is the area of the ellipse, 4·x·y that of the rectangle.
        "light_radii": extent if round_light else extent * (2 / math.sqrt(math.pi)),
        "is_sphere": isinstance(luminaire, Sphere),
        "is_round": round_light,
        "two_sided": facts.double_sided,
        "five_points": knobs["diffuse"] == "five",
        "widening": WIDENINGS[str(knobs["normalization"])],
    }


EFFECT = Effect(
    name="representative_point",
    terms=("direct",),
    summary="A rectangle, disk or sphere is lit with as the one point of it that the reflection comes closest to.",
    citation="Karis 2013, Real Shading in Unreal Engine 4, eq. 10-14 (spheres); Lagarde & de Rousiers 2014, Moving "
    "Frostbite to Physically Based Rendering, section 4.8 (flat lights)",
    knobs=(
        Knob(
            "normalization",
            "karis",
            "How the lobe's peak is lowered where the light widens it: not at all; (α/α')² with α' = α + r/(3d) as "
            "published; or with r/(2d), by which a mirror shows the light's own radiance.",
            choices=tuple(WIDENINGS),
            sweep=tuple(WIDENINGS),
        ),
        Knob(
            "diffuse",
            "five",
            "Where the diffuse part takes its cosine: at the light's centre, or as the mean over centre and corners.",
            choices=("centre", "five"),
            sweep=("centre", "five"),
        ),
    ),
    rank=1,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    lights=recognised,
    uniforms=uniforms,
)
