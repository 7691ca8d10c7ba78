"""Whether a scene lies too far from the origin, or is too small, for the float32 arithmetic of the path tracer.

A ray starts off its surface by a distance that grows with the coordinates, lest it hit the surface that it leaves:
Mitsuba's `SurfaceInteraction.offset_p` takes (1 + max |p|) · 1500 ε, ε = 2⁻²⁴: 0.1 mm at the origin, 9 cm at a
kilometre, 9 m at a hundred. What is nearer than that casts no shadow, light leaks through thin walls, and vertices
are rounded besides (6 cm at 10⁶ m). All of that goes away in the same scene with the camera at the origin. So the two
are path traced with the same random numbers, and what sets them apart is the float32 error of the scene's place.

The 1 in that distance is a metre: 0.1 mm it is for a scene of a millimetre too. So the scene at the origin that is the
measure is enlarged as well, by a power of two, which rounds nothing.
"""

import math
from dataclasses import dataclass

import numpy as np

from lightmeter.metrics.bias import bias
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.mse import rmse
from lightmeter.scenes.model import Scene
from lightmeter.scenes.moving import moved, scaled

TOLERANCE = 0.01
"""Of the mean radiance, as RMS error: a truth that is wrong by more settles no limit of a few per cent."""

FAR = 16.0
"""1 m and the reach from the origin may together be this many times the reach from the camera, unchecked: what centring
and enlarging wins is at most 4 of float32's 24 bits then."""

SIDE = 32
"""Pixels of the longer side of the image that is checked."""
SPP, BATCHES = 16, 8


@dataclass(frozen=True)
class OffsetCheck:
    """What a scene's place does to its reference.

    Attributes:
        difference: RMS difference between the scene as it is placed and the same with its camera at the origin, over
            their mean radiance; NaN where the placed one is not finite.
        low: what of it is not noise: the lower end of its 95 % interval, or of the mean difference's, which fireflies
            hide less.
        reach: metres, the largest coordinate of the scene and its camera.
    """

    difference: float
    low: float
    reach: float

    @property
    def holds(self) -> bool:
        """Whether the difference may be below the tolerance."""
        return self.low <= TOLERANCE

    @property
    def words(self) -> str:
        """One sentence with the remedy, for a check that does not hold."""
        differs = f"it differ by {100 * self.difference:.3g} % of the mean from the same scene"
        if self.reach < 1.0:
            return (
                f"the reference is not to be trusted: in a scene of {self.reach:.3g} m the 0.1 mm by which rays "
                f"start off surfaces make {differs} enlarged; scale the scene up"
            )
        return (
            f"the reference is not to be trusted: {self.reach:.3g} m from the origin float32 makes {differs} at the "
            "origin; move the scene nearer to it"
        )


def is_far(scene: Scene) -> bool:
    """Whether the scene is so far from the origin, or so small, that the check has something to find."""
    extent = _extent(scene)
    return bool(extent > 0 and 1.0 + np.abs(np.stack(scene.bounds)).max() > FAR * extent)


def _extent(scene: Scene) -> float:
    """Metres from the camera to the farthest corner, along an axis."""
    return float(np.abs(np.stack(scene.bounds) - scene.camera.position).max())


def check_offset(scene: Scene, size: tuple[int, int] = (SIDE, SIDE), seed: int = 0) -> OffsetCheck:
    """Path traces a small image of the scene where it is, and of the scene around the origin.

    Args:
        size: (width, height) of the image that is meant; its proportions alone matter.

    Raises:
        InputError: around the origin the scene has no finite pixel.
        NoRendererError: Mitsuba cannot run here.
    """
    from lightmeter.groundtruth.reference import render_batch
    from lightmeter.groundtruth.world import World

    shrink = SIDE / max(size)
    small = max(1, round(size[0] * shrink)), max(1, round(size[1] * shrink))

    def images(of: Scene) -> np.ndarray:
        world = World.of(of)
        return np.stack([render_batch(world, small, SPP, seed, batch) for batch in range(BATCHES)])

    larger = 2.0 ** max(0, math.ceil(-math.log2(_extent(scene) / FAR)))
    placed, centred = images(scene), images(scaled(moved(scene, -scene.camera.position), larger))
    finite = np.isfinite(centred).all(axis=(0, 3))
    reach = float(np.abs(np.stack([*scene.bounds, scene.camera.position])).max())
    comparison = Comparison(placed, centred, finite)
    found, shift = rmse(comparison), bias(comparison)
    mean = float(np.mean([placed[:, finite], centred[:, finite]], dtype=np.float64))
    if found.low is None or shift.low is None or shift.high is None:
        return OffsetCheck(math.nan, math.inf, reach)
    if not mean > 0:  # both are black
        return OffsetCheck(0.0, 0.0, reach)
    return OffsetCheck(found.value / mean, max(found.low, shift.low, -shift.high) / mean, reach)
