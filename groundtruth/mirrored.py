"""What a perfect mirror at the G-buffer's points would show: the first surface along each point's mirrored view."""

import numpy as np

from lightmeter.groundtruth import rays
from lightmeter.groundtruth.to_numpy import rows
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.vertex import Vertices
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints


def mirrored_hits(world: World, points: SurfacePoints) -> np.ndarray:
    """(2, *lead, 3) float32: positions, and unit normals of the sides that are met; 0 where the ray meets nothing."""
    vertices = Vertices(world, points)
    if vertices.count == 0:
        return np.zeros((2, *vertices.lead, 3), np.float32)
    vertex = vertices.at(dr.arange(mi.UInt32, vertices.count))
    direction = 2 * dr.dot(vertex.normal, vertex.view) * vertex.normal - vertex.view
    hit = rays.first_hit(world, vertex.interaction.spawn_ray(direction), vertex.carries(direction))
    met = hit.is_valid()
    side = dr.select(dr.dot(hit.n, direction) > 0, -hit.n, hit.n)
    places, normals = (rows(mi.Vector3f(dr.select(met, part, 0))) for part in (hit.p, side))
    places = np.where(met.numpy(), world.frame.leave(places.T).T, 0)
    return np.stack([vertices.image(part) for part in (places, normals)])
