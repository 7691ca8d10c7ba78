"""The scene: one immutable description, rendered by both sides.

Conventions, stated once and tested in `tests/scenes/test_conventions.py`:

- right-handed, Y up, metres; column vectors (`world = matrix @ local`);
- a camera looks along its local −Z with +Y up; pixel (0, 0) is the top left one and its centre is at
  (0.5, 0.5);
- radiance is linear Rec. 709 in W/(sr·m²); colours are linear unless an image says `srgb`;
- a triangle's front is where its vertices run anticlockwise;
- texture coordinates have their origin at the top left of the image, as in glTF.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, Protocol

import numpy as np

from lightmeter.scenes.aperture import Aperture
from lightmeter.scenes.metering import Metering
from lightmeter.scenes.texels import check_texels

Vector = tuple[float, float, float]


def _frozen(array, dtype, shape: tuple[int, ...]) -> np.ndarray:
    """A read-only, contiguous copy of `array`; −1 in `shape` stands for any length."""
    out = np.array(array, dtype=dtype, order="C")
    if out.size == 0 and -1 in shape:
        out = out.reshape([0 if n == -1 else n for n in shape])
    if out.ndim != len(shape) or any(n not in (-1, m) for n, m in zip(shape, out.shape, strict=True)):
        raise ValueError(f"expected an array of shape {shape} (−1: any), got {out.shape}")
    out.flags.writeable = False
    return out


@dataclass(frozen=True, eq=False)
class Image:
    """Texels, row 0 at the top.

    Attributes:
        texels: (H, W, C) uint8 or float32, C = 1…4.
        name: where it came from, for messages.
    """

    texels: np.ndarray
    name: str = ""

    def __post_init__(self):
        dtype = np.uint8 if self.texels.dtype == np.uint8 else np.float32
        object.__setattr__(self, "texels", _frozen(self.texels, dtype, (-1, -1, -1)))


Wrap = Literal["repeat", "clamp", "mirror"]
MinFilter = Literal[
    "nearest",
    "linear",
    "nearest_mipmap_nearest",
    "linear_mipmap_nearest",
    "nearest_mipmap_linear",
    "linear_mipmap_linear",
]


@dataclass(frozen=True)
class Texture:
    """An image with the way it is looked up (a glTF texture, its sampler and KHR_texture_transform).

    Attributes:
        image: the texels.
        srgb: whether colour channels are sRGB-encoded (IEC 61966-2-1); alpha never is.
        wrap_u, wrap_v: what happens outside [0, 1].
        min_filter, mag_filter: the real-time side's filters; the truth always looks up level 0, bilinearly.
        texcoord: which set of texture coordinates.
        offset, rotation, scale: KHR_texture_transform; rotation in radians, anticlockwise.

    Raises:
        SceneError: a texel is not finite, or negative.
    """

    image: Image
    srgb: bool = False
    wrap_u: Wrap = "repeat"
    wrap_v: Wrap = "repeat"
    min_filter: MinFilter = "linear_mipmap_linear"
    mag_filter: Literal["nearest", "linear"] = "linear"
    texcoord: int = 0
    offset: tuple[float, float] = (0.0, 0.0)
    rotation: float = 0.0
    scale: tuple[float, float] = (1.0, 1.0)

    def __post_init__(self):
        check_texels(self.image.texels, self.image.name)

    @cached_property
    def matrix(self) -> np.ndarray:
        """(2, 3) float64: maps (u, v, 1) to the looked-up coordinates (KHR_texture_transform)."""
        c, s = np.cos(self.rotation), np.sin(self.rotation)
        (su, sv), (ou, ov) = self.scale, self.offset
        return np.array([[c * su, s * sv, ou], [-s * su, c * sv, ov]])


@dataclass(frozen=True)
class Material:
    """glTF 2.0's metallic-roughness material (specification, Appendix B).

    Attributes:
        base_color: linear RGB reflectance, 0…1.
        alpha: opacity, multiplied with the texture's.
        metallic, roughness: 0…1.
        specular: KHR_materials_specular's factor, 0…1; 0 makes a dielectric purely diffuse.
        emissive: radiance leaving the front, W/(sr·m²) (KHR_materials_emissive_strength is folded in).
        alpha_mode: "opaque", or "mask": a point is there where alpha ≥ `alpha_cutoff`.
        double_sided: else the back is opaque and black (it absorbs) on both sides of the comparison.
        clearcoat, clearcoat_roughness: KHR_materials_clearcoat, 0…1; 0: there is no coat.
        clearcoat_texture, clearcoat_roughness_texture: factors in red and in green.
        clearcoat_normal_texture: without one the coat is smooth, whatever the base's normal texture does.
        anisotropy: KHR_materials_anisotropy's strength, 0…1; 0: the gloss is alike in all directions.
        anisotropy_rotation: of the grain, from the tangent towards the bitangent, radians.
        anisotropy_texture: the grain's direction in red and green (0…1 stands for −1…1), a factor in blue.
        sheen_color, sheen_roughness: KHR_materials_sheen, 0…1; black: there is no sheen.
        sheen_color_texture, sheen_roughness_texture: factors in red, green and blue (sRGB-encoded), and in alpha.
        ior: index of refraction of the solid that the surface bounds, above 1; 0: it is opaque. Such a surface is
            smooth, its front outside; it mirrors and refracts, and is otherwise black: base colour and specular are 0.
        absorption: of the solid's inside, 1/m, RGB.
        left_out: extensions of its file that are not read and would change how it looks.

    Raises:
        ValueError: a solid's surface would scatter besides.
    """

    name: str = "material"
    base_color: Vector = (1.0, 1.0, 1.0)
    alpha: float = 1.0
    metallic: float = 0.0
    roughness: float = 1.0
    specular: float = 1.0
    emissive: Vector = (0.0, 0.0, 0.0)
    base_color_texture: Texture | None = None
    metallic_roughness_texture: Texture | None = None
    normal_texture: Texture | None = None
    normal_scale: float = 1.0
    occlusion_texture: Texture | None = None
    occlusion_strength: float = 1.0
    emissive_texture: Texture | None = None
    alpha_mode: Literal["opaque", "mask"] = "opaque"
    alpha_cutoff: float = 0.5
    double_sided: bool = False
    clearcoat: float = 0.0
    clearcoat_roughness: float = 0.0
    clearcoat_texture: Texture | None = None
    clearcoat_roughness_texture: Texture | None = None
    clearcoat_normal_texture: Texture | None = None
    clearcoat_normal_scale: float = 1.0
    anisotropy: float = 0.0
    anisotropy_rotation: float = 0.0
    anisotropy_texture: Texture | None = None
    sheen_color: Vector = (0.0, 0.0, 0.0)
    sheen_roughness: float = 0.0
    sheen_color_texture: Texture | None = None
    sheen_roughness_texture: Texture | None = None
    ior: float = 0.0
    absorption: Vector = (0.0, 0.0, 0.0)
    left_out: tuple[str, ...] = ()

    def __post_init__(self):
        if self.is_glass and (max(self.base_color) > 0 or self.specular > 0 or self.layers):
            raise ValueError("the surface of a dielectric solid has no base colour, no specular and no layers")

    @property
    def is_glass(self) -> bool:
        """Whether it bounds a dielectric solid."""
        return self.ior > 0

    @property
    def textures(self) -> dict[str, Texture]:
        """The textures it looks up, by the slot's name: those of a layer only where there is the layer."""
        slots = ("base_color", "metallic_roughness", "normal", "occlusion", "emissive")
        if self.clearcoat > 0:
            slots += ("clearcoat", "clearcoat_roughness", "clearcoat_normal")
        if self.anisotropy > 0:
            slots += ("anisotropy",)
        if max(self.sheen_color) > 0:
            slots += ("sheen_color", "sheen_roughness")
        found = {slot: getattr(self, f"{slot}_texture") for slot in slots}
        return {slot: texture for slot, texture in found.items() if texture is not None}

    @property
    def layers(self) -> frozenset[str]:
        """What it has beyond the metallic-roughness base: "coat", "grain" (anisotropy), "sheen"."""
        there = {"coat": self.clearcoat > 0, "grain": self.anisotropy > 0, "sheen": max(self.sheen_color) > 0}
        return frozenset(name for name, is_there in there.items() if is_there)

    @property
    def has_normal_map(self) -> bool:
        """Whether any of its normals is not the mesh's."""
        return not self.textures.keys().isdisjoint({"normal", "clearcoat_normal"})

    @property
    def uses_tangents(self) -> bool:
        """Whether its mesh needs tangents."""
        return self.has_normal_map or self.anisotropy > 0

    @property
    def emits(self) -> bool:
        """Whether any light leaves its front."""
        return max(self.emissive) > 0


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles with attributes per vertex.

    Attributes:
        positions: (N, 3) float32, metres.
        triangles: (M, 3) uint32.
        normals: (N, 3) float32, or None: flat.
        texcoords: sets of (N, 2) float32.
        tangents: (N, 4) float32, w is the bitangent's sign (MikkTSpace), or None.
        colors: (N, 4) float32 linear, multiplied into the base colour, or None.
    """

    positions: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray | None = None
    texcoords: tuple[np.ndarray, ...] = ()
    tangents: np.ndarray | None = None
    colors: np.ndarray | None = None

    def __post_init__(self):
        put = object.__setattr__
        put(self, "positions", _frozen(self.positions, np.float32, (-1, 3)))
        put(self, "triangles", _frozen(self.triangles, np.uint32, (-1, 3)))
        n = len(self.positions)
        if self.triangles.size and int(self.triangles.max()) >= n:
            raise ValueError(f"a triangle names vertex {int(self.triangles.max())}, expected below {n}")
        for name, width in (("normals", 3), ("tangents", 4), ("colors", 4)):
            if getattr(self, name) is not None:
                put(self, name, _frozen(getattr(self, name), np.float32, (n, width)))
        put(self, "texcoords", tuple(_frozen(uv, np.float32, (n, 2)) for uv in self.texcoords))


class Form(Protocol):
    """A shape by its equation, see `shapes/forms.py`; hashable."""

    def mesh(self, steps: int) -> Mesh:
        """Its triangles at so many steps around its axis, the vertices and their normals true."""
        ...


IDENTITY = np.eye(4)
IDENTITY.flags.writeable = False


@dataclass(frozen=True, eq=False)
class Shape:
    """A mesh, placed and given a material.

    Attributes:
        matrix: (4, 4) float64, local to world.
        form: what the mesh stands for, in the same local space; None where it is nothing but its triangles.
    """

    name: str
    mesh: Mesh
    material: Material
    matrix: np.ndarray = field(default_factory=lambda: IDENTITY)
    form: Form | None = None

    @cached_property
    def world(self) -> Mesh:
        """The mesh in world space, rounded to float32 once, so that both renderers see the same triangles.

        A mirroring matrix turns the triangles round, so that their fronts stay fronts (glTF, 3.7.4).
        """
        linear = self.matrix[:3, :3]
        positions = self.mesh.positions @ linear.T + self.matrix[:3, 3]
        flipped = np.linalg.det(linear) < 0
        triangles = self.mesh.triangles[:, ::-1] if flipped else self.mesh.triangles
        normals = tangents = None
        if self.mesh.normals is not None:
            cofactor = np.linalg.det(linear) * np.linalg.inv(linear).T if np.linalg.det(linear) else linear
            normals = _normalized(self.mesh.normals @ cofactor.T) * (-1 if flipped else 1)
        if self.mesh.tangents is not None:
            directions = _normalized(self.mesh.tangents[:, :3] @ linear.T)
            sign = self.mesh.tangents[:, 3:] * (-1 if flipped else 1)
            tangents = np.concatenate([directions, sign], axis=1)
        return Mesh(positions, triangles, normals, self.mesh.texcoords, tangents, self.mesh.colors)


def _normalized(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors; a zero vector stays zero."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


@dataclass(frozen=True)
class PointLight:
    """Radiates `intensity` (W/sr, RGB) in every direction from `position`.

    Attributes:
        range: metres at which its light ends, by glTF's window; None: unlimited.
    """

    name: str
    position: Vector
    intensity: Vector
    range: float | None = None


@dataclass(frozen=True)
class SpotLight:
    """A point light within a cone, with the falloff of KHR_lights_punctual.

    Attributes:
        direction: where it points, a unit vector.
        inner, outer: half angles in radians, 0 ≤ inner < outer ≤ π/2.
        range: metres at which its light ends, by glTF's window; None: unlimited.
    """

    name: str
    position: Vector
    direction: Vector
    intensity: Vector
    inner: float
    outer: float
    range: float | None = None


@dataclass(frozen=True)
class DirectionalLight:
    """Parallel light: `irradiance` (W/m², RGB) on a plane across `direction` (the way the light travels)."""

    name: str
    direction: Vector
    irradiance: Vector


@dataclass(frozen=True, eq=False)
class AreaLight:
    """An emissive surface seen as a light; derived from the shapes, never written down."""

    shape: int
    name: str
    radiance: Vector


PunctualLight = PointLight | SpotLight | DirectionalLight
Light = PunctualLight | AreaLight


@dataclass(frozen=True, eq=False)
class Environment:
    """What surrounds the scene, infinitely far away.

    Attributes:
        radiance: W/(sr·m²), RGB; multiplied with the map's texels where there is one.
        map: latitude-longitude texels, (H, W, 3) float32, finite and not negative; None: the same everywhere. Which
            direction a texel stands for is defined in `optics/environment.py`.
        rotation: radians by which the map is turned about +Y, anticlockwise as seen from above.
    """

    radiance: Vector
    map: Image | None = None
    rotation: float = 0.0

    @cached_property
    def mean(self) -> Vector:
        """The mean radiance over all directions: of the texels, weighted with the solid angle of their rows."""
        if self.map is None:
            return self.radiance
        texels = self.map.texels.astype(np.float64)
        rows = np.sin(np.pi * (np.arange(len(texels)) + 0.5) / len(texels))
        red, green, blue = np.average(texels.mean(axis=1), axis=0, weights=rows) * self.radiance
        return float(red), float(green), float(blue)

    @property
    def shines(self) -> bool:
        """Whether any light comes from it."""
        return max(self.mean) > 0


View = Literal["aces-1", "aces-2"]


@dataclass(frozen=True, eq=False)
class Camera:
    """A perspective camera (`yfov`) or an orthographic one (`ymag`); the width follows the image's size.

    Attributes:
        matrix: (4, 4) float64, camera to world.
        yfov: full vertical angle of view in radians, or None.
        ymag: half the height of what is seen, metres, or None.
        near, far: the clipping distances of the real-time side, metres.
        exposure: stops, applied before the display transform on both sides; with metering, added to what it gives.
        metering: how the exposure is found in the picture; None: it is set by hand.
        aperture: the opening that light is diffracted at; None: it is not.
        view: the display transform that tone curves are held against: of ACES 1.0 or of ACES 2.0.
    """

    name: str
    matrix: np.ndarray
    yfov: float | None = None
    ymag: float | None = None
    near: float = 0.01
    far: float = 100.0
    exposure: float = 0.0
    metering: Metering | None = None
    aperture: Aperture | None = None
    view: View = "aces-1"

    def __post_init__(self):
        object.__setattr__(self, "matrix", _frozen(self.matrix, np.float64, (4, 4)))
        if (self.yfov is None) == (self.ymag is None):
            raise ValueError("a camera has either yfov (perspective) or ymag (orthographic)")

    @property
    def position(self) -> np.ndarray:
        """(3,) float64, world space."""
        return self.matrix[:3, 3]

    def exposure_scale(self, average: float | None = None) -> float:
        """What pictures are multiplied with before the display transform.

        Args:
            average: the log₂ of the average luminance that was metered; None: nothing was.
        """
        metered = 1.0 if self.metering is None or average is None else self.metering.scale(average)
        return metered * 2.0**self.exposure


@dataclass(frozen=True, eq=False)
class Scene:
    """Everything that both renderers are told.

    Attributes:
        name: as the user calls it.
        shapes, lights, environment, camera: what there is; `lights` holds the punctual ones.
        max_depth: path length of the reference (1: emission, 2: direct light, …), or −1: unlimited.
        summary: what the scene isolates, one sentence.
        notes: what the loader decided or left out, and what that does; printed in the report.
    """

    name: str
    shapes: tuple[Shape, ...]
    camera: Camera
    lights: tuple[PunctualLight, ...] = ()
    environment: Environment | None = None
    max_depth: int = -1
    summary: str = ""
    notes: tuple[str, ...] = ()

    @cached_property
    def area_lights(self) -> tuple[AreaLight, ...]:
        """The emissive shapes, as lights, in the order of the shapes."""
        return tuple(
            AreaLight(index, shape.name, shape.material.emissive)
            for index, shape in enumerate(self.shapes)
            if shape.material.emits and len(shape.mesh.triangles)
        )

    @cached_property
    def all_lights(self) -> tuple[Light, ...]:
        """Every light: the punctual ones, then the emissive surfaces."""
        return self.lights + self.area_lights

    @cached_property
    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Lowest and highest corner of the shapes, each (3,) float64; both zero when there is no shape."""
        corners = [s.world.positions for s in self.shapes if len(s.mesh.positions)]
        if not corners:
            return np.zeros(3), np.zeros(3)
        low = np.min([c.min(axis=0) for c in corners], axis=0)
        high = np.max([c.max(axis=0) for c in corners], axis=0)
        return low.astype(np.float64), high.astype(np.float64)
