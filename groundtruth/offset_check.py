"""What float32 still does to the truth of a scene that is far from the origin, small, or large.

Such a scene is path traced in a frame of its own (see `frame`), where the error of float32 is that of any scene at the
origin. It remains where what the camera sees is far from that frame's origin too, or much smaller than its metre: rays
start off their surface by (u + |p|) · 1500 ε. So the scene is path traced twice more, with the same random numbers:

- about the middle of what is seen. Where the truth's frame is as good as that one, the two are the same;
- in a frame whose origin is 3 (u + |p|) away from there: the offset is 4 times as large as it is in the truth's frame,
  and the roundings with it. Errors so small that they are linear differ by 3 times the error itself.
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
        difference: RMS error of the truth by what other frames make of it, over the mean radiance; NaN where the
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
            f"the reference is not to be trusted: in a scene that reaches {self.reach:.3g} m from the origin, float32 "
            f"makes it wrong by about {100 * self.difference:.3g} % of the mean; put what is seen and the camera "
            "nearer together, or leave out what is far away"
        )


def is_far(scene: Scene) -> bool:
    """Whether the scene is so far from the origin, so small or so large, that the check has something to find."""
    return not Frame.of(scene).is_world


def check_offset(scene: Scene, size: tuple[int, int] = (SIDE, SIDE), seed: int = 0) -> OffsetCheck:
    """Path traces a small image of the scene in the truth's frame, about what is seen, and where float32 is coarser.

    Args:
        size: (width, height) of the image that is meant; its proportions alone matter.

    Raises:
        InputError: in another frame the scene has no finite pixel.
        NoRendererError: Mitsuba cannot run here.
    """
    from lightmeter.groundtruth.primary import seen_places
    from lightmeter.groundtruth.reference import render_batch
    from lightmeter.groundtruth.world import World

    shrink = SIDE / max(size)
    small = max(1, round(size[0] * shrink)), max(1, round(size[1] * shrink))

    def images(world: World) -> np.ndarray:
        return np.stack([render_batch(world, small, SPP, seed, batch) for batch in range(BATCHES)])

    world = World.of(scene)
    found, places = images(world), seen_places(world, small)
    middle = np.median(places, axis=0).astype(np.float64) if len(places) else np.zeros(3)
    away = (COARSER - 1) * (1.0 + np.abs(middle).max())
    better, coarser = (images(World.of(scene, frame=world.frame.about(p))) for p in (middle, middle - away))
    reach = float(np.abs(np.stack([*scene.bounds, scene.camera.position])).max())
    return max(
        (_compared(found, better, 1.0, reach), _compared(found, coarser, COARSER - 1, reach)), key=lambda c: c.low
    )


def _compared(found: np.ndarray, other: np.ndarray, times: float, reach: float) -> OffsetCheck:
    """What two sets of batches say of the error; they differ by so many times the error."""
    finite = np.isfinite(other).all(axis=(0, 3))
    comparison = Comparison(found, other, finite)
    square, shift = rmse(comparison), bias(comparison)
    mean = float(np.mean([found[:, finite], other[:, finite]], dtype=np.float64))
    if square.low is None or shift.low is None or shift.high is None:
        return OffsetCheck(math.nan, math.inf, reach)
    if not mean > 0:  # both are black
        return OffsetCheck(0.0, 0.0, reach)
    error = mean * times
    return OffsetCheck(square.value / error, max(square.low, shift.low, -shift.high) / error, reach)
