"""The G-buffer's points on Dr.Jit's side: where the oracles shoot their rays from.

The material and the shading normal are the G-buffer's own; the geometric normal comes from the scene's triangle. So an
effect's error is not mixed with rasterisation or texture filtering.
"""

import numpy as np

from lightmeter.groundtruth import microsurface, surface
from lightmeter.groundtruth.scattering import MULTISCATTER
from lightmeter.groundtruth.tables import DOUBLE_SIDED
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.wavefront import Lanes, average
from lightmeter.groundtruth.world import World
from lightmeter.scenes.optics import material as optics
from lightmeter.scenes.optics.anisotropy import Grain
from lightmeter.scenes.optics.clear_coat import Coat
from lightmeter.scenes.optics.sheen import Sheen
from lightmeter.scenes.points import SurfacePoints


class Vertices:
    """The points of an image where a surface is seen, flattened.

    Args:
        points: (H, W) or any other leading shape.

    Raises:
        ValueError: a point names a shape or a triangle that the scene does not have.
    """

    def __init__(self, world: World, points: SurfacePoints):
        self.world = world
        self.lead = points.shape.shape
        self.where = np.flatnonzero(points.shape.ravel() >= 0)
        self.count = len(self.where)
        self._check(points)
        if self.count == 0:
            return  # nothing is ever evaluated, and Dr.Jit computes with no empty arrays
        # Gathered, and both from one array, lest kernels depend on how NumPy's memory is aligned (oracles/material.py).
        faces = mi.UInt32(self._rows(np.stack([points.shape, points.triangle], axis=-1), np.uint32))
        shape, triangle = dr.gather(mi.Vector2u, faces, dr.arange(mi.UInt32, self.count))
        self.position = mi.Float(world.frame.enter(self._rows(points.position).reshape(-1, 3)).ravel())
        self.normal = mi.Float(self._rows(points.normal))
        self.view = mi.Float(self._rows(points.view))
        self.base_color = mi.Float(self._rows(points.base_color))
        scalars = np.stack([points.metallic, points.roughness, points.specular, points.occlusion], axis=-1)
        self.scalars = mi.Float(self._rows(scalars))
        self.coat = self.coat_normal = None
        if points.clearcoat is not None and points.clearcoat_roughness is not None:
            self.coat = mi.Float(self._rows(np.stack([points.clearcoat, points.clearcoat_roughness], axis=-1)))
        if points.clearcoat_normal is not None:
            self.coat_normal = mi.Float(self._rows(points.clearcoat_normal))
        self.grain = None
        if points.anisotropy is not None and points.anisotropy_direction is not None:
            rows = np.concatenate([points.anisotropy_direction, points.anisotropy[..., None]], axis=-1)
            self.grain = mi.Float(self._rows(rows))
        self.sheen = None
        if points.sheen_color is not None and points.sheen_roughness is not None:
            rows = np.concatenate([points.sheen_color, points.sheen_roughness[..., None]], axis=-1)
            self.sheen = mi.Float(self._rows(rows))
        flat = surface.SurfacePoint(world.tables, shape, triangle, mi.Float(0), mi.Float(0), frozenset(), True)
        face = mi.Float64(1) * mi.Vector3d(flat.face_cross)
        self.face = mi.Float(dr.ravel(mi.Vector3f(dr.normalize(face))))
        self.start = mi.Float(dr.ravel(_not_below(self.position, self.view, self.face, flat.corner(0))))
        self.double_sided = mi.UInt32(flat.flags & DOUBLE_SIDED)
        dr.make_opaque(*(v for v in vars(self).values() if isinstance(v, mi.Float | mi.UInt32)))

    def _check(self, points: SurfacePoints) -> None:
        sizes = np.array([len(s.mesh.triangles) for s in self.world.scene.shapes] or [0])
        shape, triangle = points.shape.ravel()[self.where], points.triangle.ravel()[self.where]
        if self.count and int(shape.max()) >= len(self.world.scene.shapes):
            raise ValueError(f"a point names shape {int(shape.max())}, expected below {len(self.world.scene.shapes)}")
        wrong = np.flatnonzero((triangle < 0) | (triangle >= sizes[shape]))
        if len(wrong):
            s, t = int(shape[wrong[0]]), int(triangle[wrong[0]])
            raise ValueError(f"a point names triangle {t} of shape {s}, expected 0…{sizes[s] - 1}")

    def _rows(self, array: np.ndarray, dtype=np.float32) -> np.ndarray:
        """The rows where a surface is seen, one after another."""
        flat = np.asarray(array).reshape(int(np.prod(self.lead)), -1)
        return np.ascontiguousarray(flat[self.where].astype(dtype)).ravel()

    def at(self, place) -> "Vertex":
        """The points of lanes; `place` (UInt32) counts the seen points."""
        return Vertex(self, place)

    def _vertex(self, lanes: Lanes) -> "Vertex":
        if self.world.scattering == MULTISCATTER:
            return MultiscatterVertex(self, lanes)
        return self.at(lanes.place)

    def image(self, values: np.ndarray) -> np.ndarray:
        """(C, count) → (*lead, C) float32, zero where nothing is seen."""
        out = np.zeros((int(np.prod(self.lead)), len(values)), np.float32)
        out[self.where] = values.T
        return out.reshape(*self.lead, len(values))

    def average(self, spp: int, seed: tuple[int, ...], estimate, channels: int, dimensions: int) -> np.ndarray:
        """(*lead, channels) float32: the mean of `estimate(vertex, lanes)` over `spp` samples at each point."""
        if self.count == 0:
            return np.zeros((*self.lead, channels), np.float32)

        def per_lane(lanes: Lanes):
            return estimate(self._vertex(lanes), lanes)

        return self.image(average(self.count, spp, seed, per_lane, channels, dimensions))


