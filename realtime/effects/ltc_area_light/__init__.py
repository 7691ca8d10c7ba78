"""Linearly transformed cosines: the specular lobe of emissive polygons in closed form, the diffuse one by Lambert's."""

from typing import Any

import numpy as np

from lightmeter.scenes.emitters import emitter, shines_back
from lightmeter.scenes.model import AreaLight, Light, Scene

from ...effect import Effect, Knob, Knobs
from ...emissive import emissive
from .outline import outline
from .table import fitted, tables


def most_corners(knobs: Knobs) -> int:
    """Room in the shader for any light."""
    return max(int(knobs["corners"]), int(knobs["rim"]))


def defines(knobs: Knobs) -> dict[str, object]:
    """Sizes of what the shader reads."""
    return {"MOST_CORNERS": most_corners(knobs), "TABLE_SIDE": len(fitted())}


def uniforms(scene: Scene, knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """The light's polygons and mean radiance."""
    if not isinstance(light, AreaLight):
        raise TypeError("ltc_area_light takes emissive surfaces only")
    facts = emitter(scene, light)
    shape = outline(scene, light, int(knobs["corners"]), int(knobs["rim"]))
    corners = np.zeros((most_corners(knobs), 4))
    corners[: len(shape.corners)] = shape.corners
    return {
        "light_centre": shape.centre,
        "light_radiance": facts.radiance,
        "light_corners": corners,
        "corner_count": len(shape.corners),
        "sphere_radius": shape.sphere_radius,
        "two_sided": shines_back(scene.shapes[light.shape]),
    }


EFFECT = Effect(
    name="ltc_area_light",
    terms=("direct",),
    summary="Emissive polygons light the lobe as a linearly transformed cosine, the base by Lambert's formula.",
    citation="Heitz, Dupuy, Hill & Neubelt 2016, Real-Time Polygonal-Light Shading with Linearly Transformed Cosines; "
    "Lambert 1760, Photometria (the base); Heitz & Hill 2017, Real-Time Line- and Disk-Light Shading (spheres)",
    knobs=(
        Knob(
            "corners",
            48,
            "Most corners of a light's flat pieces together; a finer mesh is lit with as a sphere of the same surface.",
            low=3,
            high=192,
            sweep=(12, 48, 192),
        ),
        Knob(
            "rim",
            12,
            "Corners that stand for the rim of a disk or the outline of a sphere, with the same area.",
            low=3,
            high=64,
            sweep=(4, 8, 16, 32),
        ),
    ),
    rank=2,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    lights=emissive,
    uniforms=uniforms,
    defines=defines,
    tables=tables,
)
