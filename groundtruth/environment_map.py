"""A latitude-longitude map as a Mitsuba emitter, by the convention of `scenes/optics/environment.py`.

Mitsuba's own `envmap` has its texels on the map's edge rather than half a texel within, so that a sun of a few texels
would be another sun. Directions are drawn from patches between four texels' centres, where the radiance is bilinear:
each by its corners' mean luminance times its extent, evenly within.
"""

import math

import numpy as np

from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.model import Environment
from lightmeter.scenes.optics import environment as optics
from lightmeter.scenes.optics.color import LUMINANCE


class MapEmitter(mi.Emitter):
    """What surrounds the scene.

    Args:
        radius: of a ball about the origin that holds the scene and every point that light may be asked for at.
    """

    def __init__(self, environment: Environment, radius: float):
        super().__init__(mi.Properties())
        assert environment.map is not None, "Mitsuba's own constant emitter does for a constant one"
        texels = environment.map.texels.astype(np.float32)
        self.height, self.width = texels.shape[:2]
        self.grid = optics.grid(self.width, self.height, mi.Float, mi.UInt32)
        factor = np.array(environment.radiance, np.float32)
        self.texels = mi.Float(np.ascontiguousarray(texels * factor).ravel())
        rows, columns = _distribution(texels * factor)
        self.rows, self.columns = mi.Float(rows), mi.Float(columns.ravel())
        self.rotation, self.radius = mi.Float(environment.rotation), mi.Float(radius)
        dr.make_opaque(self.texels, self.rows, self.columns, self.rotation, self.radius)
        self.m_flags = mi.EmitterFlags.Infinite | mi.EmitterFlags.SpatiallyVarying
        self.m_needs_sample_3 = False

    def radiance(self, direction, active=True):
        """W/(sr·m²) from a direction."""
        total = mi.Color3f(0)
        u, v = optics.coordinates(direction, self.rotation)
        for column, row, weight in self.grid.taps(u, v):
            texel = mi.UInt32(row) * self.width + mi.UInt32(column)
            total += weight * dr.gather(mi.Color3f, self.texels, texel, active)
        return total

    def sample(self, u, v):
        """A direction and its density in solid angle, from two uniform numbers."""
        row, along_v, row_density = _choose(self.rows, 0, self.height + 1, v)
        column, along_u, column_density = _choose(self.columns, row * (self.width + 1), self.width, u)
        map_u = (mi.Float(column) + 0.5 + along_u) / self.width
        top, extent = self._row_place(row)
        map_v = top + along_v * extent
        direction = mi.Vector3f(*optics.direction_at(map_u, map_v, self.rotation))
        return direction, self._per_steradian(row_density, column_density, map_v, extent)

    def density(self, direction):
        """1/sr: of `sample` at a direction."""
        u, v = optics.coordinates(direction, self.rotation)
        x = u * self.width - 0.5
        column = mi.UInt32(dr.clip(x - self.width * dr.floor(x / self.width), 0, self.width - 1))
        row = mi.UInt32(dr.clip(dr.floor(v * self.height + 0.5), 0, self.height))
        start = row * (self.width + 1) + column
        row_density = dr.gather(mi.Float, self.rows, row + 1) - dr.gather(mi.Float, self.rows, row)
        column_density = dr.gather(mi.Float, self.columns, start + 1) - dr.gather(mi.Float, self.columns, start)
        return self._per_steradian(row_density, column_density, v, self._row_place(row)[1])

    def _row_place(self, row):
        """Where a row of patches starts and how high it is, of the map's height; the first and the last are half."""
        top = dr.maximum(mi.Float(row) - 0.5, 0) / self.height
        bottom = dr.minimum(mi.Float(row) + 0.5, self.height) / self.height
        return top, bottom - top

    def _per_steradian(self, row_density, column_density, v, extent):
        """From chances of a patch to a density: a map's du·dv is 2π²·sin(polar) of solid angle."""
        area = extent / self.width * (2 * math.pi**2) * dr.maximum(dr.sin(v * math.pi), 1e-9)
        return row_density * column_density / area

    def sample_direction(self, it, sample, active=True):
        """A direction by the map's light; the point is beyond the scene."""
        ds = dr.zeros(mi.DirectionSample3f, dr.width(it.p))
        ds.d, ds.pdf = self.sample(sample.x, sample.y)
        ds.dist = 2 * (self.radius + dr.norm(mi.Vector3f(it.p)))
        ds.p, ds.n, ds.delta, ds.time = it.p + ds.d * ds.dist, -ds.d, False, it.time
        ds.emitter = mi.EmitterPtr(self)
        weight = dr.select(ds.pdf > 0, self.radiance(ds.d, active) / ds.pdf, 0)
        return ds, dr.select(active, weight, 0)

    def pdf_direction(self, it, ds, active=True):
        """Density of `sample_direction`, 1/sr."""
        return dr.select(active, self.density(ds.d), 0)

    def eval_direction(self, it, ds, active=True):
        """Radiance from `ds.d`."""
        return dr.select(active, self.radiance(ds.d, active), 0)

    def eval(self, si, active=True):
        """Radiance that a ray sees which has left the scene."""
        return dr.select(active, self.radiance(-si.wi, active), 0)

    def bbox(self):
        """Empty: it does not make the scene larger."""
        return mi.ScalarBoundingBox3f()

    def traverse(self, callback):
        """Nothing is differentiated."""

    def to_string(self):
        """For messages."""
        return "MapEmitter[]"


def _distribution(texels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(H + 2,) chances below each row of patches, and (H + 1, W + 1) below each column within its row, float32.

    Patch (r, c) has its corners at the centres of texels in rows r − 1 and r, clamped, and columns c and c + 1, around
    the seam.
    """
    light = texels.astype(np.float64) @ np.array(LUMINANCE)
    above, below = np.vstack([light[:1], light]), np.vstack([light, light[-1:]])
    corners = above + below
    patches = corners + np.roll(corners, -1, axis=1)
    height = len(light)
    edges = np.clip(np.arange(height + 2) - 0.5, 0, height) / height
    solid = np.cos(np.pi * edges[:-1]) - np.cos(np.pi * edges[1:])
    # A dark row is drawn never; its columns are even, so that no chance is 0/0.
    sums = patches.sum(axis=1, keepdims=True)
    within = np.where(sums > 0, patches / np.where(sums > 0, sums, 1), 1 / patches.shape[1])
    columns = np.concatenate([np.zeros((height + 1, 1)), np.cumsum(within, axis=1)], axis=1)
    share = sums[:, 0] * solid
    total = share.sum()
    share = share / total if total > 0 else np.full(len(share), 1 / len(share))
    rows = np.concatenate([[0.0], np.cumsum(share)])
    rows[-1], columns[:, -1] = 1.0, 1.0
    return rows.astype(np.float32), columns.astype(np.float32)


def _choose(below, start, count: int, u):
    """The entry that u falls to among `count` from `start` on: its index, what remains of u, its chance."""
    low, high = mi.UInt32(0), mi.UInt32(count)
    for _ in range(max(1, math.ceil(math.log2(count + 1)))):
        middle = (low + high) >> 1
        beyond = dr.gather(mi.Float, below, start + middle) <= u
        low, high = dr.select(beyond, middle, low), dr.select(beyond, high, middle)
    low = dr.minimum(low, count - 1)
    first, last = dr.gather(mi.Float, below, start + low), dr.gather(mi.Float, below, start + low + 1)
    return low, dr.clip((u - first) / dr.maximum(last - first, 1e-30), 0, 1), last - first
