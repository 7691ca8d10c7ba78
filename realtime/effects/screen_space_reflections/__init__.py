"""Reflections of what the camera sees: rays are marched through the G-buffer's depths."""

from typing import Any

import numpy as np

from lightmeter.scenes.model import Light, Scene

from ...effect import Effect, Knob, Knobs
from ...reflections.knobs import AMBIENT, CHANNELS, SAMPLES, ambient_radiance
from ...reflections.mirrors import nothing_mirrors


def uniforms(scene: Scene, knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """How thick surfaces are taken to be, in metres; and ambient light."""
    low, high = scene.bounds
    metres = float(knobs["thickness"]) * float(np.linalg.norm(high - low))
    return {"thickness": metres, "reach": float(np.linalg.norm(high - low))} | ambient_radiance(scene, knobs, light)


def defines(knobs: Knobs) -> dict[str, object]:
    """Counts, and the functions that are chosen."""
    found: dict[str, object] = {name.upper(): int(knobs[name]) for name in ("samples", "steps", "refinements")}
    found |= {"MARCH": f"march_{knobs['march']}", "HIERARCHICAL": knobs["march"] == "hierarchical"}
    unmet = {"none": "vec3(0.0)", "ambient": "ambient_radiance"}
    return found | {"UNMET": unmet.get(str(knobs["fallback"]))}


EFFECT = Effect(
    name="screen_space_reflections",
    terms=("indirect",),
    summary="Rays are marched over the screen to the first depth they pass; what is lit there is reflected.",
    citation="McGuire & Mara 2014, Efficient GPU Screen-Space Ray Tracing; Uludag 2014, Hi-Z Screen-Space Cone-Traced "
    "Reflections (GPU Pro 5; march=hierarchical)",
    knobs=(
        Knob(
            "march",
            "linear",
            "Equal steps over the screen, or cells of a pyramid of least depths that are skipped whole.",
            choices=("linear", "hierarchical"),
            sweep=("linear", "hierarchical"),
        ),
        Knob(
            "steps",
            64,
            "Most steps of a ray: of equal length and at least a pixel (linear), or cells (hierarchical).",
            low=1,
            high=4096,
            sweep=(8, 16, 32, 64, 128, 256),
        ),
        Knob(
            "refinements",
            4,
            "Halvings of the step that met a surface (linear).",
            low=0,
            high=16,
            sweep=(0, 2, 4, 8),
        ),
        Knob(
            "thickness",
            0.05,
            "How far behind a seen surface a ray still meets it, as a share of the scene's diagonal.",
            low=0.0,
            high=1.0,
            sweep=(0.01, 0.02, 0.05, 0.1, 0.5),
        ),
        Knob(
            "fallback",
            "cube",
            "What a ray that meets nothing sees: nothing, constant ambient light, or the scene's baked cube map.",
            choices=("none", "ambient", "cube"),
            sweep=("none", "ambient", "cube"),
        ),
        SAMPLES,
        AMBIENT,
    ),
    rank=5,
    channels=CHANNELS,
    reads_scattered=True,
    verdicts=("none", "met", "left", "hidden", "open"),
    unneeded=nothing_mirrors,
    uniforms=uniforms,
    defines=defines,
)
