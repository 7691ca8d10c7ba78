"""`environment_visibility`: occluded over unoccluded radiance from the environment, as numerator A and denominator B.

A counts the directions that leave the scene (through the holes of alpha masks too) on the viewer's side of the
geometric face. Both come from the same directions. Light that other surfaces scatter is not A's: it is `indirect`.
"""

import numpy as np

from lightmeter.groundtruth import surroundings
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

TERM = "environment_visibility"


def evaluate(world: World, points: SurfacePoints, *, spp: int = 16, seed: int = 0, batch: int = 0) -> np.ndarray:
    """A and B of the environment: (2, H, W, 3) float32, W/(sr·m²); 0 where nothing is seen."""
    return surroundings.reflected(world, points, spp, (seed, batch), occluded=True)
