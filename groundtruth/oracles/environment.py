"""`environment`: unoccluded radiance reflected from the environment.

By the optics alone, as if the point were alone in the environment.
"""

import numpy as np

from lightmeter.groundtruth import surroundings
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

TERM = "environment"


def evaluate(world: World, points: SurfacePoints, *, spp: int = 16, seed: int = 0, batch: int = 0) -> np.ndarray:
    """B of the environment: (H, W, 3) float32, W/(sr·m²); 0 where nothing is seen or there is no environment."""
    return surroundings.reflected(world, points, spp, (seed, batch), occluded=False)
