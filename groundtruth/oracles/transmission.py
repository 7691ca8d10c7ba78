"""`transmission`: what the surface of a dielectric solid shows, mirrored and refracted.

From the G-buffer's point, with its normal and index of refraction: mirrored or refracted by chance, and Mitsuba's path
tracer says what comes from there, whatever it is: the environment, emission, light scattered by surfaces, through
however many reflections inside. Both lobes are one term, since they share out the light between them; such a surface
has no other, so that everywhere else this is 0. A path through a solid meets no point, spot or directional light: their
caustics are in neither this nor the reference, and to them a solid is opaque.
"""

import numpy as np

from lightmeter.groundtruth.glass import choose
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.vertex import Vertex, Vertices
from lightmeter.groundtruth.wavefront import Lanes
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

TERM = "transmission"

_STREAM = 0x76


def evaluate(world: World, points: SurfacePoints, *, spp: int = 16, seed: int = 0, batch: int = 0) -> np.ndarray:
    """(H, W, 3) float32, W/(sr·m²); 0 where no solid is seen from outside."""
    depth = world.scene.max_depth
    seen = np.zeros(points.shape.shape, bool) if points.ior is None else points.hit & (points.ior > 0)
    if not seen.any() or depth == 1:
        return np.zeros((*points.shape.shape, 3), np.float32)
    rest = points.at(seen)
    integrator = world.integrator(depth - 1 if depth > 0 else -1)
    vertices = Vertices(world, rest)
    index = mi.Float(np.ascontiguousarray(rest.ior, np.float32))

    def estimate(vertex: Vertex, lanes: Lanes):
        eta = dr.gather(mi.Float, index, lanes.place)
        outside = dr.dot(vertex.face, vertex.view) > 0
        direction, mirrors, _ = choose(vertex.normal, vertex.face, vertex.view, eta, lanes.pattern.next())
        ray = vertex.interaction.spawn_ray(direction)
        radiance = integrator.sample(world.mitsuba, lanes.sampler, mi.RayDifferential3f(ray), active=outside)[0]
        return list(dr.select(outside, radiance * dr.select(mirrors, 1.0, dr.rcp(dr.square(eta))), 0))

    image = np.zeros((*points.shape.shape, 3), np.float32)
    image[seen] = vertices.average(spp, (seed, batch, _STREAM), estimate, channels=3, dimensions=1)
    return image
