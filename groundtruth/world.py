"""A scene as the ground truth holds it: Mitsuba's triangles and emitters, and our tables for the rest."""

from dataclasses import dataclass, field

import numpy as np

from lightmeter.groundtruth import emitters, tables
from lightmeter.groundtruth.bsdf import MASK, SceneBSDF, kind
from lightmeter.groundtruth.emitters import SurfaceEmitter
from lightmeter.groundtruth.environment_map import MapEmitter
from lightmeter.groundtruth.frame import WORLD, Frame
from lightmeter.groundtruth.glass import GlassBSDF
from lightmeter.groundtruth.multiscatter_bsdf import MultiscatterBSDF
from lightmeter.groundtruth.scattering import MULTISCATTER, SINGLE, check_scattering
from lightmeter.groundtruth.surface import ALL_SLOTS
from lightmeter.groundtruth.tables import Tables
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.model import AreaLight, Scene, Shape

RR_DEPTH = 5
"""Depth from which Russian roulette ends paths (design, section 3)."""


@dataclass(eq=False)
class World:
    """A scene, ready to trace rays in. Build it with `World.of`.

    Attributes:
        scene: what it was made from, as it is in `frame`: all that is traced is there, and nowhere else.
        mitsuba: the `mi.Scene`.
        meshes: one `mi.Mesh` per shape, None where a shape has no triangles.
        around: the emitter of the environment, None where there is none.
        tables: the surfaces' attributes.
        masked: whether any material has an alpha mask.
        slots: texture slots (and "color", and the materials' layers) that any shape uses.
        scattering: which truth, see `scattering`.
        frame: the origin and the metre of everything here; positions that come or go are changed by it.
    """

    scene: Scene
    mitsuba: object
    meshes: tuple
    around: object
    tables: Tables
    masked: bool
    slots: frozenset[str]
    scattering: str = SINGLE
    frame: Frame = WORLD
    _alone: dict = field(default_factory=dict)

    @classmethod
    def of(cls, scene: Scene, scattering: str = SINGLE, frame: Frame | None = None) -> "World":
        """Builds the world of a scene.

        Args:
            frame: where it is traced; None: where float32 does best.

        Raises:
            NoRendererError: Mitsuba cannot run here.
            ValueError: the scene has more texels or corners than 32 bits can count, or there is no such truth.
        """
        check_scattering(scattering, scene)
        frame = Frame.of(scene) if frame is None else frame
        scene = frame.scene(scene)
        bsdf_of = MultiscatterBSDF if scattering == MULTISCATTER else SceneBSDF
        kinds = dict.fromkeys(map(_kind, scene.shapes))
        bsdfs = {k: GlassBSDF(*k) if isinstance(k, tuple) else bsdf_of(k) for k in kinds}
        lamps = {light.shape: emitters.area(scene.shapes[light.shape]) for light in scene.area_lights}
        meshes = tuple(
            _mesh(shape, bsdfs[_kind(shape)], lamps.get(index)) if len(shape.mesh.triangles) else None
            for index, shape in enumerate(scene.shapes)
        )
        numbers = [None if mesh is None else _registry_number(mesh) for mesh in meshes]
        table = tables.build(scene, numbers)
        for bsdf in bsdfs.values():
            bsdf.tables = table
        for index, lamp in lamps.items():
            if isinstance(lamp, SurfaceEmitter):
                lamp.bind(table, index)
        parts = {f"shape{i}": mesh for i, mesh in enumerate(meshes) if mesh is not None}
        parts |= {f"light{i}": emitters.punctual(light) for i, light in enumerate(scene.lights)}
        around = None if scene.environment is None else _surroundings(scene)
        if around is not None:
            parts["environment"] = around
        used = {slot for shape in scene.shapes for slot in (*shape.material.textures, *shape.material.layers)}
        if any(shape.mesh.colors is not None for shape in scene.shapes):
            used.add("color")
        return cls(
            scene,
            mi.load_dict({"type": "scene", **parts}, optimize=False),
            meshes,
            around,
            table,
            any(MASK in k for k in bsdfs),
            frozenset(used) & ALL_SLOTS,
            scattering,
            frame,
        )

    def integrator(self, max_depth: int):
        """Mitsuba's path tracer for this world; paths up to `max_depth` (1: emission; −1: unlimited).

        `path` takes an alpha mask's holes for opaque when it tests shadows; `volpath` does not.
        """
        name = "volpath" if self.masked else "path"
        return mi.load_dict({"type": name, "max_depth": max_depth, "rr_depth": RR_DEPTH})

    def alone(self, light: AreaLight):
        """A Mitsuba scene with nothing but an emissive shape."""
        if light.shape not in self._alone:
            scene = mi.load_dict({"type": "scene", "light": self.meshes[light.shape]}, optimize=False)
            self._alone[light.shape] = scene
        return self._alone[light.shape]

    def emitter(self, light: AreaLight):
        """The Mitsuba emitter of an emissive shape."""
        return self.meshes[light.shape].emitter()

    def is_flat(self, light: AreaLight) -> bool:
        """Whether an emissive shape lies in a plane, so that it cannot shadow itself."""
        positions = self.scene.shapes[light.shape].world.positions.astype(np.float64)
        spread = np.linalg.svd(positions - positions.mean(axis=0), compute_uv=False)
        return len(spread) < 3 or bool(spread[2] <= 1e-6 * spread[0])


def _kind(shape: Shape) -> frozenset[str] | tuple:
    """What tells one BSDF instance from another: for solids their index and absorption."""
    material = shape.material
    return (material.ior, material.absorption) if material.is_glass else kind(shape)


def _surroundings(scene: Scene):
    """The emitter of the scene's environment."""
    assert scene.environment is not None, "asked only where there is one"
    if scene.environment.map is None:
        return emitters.constant(scene.environment.radiance)
    corners = np.abs(np.stack([*scene.bounds, scene.camera.position]))
    return MapEmitter(scene.environment, float(np.linalg.norm(corners.max(axis=0))) + 1.0)


def _mesh(shape: Shape, bsdf, emitter):
    """Triangles and nothing else: no normals, no texture coordinates; `uv` at a hit is barycentric then."""
    properties = mi.Properties()
    properties["face_normals"] = True
    properties["bsdf"] = bsdf
    if emitter is not None:
        properties["emitter"] = emitter
    world = shape.world
    mesh = mi.Mesh(shape.name, len(world.positions), len(world.triangles), props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = mi.Float(world.positions.ravel())
    parameters["faces"] = mi.UInt32(world.triangles.ravel())
    parameters.update()
    return mesh


def _registry_number(mesh) -> int:
    return int(dr.reinterpret_array(mi.UInt32, mi.ShapePtr(mesh))[0])
