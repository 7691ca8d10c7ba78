"""Gouraud shading: few triangles, lit at their vertices, the colours interpolated in between."""

from lightmeter.scenes.model import AreaLight, Scene
from lightmeter.scenes.true_surface import tessellated

from ... import punctual
from ...effect import Effect, Knob, Knobs
from ...tessellation import PART, TESSELLATION, without_form


def surface(scene: Scene, knobs: Knobs) -> Scene:
    """Every form as few triangles with normals at the vertices."""
    return tessellated(scene, int(knobs["tessellation"]))


def unneeded(scene: Scene) -> str:
    """It takes forms and punctual lights; a vertex knows no texture, and no hole of an alpha mask."""
    if any(shape.material.textures or shape.material.alpha_mode == "mask" for shape in scene.shapes):
        return "it lights vertices, and looks no textures up"
    if all(isinstance(light, AreaLight) for light in scene.all_lights):
        return "the scene has no light of the kinds it handles"
    return without_form(scene)


EFFECT = Effect(
    name="gouraud",
    terms=("surface", "direct"),
    summary="Spheres, tori and cylinders are few triangles; all shapes are lit at vertices, and colours interpolated.",
    citation="Gouraud 1971, Continuous Shading of Curved Surfaces, IEEE Transactions on Computers C-20 (6), page 623",
    knobs=(
        TESSELLATION,
        Knob(
            "model",
            "cook_torrance",
            "The effect whose shading the vertices get, with its defaults.",
            choices=("cook_torrance", "blinn_phong", "phong", "lambert"),
            sweep=("cook_torrance", "blinn_phong", "lambert"),
        ),
    ),
    rank=-1,
    channels=("position", "normal"),
    lights=punctual.punctual,
    unneeded=unneeded,
    part=PART,
    optional=True,
    surface=surface,
)
