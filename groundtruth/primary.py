"""Surface points by ray casting: what an exact G-buffer would hold, without a rasteriser."""

import numpy as np

from lightmeter.groundtruth import rays, surface
from lightmeter.groundtruth.camera import PrimaryRays
from lightmeter.groundtruth.oracles import material
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints


def surface_points(world: World, size: tuple[int, int], offsets: np.ndarray | None = None) -> SurfacePoints:
    """What the camera sees, one point per pixel, with exact parameters.

    Args:
        size: (width, height).
        offsets: (H, W, 2) or (2,): where in each pixel, x to the right and y down, 0…1; the centre if None.
    """
    width, height = size
    if offsets is None:
        offsets = np.array([0.5, 0.5])
    spread = np.broadcast_to(offsets, (height, width, 2)).astype(np.float32).reshape(-1, 2)
    ray = PrimaryRays(world.scene.camera, size).through(
        dr.arange(mi.UInt32, width * height), mi.Float(spread[:, 0].copy()), mi.Float(spread[:, 1].copy())
    )
    hit = rays.first_hit(world, ray, mi.Bool(True))
    seen = hit.is_valid()
    shape = dr.select(seen, mi.Int32(surface.shape_index(world.tables, hit.shape, seen)), -1)
    triangle = dr.select(seen, mi.Int32(hit.prim_index), -1)
    view = -ray.d
    dr.eval(hit.p, view, shape, triangle)
    zero, black = np.zeros((height, width), np.float32), np.zeros((height, width, 3), np.float32)
    bare = SurfacePoints(
        position=hit.p.numpy().T.reshape(height, width, 3),
        normal=black,
        view=np.broadcast_to(view.numpy().T, (height * width, 3)).reshape(height, width, 3),
        base_color=black,
        metallic=zero,
        roughness=zero,
        specular=zero,
        occlusion=zero,
        emission=black,
        shape=shape.numpy().reshape(height, width),
        triangle=triangle.numpy().reshape(height, width),
    )
    return material.evaluate(world, bare)
