"""From an open glTF file to a scene."""

from pathlib import Path

import numpy as np

from lightmeter.scenes import framing
from lightmeter.scenes.checks import Budget, check_shapes
from lightmeter.scenes.dressing import dressed
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.gltf.cameras import Placed, choose, read_camera
from lightmeter.scenes.gltf.container import open_container
from lightmeter.scenes.gltf.features import note_features
from lightmeter.scenes.gltf.geometry import read_primitive
from lightmeter.scenes.gltf.hierarchy import placed_nodes
from lightmeter.scenes.gltf.lights import Punctuals
from lightmeter.scenes.gltf.materials import Materials
from lightmeter.scenes.gltf.source import Source
from lightmeter.scenes.model import Material, Mesh, PunctualLight, Scene, Shape


def load_gltf(path: Path, camera: str | int | None = None) -> Scene:
    """The scene in a `.gltf` or `.glb` file; files that it names lie in its folder or below.

    Without a camera it gets a framed one, without lights the default rig (`lightmeter.scenes.framing`). Light
    is a punctual light, or a material that emits evenly; emission through a texture is taken for a detail such
    as a lamp or a screen and does not keep the rig away. Whatever the file uses and is not read is in the notes.

    Args:
        path: the file.
        camera: which camera, by its name, its node's name or its number from 0; the first unless given.

    Raises:
        SceneError: the file is missing, damaged, not valid, or requires an unsupported extension.
    """
    container = open_container(Path(path))
    source = Source(container)
    if not source.document.asset.version.startswith("2."):
        raise SceneError(
            "this version of glTF is not supported",
            where=source.at("asset.version"),
            expected="2.x",
            actual=source.document.asset.version[:20],
        )
    note_features(source, container.content)
    shapes, lights, cameras = _Assembly(source).walk()
    if not shapes:
        raise SceneError("the file has no triangles to show", where=source.where, remedy="; ".join(source.notes[:3]))
    chosen = choose(source, cameras, camera)
    environment = None
    check_shapes(shapes, source.where)
    if chosen is None:
        source.note(framing.CAMERA_NOTE)
        view = framing.framed_camera(shapes)
    else:
        view = read_camera(source, chosen, shapes)
    if not lights and not framing.gives_light(shapes):
        source.note(framing.LIGHTS_NOTE)
        lights, environment = framing.default_lights(view)
    return Scene(
        name=Path(path).stem,
        shapes=tuple(shapes),
        camera=view,
        lights=tuple(lights),
        environment=environment,
        notes=tuple(source.notes),
    )


class _Assembly:
    """Shapes, lights and cameras, node by node."""

    def __init__(self, source: Source):
        self._source = source
        self._materials = Materials(source)
        self._punctuals = Punctuals(source)
        self._dressed: dict[tuple[int, int], tuple[Mesh, Material] | None] = {}
        self._shapes: list[Shape] = []
        self._blended: list[str] = []
        self._budget = Budget(source.where)

    def walk(self) -> tuple[list[Shape], list[PunctualLight], list[Placed]]:
        lights: list[PunctualLight] = []
        cameras: list[Placed] = []
        for index, node, world in placed_nodes(self._source):
            if node.mesh is not None:
                self._add_mesh(node.mesh, node.name, index, world)
            if node.camera is not None:
                cameras.append((index, node, world))
            light = self._punctuals.at(node, index, world)
            if light is not None:
                lights.append(light)
        if self._blended:
            names = ", ".join(self._blended[:20]) + (", …" if len(self._blended) > 20 else "")
            self._source.note(
                f"alpha-blended shapes are left out of both pictures: {names}. What lies behind them is seen "
                "uncovered in both, and the comparison says nothing about them"
            )
        return self._shapes, lights, cameras

    def _add_mesh(self, index: int, node_name: str, node: int, world: np.ndarray) -> None:
        source = self._source
        mesh = source.get("meshes", source.document.meshes, index, f"nodes[{node}].mesh")
        title = node_name or mesh.name or f"node {node}"
        if abs(np.linalg.det(world[:3, :3])) < 1e-30:
            source.note(f"{title} is left out of both pictures: it is scaled to nothing")
            return
        for number in range(len(mesh.primitives)):
            name = title if len(mesh.primitives) == 1 else f"{title}/{number}"
            key = (index, number)
            if key not in self._dressed:
                self._dressed[key] = self._primitive(index, number, name)
            found = self._dressed[key]
            if found is None:
                if self._is_blended(key) and name not in self._blended:
                    self._blended.append(name)
                continue
            self._budget.spend(found[0])
            self._shapes.append(Shape(name, *found, world))

    def _is_blended(self, key: tuple[int, int]) -> bool:
        part = self._source.document.meshes[key[0]].primitives[key[1]]
        if part.mode <= 3 or part.material is None:
            return False
        where = f"meshes[{key[0]}].primitives[{key[1]}].material"
        materials = self._source.document.materials
        return self._source.get("materials", materials, part.material, where).alpha_mode == "BLEND"

    def _primitive(self, index: int, number: int, name: str) -> tuple[Mesh, Material] | None:
        """A primitive's mesh and material, fitted to each other; None where it is left out."""
        source = self._source
        part = source.document.meshes[index].primitives[number]
        mesh = read_primitive(source, part, f"meshes[{index}].primitives[{number}]")
        if mesh is None or self._materials.blended(part.material, mesh):
            return None
        material = self._materials.material(part.material)
        mesh, material, notes = dressed(mesh, material)
        for note in notes:
            source.note(f"{name}: {note}")
        return mesh, material
