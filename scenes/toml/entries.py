"""The scene file's schema: every key with its type, unit, range and default."""

import math
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field, WithJsonSchema, model_validator

from lightmeter.scenes.model import MinFilter, View, Wrap
from lightmeter.scenes.shapes.limits import ALONG, AROUND, LENGTH, RINGS
from lightmeter.scenes.validation import Strict

LARGEST = 1e9

Number = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-LARGEST, le=LARGEST)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0, le=LARGEST)]
NonNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=LARGEST)]
Fraction = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=1)]
Length = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=LENGTH[0], le=LENGTH[1])]
Coordinate = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-LENGTH[1], le=LENGTH[1])]
Around = Annotated[int, Field(strict=True, ge=AROUND[0], le=AROUND[1])]
Along = Annotated[int, Field(strict=True, ge=ALONG[0], le=ALONG[1])]
Rings = Annotated[int, Field(strict=True, ge=RINGS[0], le=RINGS[1])]
Flag = Annotated[bool, Field(strict=True)]
Text = Annotated[str, Field(strict=True, max_length=1000)]
Name = Annotated[str, Field(strict=True, min_length=1, max_length=200)]

Point = tuple[Coordinate, Coordinate, Coordinate]
Vector = tuple[Number, Number, Number]


def _has_length(vector: tuple[float, float, float]) -> tuple[float, float, float]:
    if math.hypot(*vector) < 1e-6:
        raise ValueError("this direction has no length")
    return vector


Direction = Annotated[Vector, AfterValidator(_has_length)]
Matrix = tuple[
    tuple[Number, Number, Number, Number],
    tuple[Number, Number, Number, Number],
    tuple[Number, Number, Number, Number],
    tuple[Number, Number, Number, Number],
]


def _three(value: Any) -> Any:
    """A single number stands for three equal ones."""
    return (value,) * 3 if isinstance(value, int | float) and not isinstance(value, bool) else value


def _one_or_three(low: float | None, high: float) -> WithJsonSchema:
    number: dict[str, Any] = {"type": "number", "maximum": high}
    if low is not None:
        number["minimum"] = low
    return WithJsonSchema({"anyOf": [number, {"type": "array", "items": number, "minItems": 3, "maxItems": 3}]})


Reflectance = Annotated[tuple[Fraction, Fraction, Fraction], BeforeValidator(_three), _one_or_three(0, 1)]
Radiant = Annotated[tuple[NonNegative, NonNegative, NonNegative], BeforeValidator(_three), _one_or_three(0, LARGEST)]
Scale = Annotated[tuple[Number, Number, Number], BeforeValidator(_three), _one_or_three(None, LARGEST)]


class TextureEntry(Strict):
    """A PNG or JPEG file and how it is looked up."""

    file: Name
    wrap: Wrap | None = Field(None, description="Both directions; `wrap_u` and `wrap_v` set one each.")
    wrap_u: Wrap | None = None
    wrap_v: Wrap | None = None
    min_filter: MinFilter = "linear_mipmap_linear"
    mag_filter: Literal["nearest", "linear"] = "linear"
    texcoord: Annotated[int, Field(strict=True, ge=0, le=7)] = 0
    offset: tuple[Number, Number] = (0.0, 0.0)
    rotation: Number = Field(0.0, description="Degrees, anticlockwise.")
    scale: tuple[Number, Number] = (1.0, 1.0)


def _named_file(value: Any) -> Any:
    """A file's name alone stands for a texture with everything else at its default."""
    return {"file": value} if isinstance(value, str) else value


TextureKey = Annotated[
    TextureEntry,
    BeforeValidator(_named_file, json_schema_input_type=Name | TextureEntry),
    Field(description="A file name, or a table with `file` and how it is looked up."),
]


