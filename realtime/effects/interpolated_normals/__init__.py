"""Phong's interpolation: few triangles, the true normals at their vertices, interpolated and normalised in between."""

from lightmeter.scenes.model import Scene
from lightmeter.scenes.true_surface import tessellated

from ...effect import Effect, Knobs
from ...tessellation import PART, TESSELLATION, without_form


def surface(scene: Scene, knobs: Knobs) -> Scene:
    """Every form as few triangles with normals at the vertices."""
    return tessellated(scene, int(knobs["tessellation"]))


EFFECT = Effect(
    name="interpolated_normals",
    terms=("surface",),
    summary="Spheres, tori and cylinders are few triangles, lit by normals that are interpolated from the vertices.",
    citation="Phong 1975, Illumination for Computer Generated Pictures, Communications of the ACM 18 (6), page 315",
    knobs=(TESSELLATION,),
    unneeded=without_form,
    part=PART,
    optional=True,
    surface=surface,
)
