"""From a checked scene file to a scene."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from lightmeter.scenes import framing, shapes
from lightmeter.scenes.aperture import Aperture
from lightmeter.scenes.checks import Budget, check_shapes
from lightmeter.scenes.dressing import dressed
from lightmeter.scenes.environments import BUILT_IN, built_in, environment_from
from lightmeter.scenes.errors import SceneError, nearest, shown
from lightmeter.scenes.files import inside, read_bytes
from lightmeter.scenes.glass import glass
from lightmeter.scenes.images import read_image
from lightmeter.scenes.metering import Metering
from lightmeter.scenes.model import (
    Camera,
    DirectionalLight,
    Environment,
    Form,
    Image,
    Material,
    Mesh,
    PointLight,
    PunctualLight,
    Scene,
    Shape,
    SpotLight,
    Texture,
    Vector,
)
from lightmeter.scenes.shapes import forms
from lightmeter.scenes.toml import entries
from lightmeter.scenes.toml.placing import placement, unit

COLOURED = ("base_color_texture", "emissive_texture", "sheen_color_texture")
"""The textures whose colours are sRGB-encoded."""

DEFAULT_MATERIAL = "default"


@dataclass
class Builder:
    """Builds one scene file; keeps what several entries share.

    Attributes:
        folder: where relative file names start.
        where: the scene file, for messages.
    """

    folder: Path
    where: str
    images: dict[Path, Image] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    brought_lights: list[PunctualLight] = field(default_factory=list)
    brought_camera: Camera | None = None

    def __post_init__(self):
        self.budget = Budget(self.where)

    def scene(self, file: entries.SceneFile, name: str) -> Scene:
        """The scene that `file` describes, called `name` unless it says otherwise.

        Raises:
            SceneError: a file is missing or damaged, or a name is unknown.
        """
        materials = {key: self.material(key, entry, f"materials.{key}") for key, entry in file.materials.items()}
        made: list[Shape] = []
        for index, entry in enumerate(file.shapes):
            made += self.shapes(entry, index, materials)
        check_shapes(made, self.where)
        lights = [self.light(entry, index) for index, entry in enumerate(file.lights or [])]
        lights += self.brought_lights
        environment = self.environment(file.environment) if file.environment else None
        camera = self.camera(file.camera, made)
        told = file.lights is not None or environment is not None
        if not told and not lights and not framing.gives_light(made):
            lights, environment = framing.default_lights(camera)
            self.notes.append(framing.LIGHTS_NOTE)
        return Scene(
            name=file.name or name,
            shapes=tuple(made),
            camera=camera,
            lights=tuple(lights),
            environment=environment,
            max_depth=file.max_depth,
            summary=file.summary,
            notes=tuple(self.notes),
        )

    def environment(self, entry: entries.EnvironmentEntry) -> Environment:
        if entry.map is None:
            return Environment(entry.radiance)
        if entry.map in BUILT_IN:
            return built_in(entry.map, entry.radiance, entry.rotate, entry.elevation, entry.turbidity)
        path = inside(self.folder, entry.map, f"{self.where}: environment.map")
        return environment_from(path, entry.radiance, entry.rotate, entry.clamp, self.notes.append)

    def camera(self, entry: entries.CameraEntry | None, made: list[Shape]) -> Camera:
        if entry is None:
            if self.brought_camera is not None:
                return self.brought_camera
            self.notes.append(framing.CAMERA_NOTE)
            return framing.framed_camera(made)
        if entry.matrix is not None:
            matrix = framing.rigid(np.array(entry.matrix), f"{self.where}: camera.matrix")
        else:
            assert entry.position is not None and entry.target is not None
            matrix = framing.look_at(entry.position, entry.target, entry.up)
        near, far = framing.clipping_distances(made, matrix)
        far = entry.far or (far if far > (entry.near or 0) else 2 * (entry.near or 0))
        near = entry.near or (near if near < far else 1e-4 * far)
        yfov = None if entry.yfov is None else float(np.radians(entry.yfov))
        metering = None if entry.metering is None else Metering(**entry.metering.model_dump())
        aperture = None if entry.aperture is None else self.aperture(entry.aperture)
        return Camera(entry.name, matrix, yfov, entry.ymag, near, far, entry.exposure, metering, aperture, entry.view)

    def aperture(self, entry: entries.ApertureEntry) -> Aperture:
        rotation = float(np.radians(entry.rotation))
        return Aperture(entry.f_number, entry.blades or 0, rotation, entry.sensor_height)

    def material(self, name: str, entry: entries.MaterialEntry, place: str) -> Material:
        values = {key: getattr(entry, key) for key in entries.MaterialEntry.model_fields}
        tint, distance = values.pop("attenuation_color"), values.pop("attenuation_distance")
        if values.pop("ior") is not None:
            return glass(name, entry.ior, tint, distance)
        for key, value in values.items():
            if isinstance(value, entries.TextureEntry):
                values[key] = self.texture(value, key in COLOURED, f"{place}.{key}")
        values["anisotropy_rotation"] = float(np.radians(entry.anisotropy_rotation))
        return Material(name=name, **values)

    def texture(self, entry: entries.TextureEntry, srgb: bool, place: str) -> Texture:
        where = f"{self.where}: {place}"
        path = inside(self.folder, entry.file, where)
        if path not in self.images:
            self.images[path] = read_image(read_bytes(path, where=where), entry.file, where)
        wrap = entry.wrap or "repeat"
        return Texture(
            image=self.images[path],
            srgb=srgb,
            wrap_u=entry.wrap_u or wrap,
            wrap_v=entry.wrap_v or wrap,
            min_filter=entry.min_filter,
            mag_filter=entry.mag_filter,
            texcoord=entry.texcoord,
            offset=entry.offset,
            rotation=float(np.radians(entry.rotation)),
            scale=entry.scale,
        )

    def light(self, entry: entries.LightEntry, index: int) -> PunctualLight:
        name = entry.name or f"{entry.type} {index}"
        if isinstance(entry, entries.DirectionalEntry):
            return DirectionalLight(name, unit(entry.direction), _times(entry.irradiance, entry.color))
        intensity = _times(entry.intensity, entry.color)
        if isinstance(entry, entries.PointEntry):
            return PointLight(name, entry.position, intensity, entry.range)
        direction = entry.direction
        if direction is None:
            direction = np.subtract(entry.target or (), entry.position)
        inner, outer = np.radians((entry.inner, entry.outer))
        return SpotLight(name, entry.position, unit(direction), intensity, float(inner), float(outer), entry.range)

    def shapes(self, entry: entries.ShapeEntry, index: int, materials: dict[str, Material]) -> list[Shape]:
        place = f"shapes[{index}]"
        where, matrix = f"{self.where}: {place}", placement(entry)
        if not abs(np.linalg.det(matrix[:3, :3])) > 1e-30:
            raise SceneError("this place leaves nothing of the shape", where=where, actual="a determinant of 0")
        name = entry.name or f"{entry.type} {index}"
        if isinstance(entry, entries.GltfEntry):
            return self.whole_gltf(entry, name, matrix, where)
        material = self.painted(entry, materials, where)
        if isinstance(entry, entries.MeshEntry):
            read = self.meshes(entry, name, where)
            return [self.shape(title, mesh, material, matrix @ local) for title, mesh, local in read]
        with _from(where):
            mesh = _SHAPES[type(entry)](entry)
            form = _FORMS[type(entry)](entry) if type(entry) in _FORMS else None
        return [self.shape(name, mesh, material, matrix, form)]

    def shape(self, name: str, mesh: Mesh, material: Material, matrix: np.ndarray, form: Form | None = None) -> Shape:
        mesh, material, notes = dressed(mesh, material)
        self.notes += [f"{name}: {note}" for note in notes]
        self.budget.spend(mesh)
        return Shape(name, mesh, material, matrix, form)

    def painted(self, entry: entries.Painted, materials: dict[str, Material], where: str) -> Material:
        if entry.material is None:
            return materials.get(DEFAULT_MATERIAL, Material(DEFAULT_MATERIAL))
        if entry.material not in materials:
            raise SceneError(
                f"there is no material {shown(entry.material)}",
                where=f"{where}.material",
                remedy=nearest(entry.material, materials) or "add a table [materials.NAME]",
            )
        return materials[entry.material]

    def meshes(self, entry: entries.MeshEntry, name: str, where: str) -> list[tuple[str, Mesh, np.ndarray]]:
        """Name, triangles and place of each mesh in a file."""
        where = f"{where}.file"
        path = inside(self.folder, entry.file, where)
        suffix = path.suffix.lower()
        if suffix in (".gltf", ".glb"):
            scene = self.gltf(path, where)
            self.notes += [f"{name}: {note}" for note in scene.notes if note not in framing.NOTES]
            return [(f"{name}/{s.name}", s.mesh, s.matrix) for s in scene.shapes]
        if suffix == ".obj":
            from lightmeter.scenes.obj import load_obj as read
        elif suffix == ".ply":
            from lightmeter.scenes.ply import load_ply as read
        else:
            raise SceneError(
                "this is no mesh file", where=where, expected=".obj, .ply, .gltf or .glb", actual=entry.file
            )
        with _from(where):
            mesh, notes = read(path)
        self.notes += [f"{name}: {note}" for note in notes]
        return [(name, mesh, np.eye(4))]

    def gltf(self, path: Path, where: str) -> Scene:
        from lightmeter.scenes.gltf import load_gltf

        with _from(where):
            return load_gltf(path)

    def whole_gltf(self, entry: entries.GltfEntry, name: str, matrix: np.ndarray, where: str) -> list[Shape]:
        scene = self.gltf(inside(self.folder, entry.file, f"{where}.file"), f"{where}.file")
        self.notes += [f"{name}: {note}" for note in scene.notes if note not in framing.NOTES]
        if framing.LIGHTS_NOTE not in scene.notes and entry.lights:
            self.brought_lights += [_moved(light, matrix) for light in scene.lights]
        if framing.CAMERA_NOTE not in scene.notes and self.brought_camera is None:
            moved = framing.rigid(matrix @ scene.camera.matrix, where)
            self.brought_camera = replace(scene.camera, matrix=moved)
        for shape in scene.shapes:
            self.budget.spend(shape.mesh)
        return [replace(s, name=f"{name}/{s.name}", matrix=matrix @ s.matrix) for s in scene.shapes]


_SHAPES: dict[type, Callable[..., Mesh]] = {
    entries.PlaneEntry: lambda e: shapes.plane(e.width, e.depth, e.segments),
    entries.RectangleEntry: lambda e: shapes.rectangle(e.width, e.height, e.segments),
    entries.BoxEntry: lambda e: shapes.box(e.width, e.height, e.depth, e.segments),
    entries.SphereEntry: lambda e: shapes.sphere(e.radius, e.segments, e.rings),
    entries.TorusEntry: lambda e: shapes.torus(e.major, e.minor, e.segments, e.rings),
    entries.CylinderEntry: lambda e: shapes.cylinder(e.radius, e.height, e.segments, e.rings, e.caps),
    entries.ConeEntry: lambda e: shapes.cone(e.radius, e.height, e.segments, e.rings, e.cap),
    entries.DiskEntry: lambda e: shapes.disk(e.radius, e.segments),
}

_FORMS: dict[type, Callable[..., Form]] = {
    entries.SphereEntry: lambda e: forms.Sphere(e.radius),
    entries.TorusEntry: lambda e: forms.Torus(e.major, e.minor),
    entries.CylinderEntry: lambda e: forms.Cylinder(e.radius, e.height, e.caps),
}


@contextmanager
def _from(where: str) -> Iterator[None]:
    """Puts the place that names a file before whatever is wrong in the file."""
    try:
        yield
    except SceneError as error:
        raise error.within(where) from None


def _times(radiant: Vector, color: Vector) -> Vector:
    return radiant[0] * color[0], radiant[1] * color[1], radiant[2] * color[2]


def _moved(light: PunctualLight, matrix: np.ndarray) -> PunctualLight:
    """The light at another place; its strength is not scaled."""
    if not isinstance(light, PointLight):
        light = replace(light, direction=unit(matrix[:3, :3] @ np.array(light.direction)))
    if not isinstance(light, DirectionalLight):
        x, y, z = matrix[:3, :3] @ np.array(light.position) + matrix[:3, 3]
        light = replace(light, position=(float(x), float(y), float(z)))
    return light
