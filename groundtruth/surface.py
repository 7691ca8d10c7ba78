"""The scene's surface at points: interpolated and textured, as `scenes/optics` means it, from the flat tables.

A point is given by the shape's index, the triangle's and the barycentric coordinates b1, b2 of its second and third
corner. The same functions serve the reference's BSDF and the oracles.
"""

from collections.abc import Callable
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

from lightmeter.groundtruth.tables import DOUBLE_SIDED, MASKED, SLOTS, Tables
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.optics import frames
from lightmeter.scenes.optics.anisotropy import Grain
from lightmeter.scenes.optics.clear_coat import Coat
from lightmeter.scenes.optics.material import MaterialPoint
from lightmeter.scenes.optics.sheen import Sheen
from lightmeter.scenes.optics.texture import TexelGrid

ALL_SLOTS = frozenset(SLOTS) | {"color", "coat", "grain", "sheen"}


@dataclass
class SurfacePoint:
    """Reads the tables at points, when asked.

    Attributes:
        shape, triangle: UInt32 indices.
        b1, b2: barycentric coordinates.
        slots: the texture slots (and "color", the vertex colours, and the material's layers, such as "coat") to look
            at; others count as absent.
        active: which lanes may read.
    """

    tables: Tables
    shape: object
    triangle: object
    b1: object
    b2: object
    slots: AbstractSet[str]
    active: object

    def __post_init__(self):
        row = dr.gather(mi.Vector4u, self.tables.shape_ints, 2 * self.shape, self.active)
        self.first_triangle, self.flags, self._tangent, self._tangent_stride = row
        self._local_corner = 3 * self.triangle

    def _floats(self, quarter: int):
        return dr.gather(mi.Vector4f, self.tables.shape_floats, 4 * self.shape + quarter, self.active)

    def _corners(self, vector, table, first, stride):
        """The interpolated rows of a corner table, not normalised."""
        row = first + stride * self._local_corner
        a, b, c = (dr.gather(vector, table, row + stride * k, self.active) for k in range(3))
        return (1 - self.b1 - self.b2) * a + self.b1 * b + self.b2 * c

    @property
    def double_sided(self):
        """Bool: whether both sides scatter and emit."""
        return (self.flags & DOUBLE_SIDED) != 0

    @property
    def position(self):
        """Point3f in world space."""
        return mi.Point3f(self._corners(mi.Vector3f, self.tables.positions, 3 * self.first_triangle, mi.UInt32(1)))

    def corner(self, k: int):
        """Point3f: corner k of the triangle, world space."""
        row = 3 * (self.first_triangle + self.triangle) + k
        return dr.gather(mi.Point3f, self.tables.positions, row, self.active)

    @property
    def face_cross(self):
        """Vector3f along the face's front normal, twice the triangle's area long."""
        a, b, c = (self.corner(k) for k in range(3))
        return dr.cross(b - a, c - a)

    @property
    def normal(self):
        """Vector3f: the unit shading normal on the face's front, normal map included."""
        return self._mapped("normal", lambda: self._floats(1)[3])

    @property
    def coat_normal(self):
        """Vector3f: the unit normal of the coat on the face's front, with the coat's own normal map."""
        return self._mapped("clearcoat_normal", lambda: self._floats(3)[3])

    def _mapped(self, slot: str, scale: Callable):
        """The interpolated normal, moved by the normal map in a slot where there is one."""
        n = self._corners(mi.Vector3f, self.tables.normals, 3 * self.first_triangle, mi.UInt32(1))
        if slot not in self.slots:
            return dr.normalize(n)
        mapped = frames.decode_normal(self.texel(slot), scale(), mi.Vector3f)
        return frames.tangent_to_world(*self._tangent_and_sign(), n, mapped)

    def _tangent_and_sign(self):
        """The interpolated tangent and the bitangent's sign."""
        tangent = self._corners(mi.Vector4f, self.tables.tangents, self._tangent, self._tangent_stride)
        return mi.Vector3f(tangent[0], tangent[1], tangent[2]), dr.select(tangent[3] < 0, -1, mi.Float(1))

    @property
    def base_color_alpha(self):
        """Vector4f: linear base colour and opacity, texture and vertex colours multiplied in."""
        value = self._floats(0)
        if "base_color" in self.slots:
            value *= self.texel("base_color")
        if "color" in self.slots:
            ints = dr.gather(mi.Vector4u, self.tables.shape_ints, 2 * self.shape + 1, self.active)
            value *= self._corners(mi.Vector4f, self.tables.colors, ints[0], ints[1])
        return value

    @property
    def present(self):
        """Bool: whether the surface is there (alpha masks have holes)."""
        cutoff = self._floats(2)[3]
        return ((self.flags & MASKED) == 0) | (self.base_color_alpha[3] >= cutoff)

    @property
    def material(self) -> MaterialPoint:
        """The scattering parameters; the coat's normal on the face's front."""
        color = self.base_color_alpha
        factors = self._floats(1)
        metallic, roughness = factors[0], factors[1]
        if "metallic_roughness" in self.slots:
            texel = self.texel("metallic_roughness")
            metallic, roughness = metallic * texel[2], roughness * texel[1]
        coat = self._coat if "coat" in self.slots else None
        grain = self._grain if "grain" in self.slots else None
        sheen = self._sheen if "sheen" in self.slots else None
        return MaterialPoint(
            mi.Color3f(color[0], color[1], color[2]), metallic, roughness, factors[2], coat, grain, sheen
        )

    @property
    def _coat(self) -> Coat:
        _, factor, roughness, _ = self._floats(3)
        if "clearcoat" in self.slots:
            factor = factor * self.texel("clearcoat")[0]
        if "clearcoat_roughness" in self.slots:
            roughness = roughness * self.texel("clearcoat_roughness")[1]
        return Coat(factor, roughness, self.coat_normal)

    @property
    def _grain(self) -> Grain:
        strength, x, y, _ = dr.gather(mi.Vector4f, self.tables.grain_floats, self.shape, self.active)
        if "anisotropy" in self.slots:
            texel = self.texel("anisotropy")
            strength = strength * texel[2]
            u, v = 2 * texel[0] - 1, 2 * texel[1] - 1
            x, y = x * u - y * v, y * u + x * v
        n = self._corners(mi.Vector3f, self.tables.normals, 3 * self.first_triangle, mi.UInt32(1))
        direction = frames.along_grain(*self._tangent_and_sign(), n, self.normal, x, y, mi.Vector3f)
        return Grain(strength, direction)

    @property
    def _sheen(self) -> Sheen:
        *color, roughness = dr.gather(mi.Vector4f, self.tables.sheen_floats, self.shape, self.active)
        color = mi.Color3f(*color)
        if "sheen_color" in self.slots:
            texel = self.texel("sheen_color")
            color = color * mi.Color3f(texel[0], texel[1], texel[2])
        if "sheen_roughness" in self.slots:
            roughness = roughness * self.texel("sheen_roughness")[3]
        return Sheen(color, roughness, self.tables.sheen_albedo)

    @property
    def emission(self):
        """Color3f: radiance leaving the front, W/(sr·m²), whether the surface is there or not."""
        factors = self._floats(2)
        value = mi.Color3f(factors[0], factors[1], factors[2])
        if "emissive" in self.slots:
            texel = self.texel("emissive")
            value *= mi.Color3f(texel[0], texel[1], texel[2])
        return value

    @property
    def occlusion(self):
        """Float: glTF's baked occlusion, 1 + strength·(texel − 1)."""
        if "occlusion" not in self.slots:
            return dr.full(mi.Float, 1, dr.width(self.shape))
        return 1 + self._floats(3)[0] * (self.texel("occlusion")[0] - 1)

    def texel(self, slot: str):
        """Vector4f: the slot's linear RGBA, level 0."""
        row = 2 * (len(SLOTS) * self.shape + SLOTS.index(slot))
        first_texel, texcoord, stride, width = dr.gather(mi.Vector4u, self.tables.slot_ints, row, self.active)
        height, wrap_u, wrap_v, nearest = dr.gather(mi.Vector4u, self.tables.slot_ints, row + 1, self.active)
        m0 = dr.gather(mi.Vector4f, self.tables.slot_floats, row, self.active)
        m1 = dr.gather(mi.Vector4f, self.tables.slot_floats, row + 1, self.active)
        uv = self._corners(mi.Vector2f, self.tables.texcoords, texcoord, stride)
        grid = TexelGrid(mi.Float(width), mi.Float(height), wrap_u, wrap_v, nearest, (*m0, m1[0], m1[1]))
        total = mi.Vector4f(0)
        for column, line, weight in grid.taps(uv[0], uv[1]):
            # Whole numbers: float32 loses them above 2²⁴, and all images lie in one array.
            index = first_texel + mi.UInt32(line) * width + mi.UInt32(column)
            total += weight * dr.gather(mi.Vector4f, self.tables.texels, index, self.active)
        return total


def shape_index(tables: Tables, shape_pointer, active):
    """UInt32: index into `Scene.shapes` of what Mitsuba's shape pointers point at."""
    return dr.gather(mi.UInt32, tables.shape_of, dr.reinterpret_array(mi.UInt32, shape_pointer), active)


def at_hit(tables: Tables, si, slots: AbstractSet[str], active) -> SurfacePoint:
    """The surface at Mitsuba's intersections, whose `uv` are barycentric as the meshes have no texture coordinates."""
    return SurfacePoint(tables, shape_index(tables, si.shape, active), si.prim_index, si.uv[0], si.uv[1], slots, active)
