"""A scene as glTF 2.0: the JSON document, the binary buffer and the images."""

from dataclasses import dataclass
from typing import Any

from ..model import Material, Mesh, Scene
from . import nodes
from .geometry import Geometry, placed
from .materials import Materials

BINARY_FILE = "scene.bin"


@dataclass(frozen=True)
class GltfFiles:
    """What a glTF consists of.

    Attributes:
        content: the JSON document.
        files: the files that it names, by their path relative to it: the buffer (where there is any triangle) and
            the images.
        notes: what glTF cannot say, or an engine may not read as it is meant.
    """

    content: dict[str, Any]
    files: dict[str, bytes]
    notes: tuple[str, ...]


def gltf_files(scene: Scene, size: tuple[int, int]) -> GltfFiles:
    """The scene as glTF: node i is shape i (without a mesh where it has no triangle), then the lights, then the camera.

    glTF has no environment; it is left out. Light intensities are the radiometric numbers as they are.

    Args:
        scene: the scene.
        size: the image's width and height in pixels; the camera's aspect ratio.

    Raises:
        SceneError: PNG cannot hold a texture, or glTF would decode it otherwise.
    """
    geometry, materials, notes = Geometry(), Materials(), []
    meshes: dict[tuple[Mesh, Material], int] = {}
    placements = []
    for shape in scene.shapes:
        mesh, matrix = placed(shape)
        if mesh is not shape.mesh:
            notes.append(
                f"{shape.name} is written in world space: a glTF node cannot shear or flatten as its matrix does"
            )
        content = {}
        if len(mesh.triangles):
            content["mesh"] = meshes.setdefault((mesh, shape.material), len(meshes))
        placements.append(nodes.node(shape.name, matrix, **content))
    primitives = [geometry.primitive(mesh) | {"material": materials.number(made)} for mesh, made in meshes]
    lights = [nodes.light(light) for light in scene.lights]
    for number, (light, matrix) in enumerate(lights):
        reference = {nodes.PUNCTUAL: {"light": number}}
        placements.append(nodes.node(light["name"], matrix, extensions=reference))
    placements.append(nodes.node(scene.camera.name, scene.camera.matrix, camera=0))
    extensions = materials.extensions | materials.textures.extensions | ({nodes.PUNCTUAL} if lights else set())
    content = {
        "asset": {"version": "2.0", "generator": "lightmeter"},
        "extensionsUsed": sorted(extensions),
        "extensions": {nodes.PUNCTUAL: {"lights": [light for light, _ in lights]}} if lights else {},
        "scene": 0,
        "scenes": [{"name": scene.name, "nodes": list(range(len(placements)))}],
        "nodes": placements,
        "cameras": [nodes.camera(scene.camera, size[0] / size[1])],
        "meshes": [{"primitives": [primitive]} for primitive in primitives],
        "materials": materials.materials,
        "textures": materials.textures.textures,
        "images": materials.textures.images,
        "samplers": materials.textures.samplers,
        "accessors": geometry.accessors,
        "bufferViews": geometry.views,
        "buffers": [{"uri": BINARY_FILE, "byteLength": len(geometry.binary)}] if geometry.binary else [],
    }
    files = ({BINARY_FILE: bytes(geometry.binary)} if geometry.binary else {}) | materials.textures.files
    # glTF allows no empty arrays (JSON schema, minItems).
    content = {key: value for key, value in content.items() if value not in ([], {})}
    return GltfFiles(content, files, (*notes, *materials.textures.notes))
