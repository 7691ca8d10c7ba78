"""`material`: unfiltered, unpacked parameters at the points.

Level-0 bilinear texture values in linear space, vertex colours, the interpolated normal with the normal map, and the
emission, all in float32 at the G-buffer's position on its triangle.
"""

from dataclasses import replace

import numpy as np

from lightmeter.groundtruth.surface import SurfacePoint
from lightmeter.groundtruth.to_numpy import rows
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.world import World
from lightmeter.scenes.layers import COAT, layer_channels
from lightmeter.scenes.points import SurfacePoints

TERM = "material"

SCALARS = ("metallic", "roughness", "specular", "occlusion")
VECTORS = ("normal", "base_color", "emission")


def evaluate(world: World, points: SurfacePoints, *, spp: int = 1, seed: int = 0, batch: int = 0) -> SurfacePoints:
    """The points with exact parameters; `spp` and `seed` play no part.

    Position, view, shape and triangle are kept, and what is seen where there is no surface.
    """
    lead = points.shape.shape
    flat = points.at(np.ones(lead, bool))
    where = np.flatnonzero(flat.shape >= 0)
    names = (*SCALARS, *VECTORS, *layer_channels(world.scene))
    exact = {name: np.zeros((*flat.shape.shape, *_extent(name)), np.float32) for name in names}
    exact["emission"][flat.shape < 0] = flat.emission[flat.shape < 0]
    if len(where):
        found = _read(world, flat, where) | _inside(world, flat.shape[where])
        for name in names:
            exact[name][where] = found[name]
    return replace(points, **{name: value.reshape(*lead, *_extent(name)) for name, value in exact.items()})


def _read(world: World, flat: SurfacePoints, where: np.ndarray) -> dict[str, np.ndarray]:
    # Gathered, since a kernel that loads NumPy's memory directly depends on how that memory happens to be aligned; and
    # both from one array, as Dr.Jit makes a load of a gather that takes one number after another.
    lane = dr.arange(mi.UInt32, len(where))
    faces = np.stack([flat.shape, flat.triangle], axis=-1)[where]
    shape, triangle = dr.gather(mi.Vector2u, mi.UInt32(faces.astype(np.uint32).ravel()), lane)
    position, view = (
        dr.gather(mi.Vector3f, mi.Float(a.astype(np.float32).ravel()), lane)
        for a in (world.frame.enter(flat.position[where]), flat.view[where])
    )
    corners = SurfacePoint(world.tables, shape, triangle, mi.Float(0), mi.Float(0), frozenset(), True)
    b1, b2 = _barycentric(corners, position)
    point = SurfacePoint(world.tables, shape, triangle, b1, b2, world.slots, True)
    behind = dr.dot(corners.face_cross, view) < 0
    normal = dr.select(behind & point.double_sided, -point.normal, point.normal)
    emission = dr.select(behind & ~point.double_sided, 0, point.emission)
    material, occlusion = point.material.turned(behind & point.double_sided), point.occlusion
    found = {
        "normal": normal,
        "base_color": material.base_color,
        "emission": emission,
        "metallic": material.metallic,
        "roughness": material.roughness,
        "specular": material.specular,
        "occlusion": occlusion,
    }
    layers = layer_channels(world.scene)
    if material.coat is not None:
        coat = dict(zip(COAT, (material.coat.factor, material.coat.roughness, material.coat.normal), strict=True))
        found |= {name: value for name, value in coat.items() if name in layers}
    if material.grain is not None:
        found |= {"anisotropy": material.grain.strength, "anisotropy_direction": material.grain.direction}
    if material.sheen is not None:
        found |= {"sheen_color": material.sheen.color, "sheen_roughness": material.sheen.roughness}
    dr.eval(list(found.values()))
    arrays = {name: rows(value).T if _extent(name) else value.numpy() for name, value in found.items()}
    return {name: np.broadcast_to(array, (len(where), *_extent(name))) for name, array in arrays.items()}


def _inside(world: World, shape: np.ndarray) -> dict[str, np.ndarray]:
    """Of dielectric solids: no texture changes them."""
    materials = [one.material for one in world.scene.shapes]
    index = np.array([material.ior for material in materials])
    absorption = np.array([material.absorption for material in materials]) * world.frame.scale
    return {"ior": index[shape], "absorption": absorption[shape]}


def _extent(name: str) -> tuple[int, ...]:
    return (3,) if name in (*VECTORS, "clearcoat_normal", "anisotropy_direction", "sheen_color", "absorption") else ()


def _barycentric(corners: SurfacePoint, position):
    """b1, b2 of positions on their triangles, in double precision: slivers lose what single has."""
    a, b, c = (mi.Vector3d(corners.corner(k)) for k in range(3))
    e1, e2, offset = b - a, c - a, mi.Vector3d(position) - a
    d11, d12, d22 = dr.dot(e1, e1), dr.dot(e1, e2), dr.dot(e2, e2)
    d1, d2 = dr.dot(offset, e1), dr.dot(offset, e2)
    determinant = d11 * d22 - d12 * d12
    inverse = dr.select(determinant > 0, 1 / dr.maximum(determinant, 1e-300), 0)
    return mi.Float((d22 * d1 - d12 * d2) * inverse), mi.Float((d11 * d2 - d12 * d1) * inverse)
