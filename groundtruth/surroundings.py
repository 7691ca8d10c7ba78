"""Light reflected from the environment at the G-buffer's points: unoccluded (B) and as transported (A)."""

from collections.abc import Sequence

import numpy as np

from lightmeter.groundtruth import rays
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.vertex import Vertices
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

_STREAM = 0xE2


def reflected(world: World, points: SurfacePoints, spp: int, seed: Sequence[int], occluded: bool) -> np.ndarray:
    """B, or with `occluded` A and B, from the same directions, drawn from the material.

    Returns:
        (*lead, 3) float32, or (2, *lead, 3): A, B. Zeros where the scene has no environment.
    """
    channels = 6 if occluded else 3
    environment = world.scene.environment
    if environment is None:
        image = np.zeros((*points.shape.shape, channels), np.float32)
    else:
        radiance = mi.Color3f(*map(float, environment.radiance))
        dr.make_opaque(radiance)

        def estimate(vertex, lanes):
            direction, weight, density = vertex.sample(lanes.pattern)
            unoccluded = weight * radiance
            if not occluded:
                return list(unoccluded)
            ray = vertex.interaction.spawn_ray(direction)
            open_sky = rays.clear(world, ray, (density > 0) & vertex.carries(direction))
            return [*dr.select(open_sky, unoccluded, 0), *unoccluded]

        image = Vertices(world, points).average(spp, (*seed, _STREAM), estimate, channels, dimensions=3)
    if world.scene.max_depth == 1 and occluded:
        image[..., :3] = 0
    return np.ascontiguousarray(np.moveaxis(image.reshape(*image.shape[:-1], 2, 3), -2, 0)) if occluded else image