class MaterialEntry(Strict):
    """glTF 2.0's metallic-roughness material. Colours are linear Rec. 709; one number stands for a grey."""

    base_color: Reflectance = (1.0, 1.0, 1.0)
    alpha: Fraction = 1.0
    metallic: Fraction = 0.0
    roughness: Fraction = 1.0
    specular: Fraction = Field(1.0, description="0 makes a dielectric purely diffuse.")
    emissive: Radiant = Field((0.0, 0.0, 0.0), description="Radiance leaving the front, W/(sr·m²).")
    base_color_texture: TextureKey | None = None
    metallic_roughness_texture: TextureKey | None = None
    normal_texture: TextureKey | None = None
    normal_scale: Number = 1.0
    occlusion_texture: TextureKey | None = None
    occlusion_strength: Fraction = 1.0
    emissive_texture: TextureKey | None = None
    alpha_mode: Literal["opaque", "mask"] = "opaque"
    alpha_cutoff: Fraction = 0.5
    double_sided: Flag = False
    clearcoat: Fraction = Field(0.0, description="Clear coat of index 1.5 (KHR_materials_clearcoat); 0: none.")
    clearcoat_roughness: Fraction = 0.0
    clearcoat_texture: TextureKey | None = Field(None, description="Factor in red.")
    clearcoat_roughness_texture: TextureKey | None = Field(None, description="Factor in green.")
    clearcoat_normal_texture: TextureKey | None = None
    clearcoat_normal_scale: Number = 1.0
    anisotropy: Fraction = Field(0.0, description="Strength (KHR_materials_anisotropy); 0: alike in all directions.")
    anisotropy_rotation: Number = Field(0.0, description="Of the grain, from the tangent to the bitangent, degrees.")
    anisotropy_texture: TextureKey | None = Field(None, description="Direction in red and green, factor in blue.")
    sheen_color: Reflectance = Field((0.0, 0.0, 0.0), description="Sheen of cloth (KHR_materials_sheen); 0: none.")
    sheen_roughness: Fraction = 0.0
    sheen_color_texture: TextureKey | None = None
    sheen_roughness_texture: TextureKey | None = Field(None, description="Factor in alpha.")
    ior: Annotated[float, Field(strict=True, gt=1, le=10)] | None = Field(
        None, description="Makes it a smooth dielectric solid of this index of refraction; opaque unless given."
    )
    attenuation_color: Reflectance = Field((1.0, 1.0, 1.0), description="What the solid leaves of white light…")
    attenuation_distance: Length = Field(1.0, description="…over so many metres.")

    @model_validator(mode="after")
    def _one_kind(self) -> "MaterialEntry":
        opaque = {"base_color", "metallic", "roughness", "specular", "clearcoat", "anisotropy", "sheen_color"}
        if self.ior is not None and (given := sorted(opaque & self.model_fields_set)):
            raise ValueError(f"a dielectric solid (ior) has no {' or '.join(given)}: it only mirrors and refracts")
        if self.ior is None and "attenuation_color" in self.model_fields_set:
            raise ValueError("attenuation_color is of a dielectric solid: give its ior")
        if min(self.attenuation_color) <= 0:
            raise ValueError("attenuation_color must be above 0: no distance leaves nothing")
        return self


class MeteringEntry(Strict):
    """Automatic exposure: a log-average of the picture's luminance is brought to a grey."""

    grey: Positive = Field(0.18, description="What the average is brought to; 1 is diffuse white.")
    darkest: Fraction = Field(0.0, description="Share of the pixels, the darkest, that do not count.")
    brightest: Fraction = Field(0.0, description="Share of the pixels, the brightest, that do not count.")
    floor: Positive = Field(1e-4, description="Luminance below which a pixel counts as this, W/(sr·m²).")

    @model_validator(mode="after")
    def _something_counts(self) -> "MeteringEntry":
        if self.darkest + self.brightest > 0.99:
            raise ValueError("darkest and brightest together leave less than a hundredth of the pixels")
        return self


class ApertureEntry(Strict):
    """The opening that light enters the camera by: bright lights glare by diffraction at it."""

    f_number: Annotated[float, Field(strict=True, ge=0.5, le=256)] = 8.0
    blades: Annotated[int, Field(strict=True, ge=3, le=32)] | None = Field(
        None, description="Corners of a regular polygon; a circle unless given."
    )
    rotation: Number = Field(0.0, description="Degrees, anticlockwise in the picture; at 0 a corner points up.")
    sensor_height: Annotated[float, Field(strict=True, ge=1e-4, le=1)] = Field(
        0.024, description="Metres that the picture's height takes on the sensor."
    )


class CameraEntry(Strict):
    """Where the picture is taken from: `position` and `target`, or `matrix`; `yfov` or `ymag`."""

    name: Name = "camera"
    position: Point | None = None
    target: Point | None = None
    up: Direction = (0.0, 1.0, 0.0)
    matrix: Matrix | None = Field(None, description="Camera to world, four rows.")
    yfov: Annotated[float, Field(strict=True, ge=0.01, le=179)] | None = Field(
        None, description="Full vertical angle of view of a perspective camera, degrees."
    )
    ymag: Length | None = Field(None, description="Half the height an orthographic camera sees, metres.")
    near: Positive | None = Field(None, description="Metres; fitted to the scene unless given.")
    far: Positive | None = Field(None, description="Metres; fitted to the scene unless given.")
    exposure: Annotated[float, Field(strict=True, ge=-64, le=64)] = Field(
        0.0, description="Stops; with metering, added to what it gives."
    )
    metering: MeteringEntry | None = Field(None, description="The exposure is set by hand unless given.")
    aperture: ApertureEntry | None = Field(None, description="Nothing is diffracted unless given.")
    view: View = Field("aces-1", description="The display transform that tone curves are held against.")

    @model_validator(mode="after")
    def _complete(self) -> "CameraEntry":
        if (self.yfov is None) == (self.ymag is None):
            raise ValueError("a camera needs either yfov (perspective, degrees) or ymag (orthographic, metres)")
        if self.matrix is None and (self.position is None or self.target is None):
            raise ValueError("a camera needs position and target, or matrix")
        if self.matrix is not None and (self.position is not None or self.target is not None):
            raise ValueError("a camera has either position and target, or matrix, not both")
        if self.position is not None and math.dist(self.position, self.target or ()) < 1e-6:
            raise ValueError("the camera's target is where the camera is")
        if self.near is not None and self.far is not None and self.near >= self.far:
            raise ValueError(f"near ({self.near:g}) must be below far ({self.far:g})")
        return self


