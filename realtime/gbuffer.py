"""The G-buffer: one draw per shape into the attachments that somebody reads."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from lightmeter.scenes.model import Material, Scene, Texture

from .device import Device, set_uniforms
from .geometry import Batch, Geometry
from .projection import projection_matrix, view_matrix, viewer
from .shaders import Source, source

CHANNELS = ("position", "normal", "roughness", "base_color", "metallic", "specular", "occlusion")
"""What effects may read. A channel that is the same everywhere costs no attachment."""


@dataclass(frozen=True)
class Attachment:
    """One colour attachment: its name, the channels it holds and the GLSL that fills it."""

    name: str
    channels: tuple[str, ...]
    expression: str
    components: int = 4


ATTACHMENTS = (
    Attachment("position", ("position",), "vec4(world_position, 1.0)"),
    Attachment("normal_roughness", ("normal", "roughness"), "vec4(normal, roughness)"),
    Attachment("base_color_metallic", ("base_color", "metallic"), "vec4(base_color.rgb, metallic)"),
    Attachment("specular_occlusion", ("specular", "occlusion"), "vec2(specular_factor, occlusion)", 2),
)
EMISSION = Attachment("radiance", (), "vec4(emission, 0.0)")
# Whole numbers that float32 holds exactly: the triangle's number in two halves of 12 bits and more.
IDENTITY = Attachment("identity", (), "vec4(shape, gl_PrimitiveID & 4095, gl_PrimitiveID >> 12, 0.0)")


def constant_channels(scene: Scene) -> dict[str, float]:
    """The channels that hold one value all over the scene, with that value."""
    constants = {}
    speculars = {shape.material.specular for shape in scene.shapes}
    if len(speculars) <= 1:
        constants["specular"] = speculars.pop() if speculars else 1.0
    if not any(shape.material.occlusion_texture for shape in scene.shapes):
        constants["occlusion"] = 1.0
    return constants


class GBuffer:
    """Renders the surface's parameters.

    Args:
        channels: those that are read; the rest is left out.
        radiance: the texture that emission goes to, or None where nothing emits.
        identity: whether each pixel's shape and triangle are written too (for the oracles).
    """

    def __init__(
        self,
        device: Device,
        geometry: Geometry,
        scene: Scene,
        size: tuple[int, int],
        channels: frozenset[str],
        radiance=None,
        identity: bool = False,
    ) -> None:
        self._device, self._geometry, self._scene, self._size = device, geometry, scene, size
        self.constants = constant_channels(scene)
        varying = channels - set(self.constants)
        attachments = [a for a in ATTACHMENTS if a.name == "position" or varying & set(a.channels)]
        self.textures = {a.name: device.target(size, a.components) for a in attachments}
        if radiance is not None:
            attachments.append(EMISSION)
            self.textures["radiance"] = radiance
        if identity:
            attachments.append(IDENTITY)
            self.textures["identity"] = device.target(size)
        self._attachments = attachments
        device.counts["textures"] += 1
        self.depth = device.gl.depth_renderbuffer(size)
        self._framebuffer = device.framebuffer(self.textures.values(), self.depth)
        # The background is cleared by itself: one clear colour holds for all attachments of a framebuffer.
        self._emission = None if radiance is None else device.framebuffer([radiance])
        self._background = (*(scene.environment.radiance if scene.environment else (0.0, 0.0, 0.0)), 0.0)
        self._programs: dict[tuple, Any] = {}
        self._draws = [self._prepare(batch) for batch in geometry.batches]

    def defines(self) -> dict[str, object]:
        """What shaders that read the G-buffer are told: which textures there are, and the constants."""
        names = {f"GBUFFER_{a.name.upper()}": True for a in self._attachments if a.channels}
        return names | {f"CONSTANT_{name.upper()}": value for name, value in self.constants.items()}

    def draw(self, offset: tuple[float, float] = (0.0, 0.0)) -> None:
        """Render with the scene sampled `offset` pixels right and down from the pixels' centres."""
        gl, camera = self._device.gl, self._scene.camera
        self._framebuffer.use()
        self._framebuffer.clear()
        if self._emission is not None:
            self._emission.clear(*self._background)
            self._framebuffer.use()
        gl.enable_only(gl.DEPTH_TEST)
        matrix = projection_matrix(camera, self._size, offset) @ view_matrix(camera)
        for program in self._programs.values():
            set_uniforms(program, {"view_projection": matrix, "viewer": viewer(camera)})
        for batch, program, vertices in self._draws:
            set_uniforms(program, material_uniforms(batch.material) | {"shape": batch.shape})
            for unit, (slot, texture) in enumerate(batch.material.textures.items()):
                if f"{slot}_texture" in program:
                    self._geometry.texture(texture).use(unit)
                    program[f"{slot}_texture"].value = unit
            self._device.draw(vertices, batch.count)

    def _prepare(self, batch: Batch):
        program = self._program(batch)
        return batch, program, batch.vertices(self._device, program)

    def _program(self, batch: Batch):
        material = batch.material
        slots = usable_slots(batch)
        key = (batch.has, slots, material.alpha_mode, material.double_sided)
        if key not in self._programs:
            defines: dict[str, object] = {f"HAS_{name.upper()}": True for name in batch.has}
            defines |= {f"TEXTURE_{slot[0].upper()}": True for slot in slots}
            defines["ALPHA_MASK"] = material.alpha_mode == "mask"
            defines["DOUBLE_SIDED"] = material.double_sided
            fragment = source("gbuffer.frag", defines).text
            fragment = fragment.replace("TEXTURE_DECLARATIONS", "\n".join(map(texture_declaration, slots)))
            fragment = fragment.replace("ATTACHMENTS", self._declarations()).replace("    WRITES", self._writes())
            program = self._device.program(Source(fragment), source("gbuffer.vert", defines))
            self._programs[key] = program
        return self._programs[key]

    def _declarations(self) -> str:
        return "\n".join(
            f"layout(location = {i}) out vec{a.components} out_{a.name};" for i, a in enumerate(self._attachments)
        )

    def _writes(self) -> str:
        return "\n".join(f"    out_{a.name} = {a.expression};" for a in self._attachments)


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
    }
    for slot, texture in material.textures.items():
        values |= transform_uniforms(slot, texture)
    return values


def transform_uniforms(slot: str, texture: Texture) -> dict[str, object]:
    """The two rows of a texture's transform."""
    return {f"{slot}_row_u": texture.matrix[0], f"{slot}_row_v": texture.matrix[1]}
