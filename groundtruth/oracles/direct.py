"""`direct`: unshadowed radiance reflected from one light.

By the optics alone, as if nothing but the light and the point were there: no shadow, and no regard to the geometric
face. Closed form in double precision for point, spot and directional lights; for an emissive surface Monte Carlo over
its own triangles (which may shadow each other), sampling the light and the material, combined by the power heuristic.
"""

import numpy as np

from lightmeter.groundtruth import lit
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

TERM = "direct"


def evaluate(
    world: World, points: SurfacePoints, light: int, *, spp: int = 16, seed: int = 0, batch: int = 0
) -> np.ndarray:
    """B of one light.

    Args:
        light: index into `scene.all_lights`.
        spp: samples per point and strategy; punctual lights are exact with any number.

    Returns:
        (H, W, 3) float32, W/(sr·m²); 0 where nothing is seen.
    """
    return lit.reflected(world, points, light, spp, (seed, batch), shadowed=False)