def _not_below(positions, views, faces, corner):
    """Point3f: where rays start.

    A position that was stored in few bits lies off its triangle. Under it all would be dark, which says nothing of how
    the point is shaded: rays start on the triangle's plane. What is as near to it as Mitsuba's own offset of rays,
    which is far more than float32's rounding, stays.
    """
    lane = dr.arange(mi.UInt32, dr.width(positions) // 3)
    position = dr.gather(mi.Point3f, positions, lane)
    view, face = dr.gather(mi.Vector3f, views, lane), dr.gather(mi.Vector3f, faces, lane)
    height = dr.dot(position - corner, face)
    offset = mi.math.RayEpsilon * (1 + dr.max(dr.abs(position)))
    below = (dr.abs(height) > offset) & (height * dr.dot(face, view) < 0)
    return dr.select(below, position - height * face, position)


class Vertex:
    """One point per lane.

    Attributes:
        position: where the G-buffer has it, in the world's frame as all that is here.
        interaction: where rays start, with the geometric normal (Mitsuba's own rule for the offset).
        normal, view: shading normal and direction to the viewer.
        material: the G-buffer's parameters.
    """

    def __init__(self, vertices: Vertices, place):
        def vector(kind, table):
            return dr.gather(kind, table, place)

        self.normal, self.view = vector(mi.Vector3f, vertices.normal), vector(mi.Vector3f, vertices.view)
        self.face = vector(mi.Vector3f, vertices.face)
        scalars = vector(mi.Vector4f, vertices.scalars)
        color = vector(mi.Color3f, vertices.base_color)
        coat = None
        if vertices.coat is not None:
            own = vertices.coat_normal
            normal = self.normal if own is None else vector(mi.Vector3f, own)
            factors = vector(mi.Vector2f, vertices.coat)
            coat = Coat(factors[0], factors[1], normal)
        grain = None
        if vertices.grain is not None:
            row = vector(mi.Vector4f, vertices.grain)
            grain = Grain(row[3], mi.Vector3f(row[0], row[1], row[2]))
        sheen = None
        if vertices.sheen is not None:
            row = vector(mi.Vector4f, vertices.sheen)
            sheen = Sheen(mi.Color3f(row[0], row[1], row[2]), row[3], vertices.world.tables.sheen_albedo)
        self.material = optics.MaterialPoint(color, scalars[0], scalars[1], scalars[2], coat, grain, sheen)
        self.interaction = dr.zeros(mi.SurfaceInteraction3f, dr.width(place))
        self.position = vector(mi.Point3f, vertices.position)
        self.interaction.p = vector(mi.Point3f, vertices.start)
        self.interaction.n = mi.Normal3f(self.face)
        self.interaction.sh_frame = mi.Frame3f(self.face)
        self._viewer_side = dr.dot(self.face, self.view)
        self._scatters = (self._viewer_side > 0) | (dr.gather(mi.UInt32, vertices.double_sided, place) != 0)

    @property
    def material_in_double(self) -> optics.MaterialPoint:
        """The material for closed forms in double precision."""
        material, coat = self.material, self.material.coat
        if coat is not None:
            normal = dr.normalize(mi.Vector3d(coat.normal))
            coat = Coat(mi.Float64(coat.factor), mi.Float64(coat.roughness), normal)
        grain = material.grain
        if grain is not None:
            grain = Grain(mi.Float64(grain.strength), dr.normalize(mi.Vector3d(grain.direction)))
        sheen = material.sheen
        if sheen is not None:
            sheen = Sheen(mi.Color3d(sheen.color), mi.Float64(sheen.roughness), mi.Float64(sheen.table))
        metallic, roughness = mi.Float64(material.metallic), mi.Float64(material.roughness)
        color, specular = mi.Color3d(material.base_color), mi.Float64(material.specular)
        return optics.MaterialPoint(color, metallic, roughness, specular, coat, grain, sheen)

    def carries(self, light):
        """Bool: the transport's rule, light on the viewer's side of the geometric face, which must scatter."""
        return self._scatters & (self._viewer_side * dr.dot(self.face, light) > 0)

    def evaluate(self, light):
        """f·cos and the density of `sample`, by the optics alone."""
        value = optics.evaluate(self.material, self.normal, self.view, light)
        return value, optics.pdf(self.material, self.normal, self.view, light)

    def sample(self, pattern):
        """A direction from the material: (direction, f·cos/pdf, pdf); three dimensions of the pattern."""
        u = (pattern.next(), pattern.next(), pattern.next())
        light = optics.sample(self.material, self.normal, self.view, u, mi.Vector3f)
        value, density = self.evaluate(light)
        return light, dr.select(density > 0, value / density, 0), density


class MultiscatterVertex(Vertex):
    """One point per lane whose rough surfaces scatter more than once (see `microsurface`): values are estimates.

    Every call draws further random numbers of the lane, so that estimates are independent of each other.
    """

    def __init__(self, vertices: Vertices, lanes: Lanes):
        super().__init__(vertices, lanes.place)
        numbers = lanes.sampler
        self._noise = microsurface.Noise(lanes.place, numbers.next_1d(), numbers.next_1d())

    def evaluate(self, light):
        """An unbiased estimate of f·cos, and the density that weighs it against other strategies."""
        return microsurface.evaluate(self.material, self.normal, self.view, light, self._noise)

    def further_bounces(self, light):
        """Color3f: an unbiased estimate of that part of f·cos which has no closed form."""
        return microsurface.towards(self.material, self.normal, self.view, light, self._noise)

    def sample(self, pattern):
        """A direction from the material: (direction, its weight, density); three dimensions of the pattern."""
        u = (pattern.next(), pattern.next(), pattern.next())
        return microsurface.sample(self.material, self.normal, self.view, u, self._noise)
