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
        shape = mi.UInt32(self._rows(points.shape, np.uint32))
        triangle = mi.UInt32(self._rows(points.triangle, np.uint32))
        self.position = mi.Float(self._rows(points.position))
        self.normal = mi.Float(self._rows(points.normal))
        self.view = mi.Float(self._rows(points.view))
        self.base_color = mi.Float(self._rows(points.base_color))
        scalars = np.stack([points.metallic, points.roughness, points.specular, points.occlusion], axis=-1)
        self.scalars = mi.Float(self._rows(scalars))
        flat = surface.SurfacePoint(world.tables, shape, triangle, mi.Float(0), mi.Float(0), frozenset(), True)
        face = mi.Float64(1) * mi.Vector3d(flat.face_cross)
        self.face = mi.Float(dr.ravel(mi.Vector3f(dr.normalize(face))))
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


class Vertex:
    """One point per lane.

    Attributes:
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
        self.material = optics.MaterialPoint(color, scalars[0], scalars[1], scalars[2])
        self.interaction = dr.zeros(mi.SurfaceInteraction3f, dr.width(place))
        self.interaction.p = vector(mi.Point3f, vertices.position)
        self.interaction.n = mi.Normal3f(self.face)
        self.interaction.sh_frame = mi.Frame3f(self.face)
        self._viewer_side = dr.dot(self.face, self.view)
        self._scatters = (self._viewer_side > 0) | (dr.gather(mi.UInt32, vertices.double_sided, place) != 0)

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
