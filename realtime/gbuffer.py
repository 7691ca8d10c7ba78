"""The G-buffer: one draw per shape into the attachments that somebody reads."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from lightmeter.scenes.layers import COAT, GLASS, GRAIN, LAYER_CHANNELS, SHEEN, layer_channels
from lightmeter.scenes.model import Camera, Material, Scene, Texture, Vector
from lightmeter.scenes.optics.sheen import albedo_table
from lightmeter.scenes.points import SurfacePoints

from . import layout
from .background import Background
from .device import Device
from .geometry import Batch, Geometry
from .projection import projection_matrix, view_matrix, viewer, world_from_pixel
from .shaders import Source, source
from .uniforms import Uniforms, bind, set_uniforms

BASE = ("position", "normal", "roughness", "base_color", "metallic", "specular", "occlusion")
LAYERED = (*COAT, *GRAIN, *SHEEN, *GLASS)
CHANNELS = (*BASE, *LAYERED)
"""What effects may read. A channel that is the same everywhere, or of a layer that no material has, costs nothing."""


PARTS: dict[str, tuple[str, slice | int]] = {
    "position": ("position", slice(3)),
    "normal": ("normal_roughness", slice(3)),
    "roughness": ("normal_roughness", 3),
    "base_color": ("base_color_metallic", slice(3)),
    "metallic": ("base_color_metallic", 3),
    "specular": ("specular_occlusion", 0),
    "occlusion": ("specular_occlusion", 1),
    "clearcoat": ("clearcoat_factors", 0),
    "clearcoat_roughness": ("clearcoat_factors", 1),
    "clearcoat_normal": ("clearcoat_normal", slice(3)),
    "anisotropy": ("grain", 3),
    "anisotropy_direction": ("grain", slice(3)),
    "sheen_color": ("sheen", slice(3)),
    "sheen_roughness": ("sheen", 3),
    "absorption": ("glass", slice(3)),
    "ior": ("glass", 3),
}
"""Where in the attachments of floats each channel lies."""


def constant_channels(scene: Scene) -> dict[str, float | Vector]:
    """The channels that hold one value all over the scene, with that value."""
    materials = [shape.material for shape in scene.shapes] or [Material()]
    slots = {slot for material in materials for slot in material.textures}
    varying = {
        "base_color": "base_color" in slots or any(shape.mesh.colors is not None for shape in scene.shapes),
        "metallic": "metallic_roughness" in slots,
        "roughness": "metallic_roughness" in slots,
        "specular": False,
    }
    varying |= {name: name in slots for name in layer_channels(scene) if name in (*COAT[:2], *SHEEN)}
    constants: dict[str, float | Vector] = {} if "occlusion" in slots else {"occlusion": 1.0}
    for name, varies in varying.items():
        values = {getattr(material, name) for material in materials}
        if len(values) == 1 and not varies:
            constants[name] = values.pop()
    return constants


@dataclass(frozen=True, eq=False)
class Draw:
    """One shape, ready to be drawn into the G-buffer."""

    program: Any
    vertices: Any
    count: int
    uniforms: Uniforms
    textures: dict[str, Any]


class GBuffer:
    """Renders the surface's parameters; where they are more than a draw can write, in groups, one after another.

    Args:
        channels: those that are read; the rest is left out, and what belongs to layers that no material has.
        radiance: the texture that emission and the environment behind everything go to; None: they are left out.
        identity: whether each pixel's shape and triangle are written too (for the oracles).
        stored: formats of channels, see `layout.py`; those without one are kept in floats.

    Attributes:
        shines: whether anything goes to `radiance`.
        offset: where in the pixels what it holds was sampled, pixels right and down from their centres.
    """

    def __init__(
        self,
        device: Device,
        geometry: Geometry,
        scene: Scene,
        size: tuple[int, int],
        channels: frozenset[str],
        radiance: Any,
        identity: bool = False,
        stored: Mapping[str, str] | None = None,
    ) -> None:
        self._device, self._geometry, self._scene, self._size = device, geometry, scene, size
        self.constants = constant_channels(scene)
        self.channels = channels - (frozenset(LAYERED) - set(layer_channels(scene)))
        varying = self.channels - set(self.constants)
        possible = layout.attachments(stored or {})
        self._holding = [a for a in possible if "position" in a.channels or varying & set(a.channels)]
        self._formats = layout.defines(self._holding, scene.camera)
        self._stores: dict[GBuffer, tuple[Any, Any, Any]] = {}
        attachments = list(self._holding)
        self.textures = {a.name: device.target(size, a.components, a.dtype) for a in attachments}
        self.tables = {"sheen_table": device.table(_sheen_table())} if "sheen_color" in self.channels else {}
        self.radiance = radiance
        emits = radiance is not None and bool(scene.area_lights)
        if emits:
            attachments.append(layout.EMISSION)
            self.textures["radiance"] = radiance
        if identity:
            attachments.append(layout.IDENTITY)
            self.textures["identity"] = device.target(size)
        self._attachments = attachments
        device.counts["textures"] += 1
        self.depth = device.gl.depth_renderbuffer(size)
        most = device.gl.info["GL_MAX_DRAW_BUFFERS"]
        self._groups = [attachments[first : first + most] for first in range(0, len(attachments), most)]
        self._framebuffers = [device.framebuffer([self.textures[a.name] for a in g], self.depth) for g in self._groups]
        # Where nothing emits, no shape writes radiance: it is cleared by itself.
        self._cleared = None if emits or radiance is None else device.framebuffer([radiance])
        surrounded = radiance is not None and scene.environment is not None and scene.environment.shines
        self._background = Background(device, scene, size, radiance, self.depth) if surrounded else None
        self.shines = emits or surrounded
        self.offset = 0.0, 0.0
        self._programs: dict[tuple, Any] = {}
        self._draws = [[self._prepare(batch, group) for batch in geometry.batches] for group in self._groups]

    @property
    def view_projection(self) -> np.ndarray:
        """(4, 4) float64: world to clip space, at the sub-pixel offset of what the G-buffer holds."""
        camera = self._scene.camera
        return projection_matrix(camera, self._size, self.offset) @ view_matrix(camera)

    def defines(self) -> dict[str, object]:
        """What shaders that read the G-buffer are told: which textures there are and how, and the constants."""
        names: dict[str, object] = {f"GBUFFER_{a.name.upper()}": True for a in self._holding}
        names["GBUFFER_HAS_NORMAL"] = any("normal" in a.channels for a in self._holding)
        names |= self._formats | self._layers()
        return names | {f"CONSTANT_{name.upper()}": value for name, value in self.constants.items()}

    def _layers(self) -> dict[str, object]:
        """The layers of materials that it holds."""
        found = {layer for layer, channels in LAYER_CHANNELS.items() if self.channels & set(channels)}
        return {f"LAYER_{layer.upper()}": True for layer in sorted(found)}

    @property
    def samplers(self) -> dict[str, Any]:
        """Its textures by the names that shaders read them by."""
        return {f"gbuffer_{name}": texture for name, texture in self.textures.items()}

    @property
    def place(self) -> dict[str, Any]:
        """Uniforms for shaders that read it and that change with the sample drawn: where a depth's pixel lies."""
        if "DEPTH_BITS" not in self._formats:
            return {}
        camera = self._scene.camera
        return {
            "depth_range": np.array([camera.near, camera.far]),
            "depth_row": -view_matrix(camera)[2],
            "world_from_pixel": world_from_pixel(camera, self._size, self.offset),
        }

    def draw(self, offset: tuple[float, float] = (0.0, 0.0)) -> None:
        """Render with the scene sampled `offset` pixels right and down from the pixels' centres."""
        self.offset = offset
        if self._cleared is not None:
            self._cleared.clear()
        self._draw_views([(self.view_projection, (0, 0, *self._size))])
        if self._background is not None:
            self._background.draw(offset)

    def draw_tiles(self, matrices: Sequence[np.ndarray], columns: int, excluded: Collection[int] = ()) -> None:
        """Render several views into square or other equal tiles, row by row from the bottom left.

        Args:
            matrices: (4, 4) each, world to clip space.
            columns: tiles beside each other.
            excluded: shapes that are not drawn.
        """
        rows = -(-len(matrices) // columns)
        width, height = self._size[0] // columns, self._size[1] // rows
        places = [(tile % columns * width, tile // columns * height) for tile in range(len(matrices))]
        self._draw_views([(m, (*place, width, height)) for m, place in zip(matrices, places, strict=True)], excluded)

    def _draw_views(
        self, views: Sequence[tuple[np.ndarray, tuple[int, int, int, int]]], excluded: Collection[int] = ()
    ) -> None:
        """Clear everything and draw, for each view, its matrix and its part of the picture."""
        self._device.gl.enable_only(self._device.gl.DEPTH_TEST)
        for framebuffer, draws in zip(self._framebuffers, self._draws, strict=True):
            framebuffer.viewport = 0, 0, *self._size
            framebuffer.use()
            framebuffer.clear()
            for matrix, part in views:
                framebuffer.viewport = part
                for program in self._programs.values():
                    set_uniforms(program, {"view_projection": matrix} | self.place)
                for batch, draw in zip(self._geometry.batches, draws, strict=True):
                    if batch.shape in excluded:
                        continue
                    draw.uniforms.write()
                    bind(draw.program, draw.textures)
                    self._device.draw(draw.vertices, draw.count)

    def load(self, points: SurfacePoints, offset: tuple[float, float] | None = None) -> None:
        """Hold these points, as if they had been drawn: (H, W), with whatever parameters they have.

        Args:
            offset: where in the pixels they were sampled; None: where they project to tells.
        """
        self.offset = _sampled_at(points, self._scene.camera, self._size) if offset is None else offset
        for attachment in self._holding:
            width, height = self._size
            data = np.zeros((height, width, attachment.components), np.float32)
            for name in attachment.channels:
                data[..., PARTS[name][1]] = getattr(points, name)
            if attachment.name == "position":
                data[..., 3] = 1.0
            data[~points.hit] = 0.0
            self.textures[attachment.name].write(np.ascontiguousarray(data[::-1]), alignment=1)

    def store(self, other: "GBuffer") -> None:
        """Hold what another one of the same size holds, in this one's formats."""
        self.offset = other.offset
        if other not in self._stores:
            fragment = source("stored.frag", other.defines() | self._formats).text
            fragment = fragment.replace("ATTACHMENTS", declarations(self._holding))
            program = self._device.program(Source(fragment.replace("    WRITES", writes(self._holding))))
            target = self._device.framebuffer([self.textures[a.name] for a in self._holding])
            self._stores[other] = program, self._device.fullscreen(program), target
        program, vertices, target = self._stores[other]
        target.use()
        target.clear()
        self._device.gl.enable_only(self._device.gl.NOTHING)
        set_uniforms(program, {"viewer": viewer(self._scene.camera)} | self.place | other.place)
        bind(program, other.samplers)
        self._device.draw(vertices, 3)

    def channel(self, name: str) -> np.ndarray:
        """A channel's values, (H, W) or (H, W, 3) float32, row 0 at the top."""
        if name in self.constants:
            value = np.float32(self.constants[name])
            width, height = self._size
            return np.broadcast_to(value, (height, width, *value.shape)).copy()
        attachment, part = PARTS[name]
        return self._device.read(self.textures[attachment])[..., part].copy()

    def _prepare(self, batch: Batch, group: list[layout.Attachment]) -> "Draw":
        program = self._program(batch, group)
        values = material_uniforms(batch.material) | {"shape": batch.shape}
        textures = {f"{slot}_texture": texture for slot, texture in batch.material.textures.items()}
        return Draw(
            program,
            batch.vertices(self._device, program),
            batch.count,
            Uniforms(program, values),
            {name: self._geometry.texture(texture) for name, texture in textures.items() if name in program},
        )

    def _program(self, batch: Batch, group: list[layout.Attachment]):
        material = batch.material
        slots = usable_slots(batch)
        key = (batch.has, slots, material.alpha_mode, material.double_sided, group[0].name)
        if key not in self._programs:
            defines = self._formats | {f"HAS_{name.upper()}": True for name in batch.has}
            defines |= {f"TEXTURE_{slot[0].upper()}": True for slot in slots}
            defines["ALPHA_MASK"] = material.alpha_mode == "mask"
            defines["DOUBLE_SIDED"] = material.double_sided
            defines |= self._layers()
            fragment = source("gbuffer.frag", defines).text
            fragment = fragment.replace("TEXTURE_DECLARATIONS", "\n".join(map(texture_declaration, slots)))
            fragment = fragment.replace("ATTACHMENTS", declarations(group)).replace("    WRITES", writes(group))
            program = self._device.program(Source(fragment), source("gbuffer.vert", defines))
            self._programs[key] = program
        return self._programs[key]


def declarations(attachments: Sequence[layout.Attachment]) -> str:
    """GLSL that declares a shader's outputs."""
    types = ("float", "vec2", "vec3", "vec4")
    lines = [f"layout(location = {i}) out {types[a.components - 1]} out_{a.name};" for i, a in enumerate(attachments)]
    return "\n".join(lines)


def writes(attachments: Sequence[layout.Attachment]) -> str:
    """GLSL that fills them."""
    return "\n".join(f"    out_{a.name} = {a.expression};" for a in attachments)


def _sampled_at(points: SurfacePoints, camera: Camera, size: tuple[int, int]) -> tuple[float, float]:
    """The sub-pixel offset that points were drawn with: where they project to, less their pixels' centres."""
    rows, columns = np.nonzero(points.hit)
    if len(rows) == 0:
        return 0.0, 0.0
    seen = np.column_stack([points.position[rows, columns].astype(np.float64), np.ones(len(rows))])
    x, y, _, w = projection_matrix(camera, size) @ view_matrix(camera) @ seen.T
    right, down = (x / w + 1) / 2 * size[0] - columns - 0.5, (1 - y / w) / 2 * size[1] - rows - 0.5
    return float(np.median(right)), float(np.median(down))


def _sheen_table() -> np.ndarray:
    """The sheen's albedo as a texture, (32, 32, 4) float32; the same in all components."""
    return np.repeat(albedo_table()[..., None], 4, axis=2).astype(np.float32)


def usable_slots(batch: Batch) -> tuple[tuple[str, int, bool, bool], ...]:
    """(slot, texture-coordinate set, mirrored in u, in v) of the textures whose coordinates the shape has."""
    found = []
    for slot, texture in batch.material.textures.items():
        if f"texcoord{texture.texcoord}" in batch.has:
            found.append((slot, texture.texcoord, texture.wrap_u == "mirror", texture.wrap_v == "mirror"))
    return tuple(found)


def texture_declaration(slot: tuple[str, int, bool, bool]) -> str:
    """The sampler of a slot and the function that looks it up, `look_up_<slot>()`."""
    name, texcoord, mirror_u, mirror_v = slot
    u, v = ("mirrored(uv.x)" if mirror_u else "uv.x"), ("mirrored(uv.y)" if mirror_v else "uv.y")
    return f"""uniform sampler2D {name}_texture;
uniform vec3 {name}_row_u, {name}_row_v;
vec4 look_up_{name}() {{
    vec2 uv = transformed(uv{texcoord}, {name}_row_u, {name}_row_v);
    return texture({name}_texture, vec2({u}, {v}));
}}"""


def material_uniforms(material: Material) -> dict[str, object]:
    """A material's constants and its textures' transforms, as the G-buffer's shader names them."""
    values: dict[str, object] = {
        "base_color_factor": np.append(material.base_color, material.alpha),
        "metallic_factor": material.metallic,
        "roughness_factor": material.roughness,
        "specular_factor": material.specular,
        "emissive_factor": np.array(material.emissive),
        "normal_scale": material.normal_scale,
        "occlusion_strength": material.occlusion_strength,
        "alpha_cutoff": material.alpha_cutoff,
        "sheen_color_factor": np.array(material.sheen_color),
        "sheen_roughness_factor": material.sheen_roughness,
        "anisotropy_factor": material.anisotropy,
        "grain_turn": np.array([np.cos(material.anisotropy_rotation), np.sin(material.anisotropy_rotation)]),
        "absorption": np.array(material.absorption),
        "ior": material.ior,
        "clearcoat_factor": material.clearcoat,
        "clearcoat_roughness_factor": material.clearcoat_roughness,
        "clearcoat_normal_scale": material.clearcoat_normal_scale,
    }
    for slot, texture in material.textures.items():
        values |= transform_uniforms(slot, texture)
    return values


def transform_uniforms(slot: str, texture: Texture) -> dict[str, object]:
    """The two rows of a texture's transform."""
    return {f"{slot}_row_u": texture.matrix[0], f"{slot}_row_v": texture.matrix[1]}
