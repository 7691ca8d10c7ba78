"""Flat shading: few triangles, each with the normal of its own face."""

from lightmeter.scenes.model import Scene
from lightmeter.scenes.true_surface import tessellated

from ...effect import Effect, Knobs
from ...tessellation import PART, TESSELLATION, without_form


def surface(scene: Scene, knobs: Knobs) -> Scene:
    """Every form as facets."""
    return tessellated(scene, int(knobs["tessellation"]), smooth=False)


EFFECT = Effect(
    name="flat_shading",
    terms=("surface",),
    summary="Spheres, tori and cylinders are facets: few triangles, lit by the normals of their faces.",
    citation="Bouknight 1970, A Procedure for Generation of Three-dimensional Half-toned Computer Graphics",
    knobs=(TESSELLATION,),
    rank=1,
    unneeded=without_form,
    part=PART,
    optional=True,
    surface=surface,
)
