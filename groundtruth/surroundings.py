"""Light reflected from the environment at the G-buffer's points: unoccluded (B) and as transported (A)."""

from collections.abc import Sequence

import numpy as np

from lightmeter.groundtruth import rays
from lightmeter.groundtruth.heuristic import power_heuristic
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.vertex import Vertex, Vertices
from lightmeter.groundtruth.wavefront import Lanes
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

_STREAM = 0xE2


def reflected(world: World, points: SurfacePoints, spp: int, seed: Sequence[int], occluded: bool) -> np.ndarray:
    """B, or with `occluded` A and B, from the same directions.

    They are drawn from the material; of a map also from its light, the two weighted by the power heuristic.

    Returns:
        (*lead, 3) float32, or (2, *lead, 3): A, B. Zeros where the scene has no environment.
    """
    channels = 6 if occluded else 3
    environment = world.scene.environment
    if environment is None:
        image = np.zeros((*points.shape.shape, channels), np.float32)
    else:
        samples = (_towards_lobe_of_map, _towards_map) if environment.map else (_towards_lobe,)

        def estimate(vertex: Vertex, lanes: Lanes):
            total_a, total_b = mi.Color3f(0), mi.Color3f(0)
            for sample in samples:
                value, direction, active = sample(world, vertex, lanes)
                total_b += value
                if occluded:
                    ray = vertex.interaction.spawn_ray(direction)
                    open_sky = rays.clear(world, ray, active & vertex.carries(direction))
                    total_a += dr.select(open_sky, value, 0)
            return [*total_a, *total_b] if occluded else list(total_b)

        dimensions = 5 if environment.map else 3
        image = Vertices(world, points).average(spp, (*seed, _STREAM), estimate, channels, dimensions)
    if world.scene.max_depth == 1 and occluded:
        image[..., :3] = 0
    return np.ascontiguousarray(np.moveaxis(image.reshape(*image.shape[:-1], 2, 3), -2, 0)) if occluded else image


def _towards_lobe(world: World, vertex: Vertex, lanes: Lanes):
    """A direction from the material, which has no variance but the material's own for a constant environment."""
    radiance = mi.Color3f(*map(float, world.scene.environment.radiance))
    dr.make_opaque(radiance)
    direction, weight, density = vertex.sample(lanes.pattern)
    return weight * radiance, direction, density > 0


def _towards_lobe_of_map(world: World, vertex: Vertex, lanes: Lanes):
    """A direction from the material."""
    direction, weight, density = vertex.sample(lanes.pattern)
    active = density > 0
    share = power_heuristic(density, world.around.density(direction))
    return dr.select(active, weight * world.around.radiance(direction, active) * share, 0), direction, active


def _towards_map(world: World, vertex: Vertex, lanes: Lanes):
    """A direction from the map's light."""
    direction, density = world.around.sample(lanes.pattern.next(), lanes.pattern.next())
    value, lobe = vertex.evaluate(direction)
    active = (density > 0) & (dr.max(value) > 0)
    light = world.around.radiance(direction, active) / dr.maximum(density, 1e-30)
    return dr.select(active, value * light * power_heuristic(density, lobe), 0), direction, active
