"""`visibility`: shadowed over unshadowed reflected radiance of one light, as numerator A and denominator B.

A is what the light really brings to the point: B's integrand where nothing is in the way (alpha masks let light
through their holes) and light and viewer are on the same side of the geometric face. Both from the same samples, so
that A ≤ B lane by lane and their ratio is steady. Where both `direct` and `visibility` are exact, A itself is used.
"""

import numpy as np

from lightmeter.groundtruth import lit
from lightmeter.groundtruth.world import World
from lightmeter.scenes.points import SurfacePoints

TERM = "visibility"


def evaluate(
    world: World, points: SurfacePoints, light: int, *, spp: int = 16, seed: int = 0, batch: int = 0
) -> np.ndarray:
    """A and B of one light.

    Args:
        light: index into `scene.all_lights`.
        spp: samples per point and strategy; punctual lights are exact with any number.

    Returns:
        (2, H, W, 3) float32: A, B in W/(sr·m²); 0 where nothing is seen.
    """
    return lit.reflected(world, points, light, spp, (seed, batch), shadowed=True)
