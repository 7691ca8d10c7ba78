"""The reference: an independent path trace from the camera, as batches that can be averaged.

It knows nothing of a G-buffer: Mitsuba's own `path` (or `volpath` where a material has an alpha mask) with our BSDF, a
box filter over each pixel, Russian roulette from depth 5, path length `Scene.max_depth`.
"""

import numpy as np

from lightmeter.groundtruth.camera import PrimaryRays
from lightmeter.groundtruth.variant import mi
from lightmeter.groundtruth.wavefront import Lanes, average
from lightmeter.groundtruth.world import World

_STREAM = 0x5EF


def render_batch(world: World, size: tuple[int, int], spp: int, seed: int, batch: int = 0) -> np.ndarray:
    """One batch of the reference.

    Args:
        size: (width, height) in pixels.
        spp: samples per pixel.
        seed: base seed of the reference.
        batch: which batch; batches of one seed are independent of each other.

    Returns:
        (H, W, 3) float32, radiance in W/(sr·m²), row 0 at the top. Non-finite values are left as they are.
    """
    width, height = size
    rays = PrimaryRays(world.scene.camera, size)
    integrator = world.integrator(world.scene.max_depth)

    def estimate(lanes: Lanes):
        ray = rays.through(lanes.place, lanes.pattern.next(), lanes.pattern.next())
        return integrator.sample(world.mitsuba, lanes.sampler, mi.RayDifferential3f(ray))[0]

    image = average(width * height, spp, (seed, batch, _STREAM), estimate, channels=3, dimensions=2)
    return np.ascontiguousarray(image.T).reshape(height, width, 3)
