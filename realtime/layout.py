"""How the G-buffer stores its channels: its attachments, their formats, and the bytes that they take.

Unless an effect asks for less, everything is kept in 32-bit floats. `stored` maps channels to formats: position,
normal, base_color, and "parameters" for the four scalars of the material.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from lightmeter.scenes.layers import COAT, GLASS, GRAIN, SHEEN
from lightmeter.scenes.model import Camera

BYTES = {"f4": 4, "f2": 2, "f1": 1, "nu2": 2}
"""Of a component: floats, and whole numbers that stand for 0…1."""


@dataclass(frozen=True)
class Attachment:
    """One colour attachment.

    Attributes:
        name: shaders read it as `gbuffer_<name>`, and are told `GBUFFER_<NAME>`.
        channels: those that it holds.
        expression: the GLSL that fills it.
        components: how many it has.
        dtype: their type, a key of `BYTES`.
        defines: what shaders that write or read it are compiled with.
    """

    name: str
    channels: tuple[str, ...]
    expression: str
    components: int = 4
    dtype: str = "f4"
    defines: Mapping[str, object] = field(default_factory=dict)

    @property
    def bytes_per_pixel(self) -> int:
        """What it takes."""
        return self.components * BYTES[self.dtype]


POSITION = Attachment("position", ("position",), "vec4(world_position, 1.0)")
NORMAL_ROUGHNESS = Attachment("normal_roughness", ("normal", "roughness"), "vec4(normal, roughness)")
BASE_COLOR_METALLIC = Attachment("base_color_metallic", ("base_color", "metallic"), "vec4(base_color.rgb, metallic)")
SPECULAR_OCCLUSION = Attachment("specular_occlusion", ("specular", "occlusion"), "vec2(specular_factor, occlusion)", 2)
COATED = Attachment("clearcoat_factors", COAT[:2], "vec2(clearcoat, clearcoat_roughness)", 2)
COAT_NORMAL = Attachment("clearcoat_normal", COAT[2:], "vec4(clearcoat_normal, 0.0)")
GRAINED = Attachment("grain", GRAIN, "vec4(anisotropy_direction, anisotropy)")
SHEENED = Attachment("sheen", SHEEN, "vec4(sheen_color, sheen_roughness)")
GLASSY = Attachment("glass", GLASS, "vec4(absorption, ior)")
LAYERS = (COATED, COAT_NORMAL, GRAINED, SHEENED, GLASSY)
EMISSION = Attachment("radiance", (), "vec4(emission, 0.0)")
# Whole numbers that float32 holds exactly: the triangle's number in two halves of 12 bits and more.
IDENTITY = Attachment("identity", (), "vec4(shape, gl_PrimitiveID & 4095, gl_PrimitiveID >> 12, 0.0)")

ROUGHNESS = Attachment("roughness", ("roughness",), "roughness", 1)
METALLIC = Attachment("metallic", ("metallic",), "metallic", 1)
PARAMETERS = Attachment(
    "parameters",
    ("roughness", "metallic", "specular", "occlusion"),
    "vec4(roughness, metallic, specular_factor, occlusion)",
    4,
    "f1",
)

DEPTH_ENCODINGS = ("linear", "standard", "reversed")
DEPTH_BITS = {16: (1, "nu2"), 24: (3, "f1"), 32: (1, "f4")}
"""Components and their type: a 16-bit number from 0 to 1, such a one of 24 bits, or a float."""
NORMAL_BITS = {8: (2, "f1"), 12: (3, "f1"), 16: (2, "nu2")}
"""Bits of each of an octahedral normal's two coordinates: components and their type."""

POSITIONS = {
    "fp32": POSITION,
    "fp16": Attachment("position", ("position",), "vec4(world_position, 1.0)", 4, "f2"),
} | {
    f"{encoding}{bits}": Attachment(
        "depth",
        ("position",),
        "pack_depth(world_position)",
        components,
        dtype,
        {"DEPTH_BITS": bits, "DEPTH_ENCODING": encoding},
    )
    for encoding in DEPTH_ENCODINGS
    for bits, (components, dtype) in DEPTH_BITS.items()
}
NORMALS = {"fp16": Attachment("normal", ("normal",), "vec4(normal, 0.0)", 4, "f2")} | {
    f"oct{bits}": Attachment(
        "octahedral_normal", ("normal",), "pack_normal(normal)", components, dtype, {"NORMAL_BITS": bits}
    )
    for bits, (components, dtype) in NORMAL_BITS.items()
}
BASE_COLORS = {
    "linear8": Attachment("base_color", ("base_color",), "base_color.rgb", 3, "f1"),
    "srgb8": Attachment(
        "base_color", ("base_color",), "srgb_encode(base_color.rgb)", 3, "f1", {"BASE_COLOR_IN_SRGB": True}
    ),
}

FLOATS = {"position": 16, "normal": 12, "base_color": 12, "parameters": 16}
"""Bytes of 32-bit floats; beside a position there is room for whether a surface is seen."""


def attachments(stored: Mapping[str, str]) -> tuple[Attachment, ...]:
    """The attachments of a G-buffer whose channels have these formats; those without one are kept in floats.

    A normal in floats has the roughness beside it and a base colour the metallic; in other formats these move out.
    """
    normal, color = NORMALS.get(stored.get("normal", "")), BASE_COLORS.get(stored.get("base_color", ""))
    found = [POSITIONS[stored.get("position", "fp32")]]
    if stored.get("parameters") == "unorm8":
        bare_normal = Attachment("normal_roughness", ("normal",), "vec4(normal, 0.0)")
        bare_color = Attachment("base_color_metallic", ("base_color",), "vec4(base_color.rgb, 0.0)")
        return (*found, normal or bare_normal, color or bare_color, PARAMETERS, *LAYERS)
    found += [normal, ROUGHNESS] if normal else [NORMAL_ROUGHNESS]
    found += [color, METALLIC] if color else [BASE_COLOR_METALLIC]
    return (*found, SPECULAR_OCCLUSION, *LAYERS)


def bytes_per_pixel(stored: Mapping[str, str]) -> int:
    """What the channels take in these formats, where the scene varies them: those named, and no others."""
    formats = {
        "position": POSITIONS,
        "normal": NORMALS,
        "base_color": BASE_COLORS,
        "parameters": {"unorm8": PARAMETERS},
    }
    total = 0
    for channel, name in stored.items():
        total += FLOATS[channel] if name == "fp32" else formats[channel][name].bytes_per_pixel
    return total


def defines(of: Sequence[Attachment], camera: Camera) -> dict[str, object]:
    """What a shader that writes or reads these attachments is compiled with."""
    found: dict[str, object] = {}
    for attachment in of:
        found |= attachment.defines
    if found:
        found["STORED_FORMATS"] = True
    if "DEPTH_BITS" in found:
        parallel = camera.yfov is None
        encoding = {
            "linear": "linear_depth",
            "standard": "linear_depth" if parallel else "standard_depth",
            "reversed": "linear_depth_reversed" if parallel else "reversed_depth",
        }[str(found.pop("DEPTH_ENCODING"))]
        found |= {"TO_DEPTH": encoding, "FROM_DEPTH": f"from_{encoding}", "PARALLEL_RAYS": parallel}
    return found
