"""`indirect`: radiance that other surfaces scatter towards the point, and the point to the viewer.

A direction is drawn from the G-buffer's material, and Mitsuba's path tracer says what comes from there, minus what the
first surface emits by itself (that is `direct` of that light) and nothing where no surface is hit (that is
`environment`). With a limited path length, `Scene.max_depth` − 1 remains.
"""

import numpy as np

from lightmeter.groundtruth import rays
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.vertex import Vertex, Vertices
from lightmeter.groundtruth.wavefront import Lanes
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

TERM = "indirect"

_STREAM = 0x1D


def evaluate(world: World, points: SurfacePoints, *, spp: int = 16, seed: int = 0, batch: int = 0) -> np.ndarray:
    """(H, W, 3) float32, W/(sr·m²); 0 where nothing is seen."""
    depth = world.scene.max_depth
    if 0 <= depth <= 2:
        return np.zeros((*points.shape.shape, 3), np.float32)
    integrator = world.integrator(depth - 1 if depth > 0 else -1)
    # Without emissive surfaces and environment there is nothing to take away.
    pure = not world.scene.area_lights and world.scene.environment is None

    def estimate(vertex: Vertex, lanes: Lanes):
        direction, weight, density = vertex.sample(lanes.pattern)
        active = (density > 0) & vertex.carries(direction)
        ray = vertex.interaction.spawn_ray(direction)
        radiance = integrator.sample(world.mitsuba, lanes.sampler, mi.RayDifferential3f(ray), active=active)[0]
        if not pure:
            hit = rays.first_hit(world, ray, active)
            seen = active & hit.is_valid()
            emitted = hit.emitter(world.mitsuba, seen).eval(hit, seen)
            radiance = dr.select(seen, radiance - emitted, 0)
        return list(dr.select(active, weight * radiance, 0))

    return Vertices(world, points).average(spp, (seed, batch, _STREAM), estimate, channels=3, dimensions=3)
