"""Virtual lights: light that other surfaces scatter, as many small lights where the light's own rays end."""

from typing import Any

import numpy as np

from lightmeter.scenes.emitters import flux
from lightmeter.scenes.model import Light, Scene

from ...effect import Effect, Knob, Knobs


def unneeded(scene: Scene) -> str:
    """They start at lights; what the environment brings they do not pass on."""
    shines = any(np.any(flux(scene, light) > 0) for light in scene.all_lights)
    return "" if shines else "the scene has no lights for surfaces to scatter"


def uniforms(scene: Scene, knobs: Knobs, _light: Light | None) -> dict[str, Any]:
    """Distances in metres."""
    low, high = scene.bounds
    diagonal = float(np.linalg.norm(high - low))
    return {
        "nearest": float(knobs["clamp"]) * diagonal,
        "planes": np.array([1e-3, 1.01]) * max(diagonal, 1e-30),
    }


def defines(knobs: Knobs) -> dict[str, object]:
    """The permutation: what is not chosen costs nothing."""
    return {
        "MAPS": knobs["visibility"] == "maps",
        "MAP_SIZE": int(knobs["map_size"]),
        "TILE": int(knobs["tile"]),
        "LOBES": {"all": "all_lobes", "diffuse": "diffuse_only"}[str(knobs["lobes"])],
    }


EFFECT = Effect(
    name="virtual_lights",
    terms=("indirect",),
    summary="Reflective shadow maps say where rays of the lights end; each end shines on as a small Lambert patch.",
    citation="Keller 1997, Instant Radiosity; Dachsbacher & Stamminger 2005, Reflective Shadow Maps; Ritschel et al. "
    "2008, Imperfect Shadow Maps (points over the scene, a low map for each light); Segovia et al. 2006, "
    "Non-interleaved Deferred Shading of Interleaved Sample Patterns",
    knobs=(
        Knob("lights", 128, "Virtual lights for each bounce.", low=1, high=4096, sweep=(16, 64, 256, 1024)),
        Knob(
            "clamp",
            0.05,
            "A virtual light counts as no nearer than this: without it each shows as a bright spot around it; with it "
            "corners are too dark.",
            unit="of the scene's diagonal",
            low=0.0,
            high=1.0,
            sweep=(0.0, 0.02, 0.05, 0.1, 0.2),
        ),
        Knob(
            "bounces",
            1,
            "How often light is scattered before it comes here; the second time at points all over the scene.",
            choices=(1, 2),
            sweep=(1, 2),
        ),
        Knob(
            "visibility",
            "none",
            "Whether something may stand between a virtual light and a point: a low depth map for each says.",
            choices=("none", "maps"),
            sweep=("none", "maps"),
        ),
        Knob("map_size", 64, "Resolution of these maps.", unit="texels", low=8, high=128, sweep=(16, 32, 64, 128)),
        Knob(
            "tile",
            1,
            "Interleaved sampling: side of a square of pixels that share out the virtual lights among them; what each "
            "finds is averaged over as large a square of like pixels. 1: every pixel takes every light.",
            unit="pixels",
            low=1,
            high=8,
            sweep=(1, 2, 4, 8),
        ),
        Knob(
            "lobes",
            "all",
            "What is lit by them: the whole material, where each shows as a highlight, or its diffuse base only.",
            choices=("all", "diffuse"),
            sweep=("all", "diffuse"),
        ),
        Knob(
            "resolution",
            64,
            "Texels along a side of the reflective shadow map, each of six where a light shines all around.",
            unit="texels",
            low=16,
            high=1024,
            sweep=(32, 64, 128, 256),
        ),
        Knob(
            "emitter_points",
            4,
            "Points on an emissive surface that have a reflective shadow map each.",
            low=1,
            high=64,
            sweep=(1, 4, 8, 16),
        ),
    ),
    rank=5,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    unneeded=unneeded,
    uniforms=uniforms,
    defines=defines,
)
