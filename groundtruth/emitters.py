"""The scene's lights as Mitsuba emitters.

Mitsuba's own `point`, `directional`, `constant` and `area` where they mean what the scene means; its spot does not
(its falloff is linear in the angle), its point light has no range, and its area light can neither emit from both sides
nor sample a textured mesh.
"""

import math

import numpy as np

from lightmeter.groundtruth import surface
from lightmeter.groundtruth.tables import Tables
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.model import DirectionalLight, PointLight, PunctualLight, Shape, SpotLight
from lightmeter.scenes.optics import lights as optics


def punctual(light: PunctualLight):
    """The Mitsuba emitter of a point, spot or directional light."""
    match light:
        case PointLight(range=None):
            return mi.load_dict(
                {"type": "point", "position": list(light.position), "intensity": _rgb(light.intensity)}, optimize=False
            )
        case DirectionalLight():
            return mi.load_dict(
                {"type": "directional", "direction": list(light.direction), "irradiance": _rgb(light.irradiance)},
                optimize=False,
            )
        case PointLight() | SpotLight():
            return PositionEmitter(light)
    raise TypeError(f"no such light: {type(light).__name__}")


def constant(radiance):
    """Mitsuba's constant environment."""
    return mi.load_dict({"type": "constant", "radiance": _rgb(radiance)}, optimize=False)


def is_plain(shape: Shape) -> bool:
    """Whether Mitsuba's own area light does for an emissive shape."""
    material = shape.material
    return material.emissive_texture is None and material.alpha_mode == "opaque" and not material.double_sided


def area(shape: Shape):
    """The emitter of an emissive shape; a `SurfaceEmitter` still has to be told its tables."""
    if is_plain(shape):
        return mi.load_dict({"type": "area", "radiance": _rgb(shape.material.emissive)}, optimize=False)
    return SurfaceEmitter(shape)


def _rgb(color) -> dict:
    return {"type": "rgb", "value": [float(c) for c in color]}


def _opaque(kind, *values):
    number = int if kind is mi.UInt32 else float
    plain = [number(value) for value in values]
    array = kind(*plain) if len(plain) > 1 else kind(plain)
    dr.make_opaque(array)
    return array


class PositionEmitter(mi.Emitter):
    """A point or spot light with the falloffs of KHR_lights_punctual (`scenes/optics/lights.py`)."""

    def __init__(self, light: PointLight | SpotLight):
        super().__init__(mi.Properties())
        self.position = _opaque(mi.Point3f, *light.position)
        self.intensity = _opaque(mi.Color3f, *light.intensity)
        self.range_square = None if light.range is None else _opaque(mi.Float, light.range**2)
        self.is_spot = isinstance(light, SpotLight)
        if isinstance(light, SpotLight):
            self.direction = _opaque(mi.Vector3f, *(np.array(light.direction) / np.linalg.norm(light.direction)))
            self.inner, self.outer = _opaque(mi.Float, light.inner), _opaque(mi.Float, light.outer)
        self.m_flags = +mi.EmitterFlags.DeltaPosition
        self.m_needs_sample_2 = self.m_needs_sample_3 = False

    def _irradiance(self, towards, inverse_square):
        """W/m² across the direction to the light, `towards`."""
        strength = inverse_square
        if self.range_square is not None:
            strength *= optics.range_window(inverse_square, self.range_square)
        if self.is_spot:
            strength *= optics.spot_attenuation(-dr.dot(towards, self.direction), self.inner, self.outer)
        return self.intensity * strength

    def sample_direction(self, it, sample, active=True):
        """The one direction to the light, and its irradiance across it."""
        ds = dr.zeros(mi.DirectionSample3f, dr.width(it.p))
        ds.p, ds.delta, ds.pdf, ds.time = self.position, True, 1.0, it.time
        ds.emitter = mi.EmitterPtr(self)
        ds.d, inverse_square = optics.from_position(self.position, it.p)
        ds.dist = dr.norm(self.position - it.p)
        ds.n = -ds.d
        return ds, dr.select(active, self._irradiance(ds.d, inverse_square), 0)

    def pdf_direction(self, it, ds, active=True):
        """0: no ray finds a point."""
        return mi.Float(0)

    def eval_direction(self, it, ds, active=True):
        """Irradiance across `ds.d` for a direction made by `sample_direction`."""
        return dr.select(active, self._irradiance(ds.d, 1 / dr.square(ds.dist)), 0)

    def eval(self, si, active=True):
        """0: it is not on a surface."""
        return mi.Color3f(0)

    def bbox(self):
        """Empty: a light does not make the scene larger."""
        return mi.ScalarBoundingBox3f()

    def traverse(self, callback):
        """Nothing is differentiated."""

    def to_string(self):
        """For messages."""
        return "PositionEmitter[]"


