"""Irradiance probes: the lit scene seen from a grid of points, and between them what they see is interpolated."""

from typing import Any

from lightmeter.scenes.model import Light, Scene

from ...effect import Effect, Knob, Knobs
from .grid import Grid


def unneeded(scene: Scene) -> str:
    """What they see has to be lit."""
    lit = scene.all_lights or (scene.environment is not None and scene.environment.shines)
    return "" if lit else "nothing lights the surfaces that the probes would see"


def uniforms(scene: Scene, knobs: Knobs, _light: Light | None) -> dict[str, Any]:
    """How the grid lies in the world."""
    grid = Grid.of(scene, float(knobs["spacing"]))
    return {"grid_low": grid.low, "grid_step": grid.step, "grid_counts": grid.counts}


def defines(knobs: Knobs) -> dict[str, object]:
    """Whether probes behind the surface count less."""
    return {"FACING": knobs["weights"] == "facing"}


EFFECT = Effect(
    name="irradiance_probes",
    terms=("indirect",),
    summary="Cubes of the lit scene are baked at the points of a grid and kept as irradiance along six axes; a surface "
    "takes what the eight probes around it have, whatever stands between.",
    citation="Greger, Shirley, Hubbard & Greenberg 1998, The Irradiance Volume; McTaggart 2004, Half-Life 2 / Valve "
    "Source Shading (ambient cube); Majercik et al. 2019, Dynamic Diffuse Global Illumination with Ray-Traced "
    "Irradiance Fields (weights=facing)",
    knobs=(
        Knob(
            "spacing",
            0.25,
            "Distance between probes.",
            unit="of the scene's longest side",
            low=0.03,
            high=1.0,
            sweep=(1.0, 0.5, 0.25, 0.125),
        ),
        Knob("size", 16, "Side of the cubes' faces.", unit="texels", low=4, high=128, sweep=(4, 8, 16, 32)),
        Knob(
            "weights",
            "facing",
            "Trilinear, or less of probes that the surface turns its back to.",
            choices=("trilinear", "facing"),
            sweep=("trilinear", "facing"),
        ),
        Knob(
            "ambient",
            0.5,
            "Constant ambient light in what the probes see, for the bounces before: a share of the lights' flux, as "
            "the knob of constant_ambient. 0: the probes give a single bounce.",
            low=0.0,
            high=10.0,
            sweep=(0.0, 0.25, 0.5, 1.0),
        ),
    ),
    rank=7,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    unneeded=unneeded,
    uniforms=uniforms,
    defines=defines,
)