Range = Annotated[
    Length | None,
    Field(description="Metres at which the light ends, by glTF's window 1 − (d/range)⁴; unlimited unless given."),
]


class EnvironmentEntry(Strict):
    """What surrounds the scene."""

    radiance: Radiant = Field(
        (1.0, 1.0, 1.0), description="The same from every direction, W/(sr·m²); with a map a factor for its texels."
    )
    map: Name | None = Field(
        None,
        description="A latitude-longitude map beside the scene file, .hdr or .exr, or a built-in one: studio, sky.",
    )
    rotate: Number = Field(0.0, description="Degrees about +Y, anticlockwise as seen from above.")
    elevation: Annotated[float, Field(strict=True, gt=0, le=90)] | None = Field(
        None, description="Of the built-in sky: the sun's, in degrees above the horizon; 45 unless given."
    )
    turbidity: Annotated[float, Field(strict=True, ge=2, le=10)] | None = Field(
        None, description="Of the built-in sky: 2 (clear) to 10 (hazy); 3 unless given."
    )
    clamp: bool = Field(
        False, description="Negative, infinite and NaN texels become 0, the largest finite value and 0, with a note."
    )

    @model_validator(mode="after")
    def _something(self):
        if self.map is None and "radiance" not in self.model_fields_set:
            raise ValueError("an environment has a radiance, a map or both")
        if self.map is None and (self.rotate or self.clamp):
            raise ValueError("rotate and clamp are of a map, and there is none")
        if self.map != "sky" and (self.elevation is not None or self.turbidity is not None):
            raise ValueError("elevation and turbidity are of the built-in map 'sky'")
        return self


class PointEntry(Strict):
    """A light that radiates equally in every direction."""

    type: Literal["point"]
    name: Name | None = None
    position: Point
    intensity: Radiant = Field(description="W/sr; multiplied with `color`.")
    color: Radiant = (1.0, 1.0, 1.0)
    range: Range = None


class SpotEntry(Strict):
    """A light within a cone: `direction`, or the `target` it points at."""

    type: Literal["spot"]
    name: Name | None = None
    position: Point
    direction: Direction | None = None
    target: Point | None = None
    intensity: Radiant = Field(description="W/sr on the axis; multiplied with `color`.")
    color: Radiant = (1.0, 1.0, 1.0)
    inner: Annotated[float, Field(strict=True, ge=0, lt=90)] = Field(
        0.0, description="Half angle of the cone of full intensity, degrees."
    )
    outer: Annotated[float, Field(strict=True, gt=0, le=90)] = Field(
        45.0, description="Half angle of the cone beyond which there is none, degrees."
    )
    range: Range = None

    @model_validator(mode="after")
    def _complete(self) -> "SpotEntry":
        if (self.direction is None) == (self.target is None):
            raise ValueError("a spot light needs either direction or target")
        if self.target is not None and math.dist(self.position, self.target) < 1e-6:
            raise ValueError("the light's target is where the light is")
        if not self.inner < self.outer:
            raise ValueError(f"inner ({self.inner:g}°) must be below outer ({self.outer:g}°)")
        return self


class DirectionalEntry(Strict):
    """Parallel light, like the sun's."""

    type: Literal["directional"]
    name: Name | None = None
    direction: Direction = Field(description="The way the light travels.")
    irradiance: Radiant = Field(description="W/m² on a plane across the direction; multiplied with `color`.")
    color: Radiant = (1.0, 1.0, 1.0)


