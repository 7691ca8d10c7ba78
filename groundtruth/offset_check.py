"""What float32 still does to the truth of a scene that is far from the origin, small, or large.

Such a scene is path traced in a frame of its own (see `frame`), where the error of float32 is that of any scene at the
origin. It remains where what the camera sees is far from that frame's origin too: rays start off their surface by
(u + |p|) · 1500 ε. So the scene is path traced once more, with the same random numbers, in a frame whose origin is
3 (u + |p|) away, |p| of the middle one of the points that are seen: there the offset is 4 times as large, and the roundings
with it. Errors so small that they are linear differ by 3 times the error itself.
"""

import math
from dataclasses import dataclass

import numpy as np

from lightmeter.groundtruth.frame import Frame
from lightmeter.metrics.bias import bias
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.mse import rmse
from lightmeter.scenes.model import Scene

TOLERANCE = 0.01
"""Of the mean radiance, as RMS error: a truth that is wrong by more settles no limit of a few per cent."""

COARSER = 4.0
"""How many times as large the error is in the other frame."""

SIDE = 32
"""Pixels of the longer side of the image that is checked."""
SPP, BATCHES = 16, 8


@dataclass(frozen=True)
class OffsetCheck:
    """What float32 does to the reference of a scene.

    Attributes:
        difference: RMS error of the truth by what a coarser frame makes of it, over the mean radiance; NaN where the
            truth is not finite.
        low: what of it is not noise: the lower end of its 95 % interval, or of the mean difference's, which fireflies
            hide less.
        reach: metres, the largest coordinate of the scene and its camera.
    """

    difference: float
    low: float
    reach: float

    @property
    def holds(self) -> bool:
        """Whether the error may be below the tolerance."""
        return self.low <= TOLERANCE

    @property
    def words(self) -> str:
        """One sentence with the remedy, for a check that does not hold."""
        return (
            f"the reference is not to be trusted: in a scene that reaches {self.reach:.3g} m from the origin, float32 makes "
            f"it wrong by about {100 * self.difference:.3g} % of the mean; put what is seen and the camera nearer together, "
            "or leave out what is far away"
        )


def is_far(scene: Scene) -> bool:
    """Whether the scene is so far from the origin, so small or so large, that the check has something to find."""
    return not Frame.of(scene).is_world


def check_offset(scene: Scene, size: tuple[int, int] = (SIDE, SIDE), seed: int = 0) -> OffsetCheck:
    """Path traces a small image of the scene in the truth's frame, and in one where float32 is four times as coarse.

    Args:
        size: (width, height) of the image that is meant; its proportions alone matter.

    Raises:
        InputError: in the coarser frame the scene has no finite pixel.
        NoRendererError: Mitsuba cannot run here.
    """
    from lightmeter.groundtruth.primary import seen_distance
    from lightmeter.groundtruth.reference import render_batch
    from lightmeter.groundtruth.world import World

    shrink = SIDE / max(size)
    small = max(1, round(size[0] * shrink)), max(1, round(size[1] * shrink))

    def images(world: World) -> np.ndarray:
        return np.stack([render_batch(world, small, SPP, seed, batch) for batch in range(BATCHES)])

    world = World.of(scene)
    away = (COARSER - 1) * (1.0 + seen_distance(world, small))
    found = images(world)
    coarse = images(World.of(scene, frame=world.frame.shifted(np.full(3, -away))))
    finite = np.isfinite(coarse).all(axis=(0, 3))
    reach = float(np.abs(np.stack([*scene.bounds, scene.camera.position])).max())
    comparison = Comparison(found, coarse, finite)
    square, shift = rmse(comparison), bias(comparison)
    mean = float(np.mean([found[:, finite], coarse[:, finite]], dtype=np.float64))
    if square.low is None or shift.low is None or shift.high is None:
        return OffsetCheck(math.nan, math.inf, reach)
    if not mean > 0:  # both are black
        return OffsetCheck(0.0, 0.0, reach)
    error = mean * (COARSER - 1)
    return OffsetCheck(square.value / error, max(square.low, shift.low, -shift.high) / error, reach)
