"""Classical ambient occlusion: the cosine-weighted share of directions in which nothing is within a radius.

What most real-time techniques set out to compute (Zhukov, Iones & Kronin 1998, "An Ambient Light Illumination Model").
It is not the term `environment_visibility`, which is occluded over unoccluded *reflected* radiance: that one knows the
material, how the environment's light is spread, and no radius. Beside it, this tells a technique's aim from its means.
"""

import math

import numpy as np

from lightmeter.groundtruth import rays
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.vertex import Vertex, Vertices
from lightmeter.groundtruth.wavefront import Lanes
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

_STREAM = 0xA0


def ambient_occlusion(
    world: World,
    points: SurfacePoints,
    radius: float = math.inf,
    *,
    spp: int = 16,
    seed: int = 0,
    batch: int = 0,
) -> np.ndarray:
    """One batch of the visible share at points.

    Args:
        radius: how far rays reach, metres; infinite: to the end of the scene.
        spp: directions for each point, drawn by the cosine to the shading normal.
        seed, batch: name the random numbers.

    Returns:
        (H, W) float32, 0…1; 1 where nothing is seen.

    Raises:
        ValueError: a radius that is not positive.
    """
    if not radius > 0:
        raise ValueError(f"the radius of ambient occlusion must be above 0, got {radius}")
    vertices = Vertices(world, points)
    reach = mi.Float(min(float(radius) * world.frame.scale, 1e30))
    dr.make_opaque(reach)

    def estimate(vertex: Vertex, lanes: Lanes):
        towards = mi.warp.square_to_cosine_hemisphere(lanes.pattern.next_2d())
        direction = mi.Frame3f(vertex.normal).to_world(towards)
        ray = vertex.interaction.spawn_ray(direction)
        ray.maxt = reach
        return [dr.select(rays.clear(world, ray, vertex.carries(direction)), 1.0, 0.0)]

    share = vertices.average(spp, (seed, batch, _STREAM), estimate, channels=1, dimensions=2)[..., 0]
    return np.where(points.shape >= 0, share, np.float32(1))
