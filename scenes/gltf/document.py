"""glTF 2.0's JSON as checked objects (specification, section 5): the properties that are read here.

Other properties are let through; extensions are looked up where they are supported and listed elsewhere.
"""

import math
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator


def _whole(value: Any) -> Any:
    """JSON may write the integer 3 as 3.0."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


BIGGEST = 2**53
Number = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-1e30, le=1e30)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0, le=1e30)]
NonNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=1e30)]
Fraction = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=1)]
Index = Annotated[int, BeforeValidator(_whole), Field(strict=True, ge=0, le=BIGGEST)]
Count = Annotated[int, BeforeValidator(_whole), Field(strict=True, ge=1, le=BIGGEST)]
Flag = Annotated[bool, Field(strict=True)]
Text = Annotated[str, Field(strict=True)]
Color = tuple[NonNegative, NonNegative, NonNegative]
Reflectance = tuple[Fraction, Fraction, Fraction, Fraction]
Pair = tuple[Number, Number]
Triple = tuple[Number, Number, Number]
Quadruple = tuple[Number, Number, Number, Number]
ComponentType = Annotated[Literal[5120, 5121, 5122, 5123, 5125, 5126], BeforeValidator(_whole)]


class Part(BaseModel):
    """Any object of a glTF file."""

    model_config = ConfigDict(extra="ignore", frozen=True)

    name: Text = ""
    extensions: dict[str, Any] = Field(default_factory=dict)


class Asset(Part):
    version: Text
    min_version: Text | None = Field(None, alias="minVersion")


class Buffer(Part):
    byte_length: Count = Field(alias="byteLength")
    uri: Text | None = None


class BufferView(Part):
    buffer: Index
    byte_offset: Index = Field(0, alias="byteOffset")
    byte_length: Count = Field(alias="byteLength")
    byte_stride: Annotated[int, BeforeValidator(_whole), Field(strict=True, ge=4, le=252)] | None = Field(
        None, alias="byteStride"
    )


class SparseIndices(Part):
    buffer_view: Index = Field(alias="bufferView")
    byte_offset: Index = Field(0, alias="byteOffset")
    component_type: Annotated[Literal[5121, 5123, 5125], BeforeValidator(_whole)] = Field(alias="componentType")


class SparseValues(Part):
    buffer_view: Index = Field(alias="bufferView")
    byte_offset: Index = Field(0, alias="byteOffset")


class Sparse(Part):
    count: Count
    indices: SparseIndices
    values: SparseValues


class Accessor(Part):
    buffer_view: Index | None = Field(None, alias="bufferView")
    byte_offset: Index = Field(0, alias="byteOffset")
    component_type: ComponentType = Field(alias="componentType")
    normalized: Flag = False
    count: Count
    type: Literal["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"]
    sparse: Sparse | None = None


class Primitive(Part):
    attributes: dict[str, Index]
    indices: Index | None = None
    material: Index | None = None
    mode: Annotated[int, BeforeValidator(_whole), Field(strict=True, ge=0, le=6)] = 4
    targets: list[Any] = Field(default_factory=list)


class Mesh(Part):
    primitives: Annotated[list[Primitive], Field(min_length=1)]


class Node(Part):
    children: list[Index] = Field(default_factory=list)
    mesh: Index | None = None
    camera: Index | None = None
    skin: Index | None = None
    matrix: Annotated[list[Number], Field(min_length=16, max_length=16)] | None = None
    translation: Triple | None = None
    rotation: Quadruple | None = None
    scale: Triple | None = None

    @model_validator(mode="after")
    def _one_way(self) -> "Node":
        if self.matrix is not None and (self.translation or self.rotation or self.scale):
            raise ValueError("a node has either matrix, or translation, rotation and scale, not both")
        if self.matrix is not None and tuple(self.matrix[3::4]) != (0, 0, 0, 1):
            raise ValueError("the matrix's last row is not 0, 0, 0, 1")
        if self.rotation is not None and sum(x * x for x in self.rotation) < 1e-12:
            raise ValueError("the rotation is no unit quaternion")
        return self


class Scene(Part):
    nodes: list[Index] = Field(default_factory=list)


class Perspective(Part):
    yfov: Annotated[float, Field(strict=True, allow_inf_nan=False, gt=1e-4, lt=3.14159)]
    znear: Positive
    zfar: Positive | None = None


class Orthographic(Part):
    xmag: Number
    ymag: Number
    znear: NonNegative
    zfar: Positive


class Camera(Part):
    type: Literal["perspective", "orthographic"]
    perspective: Perspective | None = None
    orthographic: Orthographic | None = None

    @model_validator(mode="after")
    def _complete(self) -> "Camera":
        lens = self.perspective if self.type == "perspective" else self.orthographic
        if lens is None:
            raise ValueError(f"a camera of type {self.type!r} needs the property {self.type!r}")
        if lens.zfar is not None and lens.zfar <= lens.znear:
            raise ValueError(f"zfar ({lens.zfar:g}) must be above znear ({lens.znear:g})")
        if isinstance(lens, Orthographic) and not 1e-9 < abs(lens.ymag) < 1e9:
            raise ValueError(f"ymag ({lens.ymag:g}) leaves nothing to see")
        return self


class TextureInfo(Part):
    index: Index
    texcoord: Index = Field(0, alias="texCoord")


class NormalTextureInfo(TextureInfo):
    scale: Number = 1.0


class OcclusionTextureInfo(TextureInfo):
    strength: Fraction = 1.0


class MetallicRoughness(Part):
    base_color: Reflectance = Field((1.0, 1.0, 1.0, 1.0), alias="baseColorFactor")
    base_color_texture: TextureInfo | None = Field(None, alias="baseColorTexture")
    metallic: Fraction = Field(1.0, alias="metallicFactor")
    roughness: Fraction = Field(1.0, alias="roughnessFactor")
    metallic_roughness_texture: TextureInfo | None = Field(None, alias="metallicRoughnessTexture")


class Material(Part):
    metallic_roughness: MetallicRoughness = Field(
        default_factory=lambda: MetallicRoughness.model_validate({}), alias="pbrMetallicRoughness"
    )
    normal_texture: NormalTextureInfo | None = Field(None, alias="normalTexture")
    occlusion_texture: OcclusionTextureInfo | None = Field(None, alias="occlusionTexture")
    emissive_texture: TextureInfo | None = Field(None, alias="emissiveTexture")
    emissive: tuple[Fraction, Fraction, Fraction] = Field((0.0, 0.0, 0.0), alias="emissiveFactor")
    alpha_mode: Literal["OPAQUE", "MASK", "BLEND"] = Field("OPAQUE", alias="alphaMode")
    alpha_cutoff: NonNegative = Field(0.5, alias="alphaCutoff")
    double_sided: Flag = Field(False, alias="doubleSided")


class Image(Part):
    uri: Text | None = None
    buffer_view: Index | None = Field(None, alias="bufferView")


class Texture(Part):
    sampler: Index | None = None
    source: Index | None = None


class Sampler(Part):
    mag_filter: Annotated[Literal[9728, 9729], BeforeValidator(_whole)] | None = Field(None, alias="magFilter")
    min_filter: Annotated[Literal[9728, 9729, 9984, 9985, 9986, 9987], BeforeValidator(_whole)] | None = Field(
        None, alias="minFilter"
    )
    wrap_s: Annotated[Literal[33071, 33648, 10497], BeforeValidator(_whole)] = Field(10497, alias="wrapS")
    wrap_t: Annotated[Literal[33071, 33648, 10497], BeforeValidator(_whole)] = Field(10497, alias="wrapT")


class Document(Part):
    """A whole file."""

    asset: Asset
    extensions_required: list[Text] = Field(default_factory=list, alias="extensionsRequired")
    extensions_used: list[Text] = Field(default_factory=list, alias="extensionsUsed")
    scene: Index | None = None
    scenes: list[Scene] = Field(default_factory=list)
    nodes: list[Node] = Field(default_factory=list)
    meshes: list[Mesh] = Field(default_factory=list)
    materials: list[Material] = Field(default_factory=list)
    textures: list[Texture] = Field(default_factory=list)
    images: list[Image] = Field(default_factory=list)
    samplers: list[Sampler] = Field(default_factory=list)
    cameras: list[Camera] = Field(default_factory=list)
    accessors: list[Accessor] = Field(default_factory=list)
    buffer_views: list[BufferView] = Field(default_factory=list, alias="bufferViews")
    buffers: list[Buffer] = Field(default_factory=list)
    animations: list[Any] = Field(default_factory=list)
    skins: list[Any] = Field(default_factory=list)


# The extensions that are read.


class TextureTransform(Part):
    """KHR_texture_transform."""

    offset: Pair = (0.0, 0.0)
    rotation: Number = 0.0
    scale: Pair = (1.0, 1.0)
    texcoord: Index | None = Field(None, alias="texCoord")


class EmissiveStrength(Part):
    """KHR_materials_emissive_strength."""

    strength: NonNegative = Field(1.0, alias="emissiveStrength")


class Specular(Part):
    """KHR_materials_specular."""

    factor: Fraction = Field(1.0, alias="specularFactor")
    color: Color = Field((1.0, 1.0, 1.0), alias="specularColorFactor")
    texture: TextureInfo | None = Field(None, alias="specularTexture")
    color_texture: TextureInfo | None = Field(None, alias="specularColorTexture")


class ClearCoat(Part):
    """KHR_materials_clearcoat."""

    factor: Fraction = Field(0.0, alias="clearcoatFactor")
    texture: TextureInfo | None = Field(None, alias="clearcoatTexture")
    roughness: Fraction = Field(0.0, alias="clearcoatRoughnessFactor")
    roughness_texture: TextureInfo | None = Field(None, alias="clearcoatRoughnessTexture")
    normal_texture: NormalTextureInfo | None = Field(None, alias="clearcoatNormalTexture")


class Anisotropy(Part):
    """KHR_materials_anisotropy."""

    strength: Fraction = Field(0.0, alias="anisotropyStrength")
    rotation: Number = Field(0.0, alias="anisotropyRotation")
    texture: TextureInfo | None = Field(None, alias="anisotropyTexture")


class Sheen(Part):
    """KHR_materials_sheen."""

    color: tuple[Fraction, Fraction, Fraction] = Field((0.0, 0.0, 0.0), alias="sheenColorFactor")
    color_texture: TextureInfo | None = Field(None, alias="sheenColorTexture")
    roughness: Fraction = Field(0.0, alias="sheenRoughnessFactor")
    roughness_texture: TextureInfo | None = Field(None, alias="sheenRoughnessTexture")


class Transmission(Part):
    """KHR_materials_transmission."""

    factor: Fraction = Field(0.0, alias="transmissionFactor")
    texture: TextureInfo | None = Field(None, alias="transmissionTexture")


class Ior(Part):
    """KHR_materials_ior."""

    ior: NonNegative = 1.5


class Volume(Part):
    """KHR_materials_volume."""

    thickness: NonNegative = Field(0.0, alias="thicknessFactor")
    thickness_texture: TextureInfo | None = Field(None, alias="thicknessTexture")
    attenuation_distance: Annotated[float, Field(strict=True, gt=0)] = Field(math.inf, alias="attenuationDistance")
    attenuation_color: tuple[Fraction, Fraction, Fraction] = Field((1.0, 1.0, 1.0), alias="attenuationColor")


class Cone(Part):
    inner: Annotated[float, Field(strict=True, ge=0, le=1.5707964)] = Field(0.0, alias="innerConeAngle")
    outer: Annotated[float, Field(strict=True, gt=0, le=1.5707964)] = Field(0.7853981633974483, alias="outerConeAngle")

    @model_validator(mode="after")
    def _order(self) -> "Cone":
        if not self.inner < self.outer:
            raise ValueError(f"innerConeAngle ({self.inner:g}) must be below outerConeAngle ({self.outer:g})")
        return self


class Light(Part):
    """A light of KHR_lights_punctual."""

    type: Literal["point", "spot", "directional"]
    color: Color = (1.0, 1.0, 1.0)
    intensity: NonNegative = 1.0
    range: Positive | None = None
    spot: Cone | None = None

    @model_validator(mode="after")
    def _complete(self) -> "Light":
        if self.type == "spot" and self.spot is None:
            raise ValueError("a spot light needs the property 'spot'")
        return self


class Lights(Part):
    """KHR_lights_punctual, at the file's root."""

    lights: list[Light]


class LightReference(Part):
    """KHR_lights_punctual, at a node."""

    light: Index