class SurfaceEmitter(mi.Emitter):
    """An emissive mesh with a texture, an alpha mask, or light from both sides. Triangles are sampled by area.

    `tables` is set later: the tables need the mesh's id, and the mesh its emitter.
    """

    def __init__(self, shape: Shape):
        super().__init__(mi.Properties())
        self.tables: Tables | None = None
        self.slots = frozenset(shape.material.textures) & {"emissive", "base_color"}
        self.masked = shape.material.alpha_mode == "mask"
        if self.masked and shape.mesh.colors is not None:
            self.slots = self.slots | {"color"}
        self.index = mi.UInt32(0)
        corners = shape.world.positions.astype(np.float64)[shape.world.triangles]
        cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        areas = 0.5 * np.linalg.norm(cross, axis=1)
        self.count = _opaque(mi.UInt32, len(areas))
        total = areas.sum()
        self.inverse_area = _opaque(mi.Float, 1 / total if total > 0 else 0.0)
        below = np.concatenate([[0.0], np.cumsum(areas) / (total if total > 0 else 1)])
        self.below = mi.Float(below.astype(np.float32))
        dr.make_opaque(self.below)
        self.steps = max(1, math.ceil(math.log2(len(areas) + 1)))
        self.m_flags = mi.EmitterFlags.Surface | mi.EmitterFlags.SpatiallyVarying
        self.m_needs_sample_3 = False

    def bind(self, tables: Tables, index: int) -> None:
        """Tells it the tables and which shape it is."""
        self.tables = tables
        self.index = _opaque(mi.UInt32, index)

    def _radiance(self, point: surface.SurfacePoint, cos_out, active):
        """Radiance leaving at `cos_out` over the front (below 0: the back), 0 in a mask's holes."""
        shines = active & ((cos_out > 0) | (point.double_sided & (cos_out < 0)))
        if self.masked:
            shines &= point.present
        return dr.select(shines, point.emission, 0)

    def _choose(self, u):
        """A triangle by area: its index, and what remains of u, uniform again."""
        low, high = mi.UInt32(0), mi.UInt32(self.count)
        for _ in range(self.steps):
            middle = (low + high) >> 1
            above = dr.gather(mi.Float, self.below, middle) <= u
            low, high = dr.select(above, middle, low), dr.select(above, high, middle)
        low = dr.minimum(low, self.count - 1)
        start, end = dr.gather(mi.Float, self.below, low), dr.gather(mi.Float, self.below, low + 1)
        return low, dr.clip((u - start) / dr.maximum(end - start, 1e-30), 0, 1)

    def sample_direction(self, it, sample, active=True):
        """A point on the mesh, uniform by area; density in solid angle."""
        triangle, u = self._choose(sample.x)
        root = dr.sqrt(u)
        b1, b2 = root * (1 - sample.y), root * sample.y
        point = surface.SurfacePoint(self.tables, self.index, triangle, b1, b2, self.slots, active)
        ds = dr.zeros(mi.DirectionSample3f, dr.width(it.p))
        ds.p, ds.n = point.position, mi.Normal3f(dr.normalize(point.face_cross))
        ds.uv, ds.time, ds.delta = mi.Point2f(b1, b2), it.time, False
        ds.emitter = mi.EmitterPtr(self)
        offset = ds.p - it.p
        square = dr.squared_norm(offset)
        ds.dist = dr.sqrt(square)
        ds.d = offset / ds.dist
        ds.pdf = self._density(ds, point.double_sided)
        active &= ds.pdf > 0
        value = self._radiance(point, -dr.dot(ds.d, ds.n), active)
        return ds, dr.select(active, value / ds.pdf, 0)

    def _density(self, ds, double_sided):
        cos_out = -dr.dot(ds.d, ds.n)
        cos_out = dr.select(double_sided, dr.abs(cos_out), cos_out)
        seen = (cos_out > 0) & (ds.dist > 0)
        return dr.select(seen, self.inverse_area * dr.square(ds.dist) / dr.maximum(cos_out, 1e-20), 0)

    def pdf_direction(self, it, ds, active=True):
        """Density of `sample_direction`, 1/sr."""
        point = surface.SurfacePoint(
            self.tables, self.index, mi.UInt32(0), mi.Float(0), mi.Float(0), self.slots, active
        )
        return dr.select(active, self._density(ds, point.double_sided), 0)

    def eval_direction(self, it, ds, active=True):
        """Not needed by path tracers."""
        raise NotImplementedError

    def eval(self, si, active=True):
        """Radiance leaving the surface towards the viewer."""
        point = surface.at_hit(self.tables, si, self.slots, active)
        return self._radiance(point, mi.Frame3f.cos_theta(si.wi), active)

    def traverse(self, callback):
        """Nothing is differentiated."""

    def to_string(self):
        """For messages."""
        return "SurfaceEmitter[]"
