"""Percentage-closer soft shadows: penumbrae of emissive surfaces from one depth map."""

from typing import Any

from lightmeter.scenes.model import AreaLight, Light, Scene

from ...effect import Effect, Knob, Knobs
from ...emissive import emissive
from ...shadows.knobs import RESOLUTION, biases, with_default
from .rectangle import half_sides


def uniforms(scene: Scene, _knobs: Knobs, light: Light | None) -> dict[str, Any]:
    """The light's rectangle."""
    if not isinstance(light, AreaLight):
        raise TypeError("pcss takes emissive surfaces only")
    u, v, size = half_sides(scene, light)
    return {"light_u": u, "light_v": v, "light_size": size}


EFFECT = Effect(
    name="pcss",
    terms=("visibility",),
    summary="Blockers in a depth map seen from an emissive surface's centre say how wide its penumbra is filtered.",
    citation="Fernando 2005, Percentage-Closer Soft Shadows; Isidoro 2006, Shadow Mapping: GPU-based Tips and "
    "Techniques (receiver plane depth bias)",
    knobs=(
        with_default(RESOLUTION, 512),
        Knob(
            "samples",
            32,
            "Comparisons over the penumbra's width.",
            low=1,
            high=256,
            sweep=(4, 8, 16, 32, 64),
        ),
        Knob("search_samples", 16, "Texels that are looked at for blockers.", low=1, high=256, sweep=(4, 8, 16, 32)),
        Knob(
            "search",
            0.5,
            "Blockers are looked for over the width that the light has seen from them, were they this share of the way "
            "from light to point: smaller is wider. Of those between, all the way from there to the point.",
            low=0.01,
            high=1.0,
            sweep=(0.2, 0.4, 0.6, 0.8),
        ),
        Knob(
            "blockers",
            "nearer",
            "What shadows: all that is nearer to the light, as published, or what lies between it and the point.",
            choices=("nearer", "between"),
            sweep=("nearer", "between"),
        ),
        *biases(),
    ),
    rank=1,
    channels=("position", "normal"),
    lights=emissive,
    uniforms=uniforms,
)