class Placed(Strict):
    """A shape's place: scaled, then rotated, then translated; or `matrix`."""

    name: Name | None = None
    translate: Point = (0.0, 0.0, 0.0)
    rotate: Vector = Field((0.0, 0.0, 0.0), description="Degrees about X, then Y, then Z (the axes stay put).")
    axis: Direction | None = Field(None, description="With `angle`: another way to give the rotation.")
    angle: Number = Field(0.0, description="Degrees about `axis`, anticlockwise seen against it.")
    scale: Scale = (1.0, 1.0, 1.0)
    matrix: Matrix | None = Field(None, description="Local to world, four rows.")

    @model_validator(mode="after")
    def _one_way(self) -> "Placed":
        given = self.model_fields_set
        if "matrix" in given and given & {"translate", "rotate", "axis", "angle", "scale"}:
            raise ValueError("a place has either matrix, or translate, rotate and scale, not both")
        if "rotate" in given and given & {"axis", "angle"}:
            raise ValueError("a rotation has either rotate, or axis and angle, not both")
        if ("axis" in given) != ("angle" in given):
            raise ValueError("axis and angle belong together")
        if min(abs(factor) for factor in self.scale) < 1e-9:
            raise ValueError("a scale of 0 leaves nothing of the shape")
        if self.matrix is not None and self.matrix[3] != (0, 0, 0, 1):
            raise ValueError("the matrix's last row must be [0, 0, 0, 1]")
        return self


class Painted(Placed):
    """A placed shape with a material of its own."""

    material: Name | None = Field(
        None, description="A key of `materials`; unless given, the one called `default`, or a white rough one."
    )


class PlaneEntry(Painted):
    """A lying sheet, facing +Y."""

    type: Literal["plane"]
    width: Length = Field(1.0, description="Along X, metres.")
    depth: Length = Field(1.0, description="Along Z, metres.")
    segments: Along = 1


class RectangleEntry(Painted):
    """A standing sheet, facing +Z."""

    type: Literal["rectangle"]
    width: Length = Field(1.0, description="Along X, metres.")
    height: Length = Field(1.0, description="Along Y, metres.")
    segments: Along = 1


class BoxEntry(Painted):
    """A box around the origin."""

    type: Literal["box"]
    width: Length = Field(1.0, description="Along X, metres.")
    height: Length = Field(1.0, description="Along Y, metres.")
    depth: Length = Field(1.0, description="Along Z, metres.")
    segments: Along = 1


class SphereEntry(Painted):
    """A sphere around the origin."""

    type: Literal["sphere"]
    radius: Length = 1.0
    segments: Around = 48
    rings: Rings | None = None


class TorusEntry(Painted):
    """A torus around the Y axis."""

    type: Literal["torus"]
    major: Length = Field(1.0, description="From the axis to the middle of the tube, metres.")
    minor: Length = Field(0.4, description="The tube's radius, metres.")
    segments: Around = 64
    rings: Around = 32


class CylinderEntry(Painted):
    """A cylinder around the Y axis."""

    type: Literal["cylinder"]
    radius: Length = 1.0
    height: Length = 1.0
    segments: Around = 48
    rings: Along = 1
    caps: Flag = True


class ConeEntry(Painted):
    """A cone around the Y axis, its tip up."""

    type: Literal["cone"]
    radius: Length = 1.0
    height: Length = 1.0
    segments: Around = 48
    rings: Along = 8
    cap: Flag = True


class DiskEntry(Painted):
    """A lying disk, facing +Y."""

    type: Literal["disk"]
    radius: Length = 1.0
    segments: Around = 48


class MeshEntry(Painted):
    """The triangles of a file, with the material given here."""

    type: Literal["mesh"]
    file: Name = Field(description=".obj, .ply, .gltf or .glb")


class GltfEntry(Placed):
    """A glTF file whole: shapes and materials, its lights, and its camera where the scene file has none."""

    type: Literal["gltf"]
    file: Name = Field(description=".gltf or .glb")
    lights: Flag = Field(True, description="Whether its lights are taken.")


ShapeEntry = Annotated[
    PlaneEntry
    | RectangleEntry
    | BoxEntry
    | SphereEntry
    | TorusEntry
    | CylinderEntry
    | ConeEntry
    | DiskEntry
    | MeshEntry
    | GltfEntry,
    Field(discriminator="type"),
]
LightEntry = Annotated[PointEntry | SpotEntry | DirectionalEntry, Field(discriminator="type")]


class SceneFile(Strict):
    """A lightmeter scene. Y up, right-handed, metres; radiance in linear Rec. 709."""

    name: Name | None = Field(None, description="The file's name unless given.")
    summary: Text = Field("", description="What the scene isolates, one sentence.")
    max_depth: Annotated[int, Field(strict=True, ge=-1, le=10000)] = Field(
        -1, description="Path length of the reference (1: emission, 2: direct light, …); −1: unlimited."
    )
    camera: CameraEntry | None = Field(None, description="A framed one unless given.")
    environment: EnvironmentEntry | None = None
    materials: dict[Name, MaterialEntry] = Field(default_factory=dict)
    lights: list[LightEntry] | None = Field(
        None, description="Without this key, without an environment and without emission: the default rig."
    )
    shapes: list[ShapeEntry] = Field(default_factory=list)

    @model_validator(mode="after")
    def _depth(self) -> "SceneFile":
        if self.max_depth == 0:
            raise ValueError("max_depth is 0, expected −1 (unlimited) or at least 1")
        return self
