"""Makes a mesh and a material fit each other: what a material looks up, its mesh must have."""

from dataclasses import replace

from lightmeter.scenes.model import Material, Mesh
from lightmeter.scenes.tangents import unwelded, with_tangents


def dressed(mesh: Mesh, material: Material) -> tuple[Mesh, Material, tuple[str, ...]]:
    """The mesh with tangents where the material looks along them; the material without unusable textures.

    A flat mesh under a normal texture gets vertices of its own for each triangle. A texture that names a set
    of texture coordinates that the mesh lacks is taken away.

    Returns:
        mesh, material (the same objects where nothing changes), and notes.
    """
    sets = len(mesh.texcoords)
    missing = [slot for slot, texture in material.textures.items() if texture.texcoord >= sets]
    notes = tuple(
        f"the {slot} texture of material {material.name!r} is left out: "
        f"the mesh lacks texture coordinates {material.textures[slot].texcoord}"
        for slot in missing
    )
    if missing:
        material = replace(material, **{f"{slot}_texture": None for slot in missing})
    if material.anisotropy > 0 and sets == 0 and mesh.tangents is None:
        material = replace(material, anisotropy=0.0)
        notes += (f"material {material.name!r} is isotropic: the mesh has neither tangents nor texture coordinates",)
    if material.uses_tangents and (mesh.tangents is None or mesh.normals is None):
        smooth = unwelded(mesh) if mesh.normals is None else mesh
        leading = material.normal_texture or material.clearcoat_normal_texture or material.anisotropy_texture
        mesh = with_tangents(smooth, leading.texcoord if leading else 0)
    return mesh, material, notes
