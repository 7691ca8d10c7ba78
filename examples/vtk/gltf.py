"""The shapes and materials of a glTF file, by VTK's own importer, and what that importer leaves out."""

import math
from collections.abc import Iterator
from pathlib import Path

import vtk

F0 = 0.04  # glTF's dielectrics, at KHR_materials_specular's factor 1


def import_shapes(path: Path, document: dict, window: vtk.vtkRenderWindow) -> None:
    """Put the shapes into the window's renderer; lights and cameras are not taken from here.

    VTK's importer leaves out two extensions that VTK's material has a place for, and that a mirroring matrix turns
    triangles round (glTF, 3.7.4); that is made up for here.
    """
    importer = vtk.vtkGLTFImporter()
    importer.SetFileName(str(path))
    importer.SetRenderWindow(window)
    importer.Update()
    actors = importer.GetImportedActors()
    materials = list(_in_the_importers_order(document))
    if len(materials) != actors.GetNumberOfItems():
        raise SystemExit(f"{path}: VTK read {actors.GetNumberOfItems()} shapes, expected {len(materials)}")
    for index, material in enumerate(materials):
        actor = actors.GetItemAsObject(index)
        if actor.GetUserMatrix().Determinant() < 0:
            _turn_round(actor.GetMapper())
        actor.ForceTranslucentOff()  # an alpha mask's: the shadow passes would leave the shape out
        surface = actor.GetProperty()
        specular = _extension(material, "specular").get("specularFactor", 1.0)
        root = math.sqrt(F0 * specular)
        surface.SetBaseIOR((1 + root) / (1 - root))  # Fresnel at normal incidence, solved for n
        strength = _extension(material, "emissive_strength").get("emissiveStrength", 1.0)
        surface.SetEmissiveFactor([strength * channel for channel in material.get("emissiveFactor", (0, 0, 0))])


def _turn_round(mapper: vtk.vtkPolyDataMapper) -> None:
    """Reverse the triangles' vertices and leave the normals."""
    reverse = vtk.vtkReverseSense()
    reverse.SetInputData(mapper.GetInput())
    reverse.ReverseCellsOn()
    reverse.ReverseNormalsOff()
    reverse.Update()
    mapper.SetInputData(reverse.GetOutput())


def what_vtk_lacks(document: dict) -> dict[str, str]:
    """Materials that VTK draws otherwise than glTF says, by name, with the reason."""
    found = {}
    for index, material in enumerate(document.get("materials", [])):
        reasons = list(_lacks(material, document))
        if reasons:
            found[material.get("name", f"materials[{index}]")] = "; ".join(reasons)
    return found


def _lacks(material: dict, document: dict) -> Iterator[str]:
    pbr = material.get("pbrMetallicRoughness", {})
    textures = {
        "baseColorTexture": pbr.get("baseColorTexture"),
        "metallicRoughnessTexture": pbr.get("metallicRoughnessTexture"),
        **{slot: material.get(slot) for slot in ("normalTexture", "occlusionTexture", "emissiveTexture")},
    }
    used = {slot: texture for slot, texture in textures.items() if texture}
    if material.get("alphaMode", "OPAQUE") != "OPAQUE":
        yield "drawn opaque, without the holes of its alpha mask"
    if used and "baseColorTexture" not in used:
        yield f"{', '.join(used)} left out, since there is no baseColorTexture"
    if max(material.get("emissiveFactor", (0, 0, 0))) > 0 and not {"baseColorTexture", "emissiveTexture"} <= set(used):
        yield "emission that no texture gives is not drawn"
    if "occlusionTexture" in used and "metallicRoughnessTexture" not in used:
        yield "occlusionTexture left out, since there is no metallicRoughnessTexture"
    if len({texture.get("texCoord", 0) for texture in used.values()}) > 1:
        yield "several sets of texture coordinates"
    samplers = [_sampler(texture["index"], document) for texture in used.values()]
    if any(sampler.get(wrap) == 33648 for sampler in samplers for wrap in ("wrapS", "wrapT")):
        yield "mirrored texture wrapping"


def _sampler(texture: int, document: dict) -> dict:
    index = document["textures"][texture].get("sampler")
    return {} if index is None else document["samplers"][index]


def _extension(material: dict, name: str) -> dict:
    return material.get("extensions", {}).get(f"KHR_materials_{name}", {})


def _in_the_importers_order(document: dict) -> Iterator[dict]:
    """The material of every primitive; the importer keeps a stack of nodes, so that the last comes first."""
    waiting = list(document["scenes"][document.get("scene", 0)].get("nodes", []))
    while waiting:
        node = document["nodes"][waiting.pop()]
        if "mesh" in node:
            for primitive in document["meshes"][node["mesh"]]["primitives"]:
                yield document["materials"][primitive["material"]] if "material" in primitive else {}
        waiting += node.get("children", [])
