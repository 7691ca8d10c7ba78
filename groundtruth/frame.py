"""The frame that a scene is path traced in: the world's own, or one whose origin and size suit float32.

A ray starts off its surface, lest it hit the surface that it leaves, by (1 + max |p|) · 1500 ε with ε = 2⁻²⁴ (Mitsuba's
`SurfaceInteraction.offset_p`): 0.1 mm at the origin, 9 cm at a kilometre. What is nearer than that casts no shadow, and
vertices are rounded besides. The 1 is a metre, whatever the scene's size: to a scene of a millimetre 0.1 mm is much,
and too little on a triangle of kilometres, whose points are known to ε of its corners' coordinates. Let u be the length
that the 1 stands for, o the point of the scene's bounding box nearest to its camera, and the extent be from there, all
by the largest coordinate. There are two needs:

- the offset must be small beside what is seen large, which is what is near: u + |o| at most 16 m and 4 extents;
- it must be larger than the error of a point on its triangle: (u + d) · 1500 ε ≥ 4 ε · Σ |nᵢ| Lᵢ, with the triangle's
  unit normal n, its largest coordinates L, and d how near it comes to the origin. Three products and two sums round a
  point by 3 ε of L an axis at most (Higham 2002, section 3.1), of which Σ |nᵢ| goes across the triangle; the ray's own
  test rounds likewise.

A scene that meets both as it is placed is traced as it is placed. Any other is moved so that o is the origin, and
scaled by a power of two, which rounds nothing: u is 1 m, or less so that it is at most 1/16 of the extent, or more
where a triangle needs it. Vertices, camera and lights are moved in double precision, before any of them is rounded.
Light is as it was: intensities (W/sr) grow with the square of lengths, irradiances and radiances stay.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lightmeter.scenes.model import Scene
from lightmeter.scenes.moving import moved, scaled

SHARE = 16.0
"""In a frame of its own a scene's extent is at least so many times u."""

PLACED, NEAR = 4.0, 16.0
"""The most of u + |o| in a scene that is traced as it is placed: in extents, and in metres. At 16 m rays start 1.4 mm
off their surface."""

FINENESS = 1500.0 / 4.0
"""Triangles may have Σ |nᵢ| Lᵢ of so many times u + d."""

MOST = 2.0**40
"""Neither enlarged nor shrunk by more: light goes with the square, and float32 ends at 2¹²⁸."""


@dataclass(frozen=True, eq=False)
class Frame:
    """Where the truth has its origin, and how long its metre is.

    Attributes:
        origin: (3,) float64, world space, metres.
        scale: lengths here over lengths in the world, a power of two.
    """

    origin: np.ndarray
    scale: float = 1.0

    @classmethod
    def of(cls, scene: Scene) -> "Frame":
        """The world's frame where that does, else one that suits the scene."""
        if _suits(scene):
            return WORLD
        viewer = scene.camera.position
        near = moved(scene, -viewer)  # in double precision: far away float32 holds no bounds
        corners = np.stack(near.bounds)
        origin = np.clip(0.0, *corners)
        extent = float(np.abs(corners - origin).max())
        if not extent > 0:
            return WORLD
        unit = 2.0 ** math.floor(math.log2(min(1.0, extent / SHARE)))
        if (least := _least_unit(near, origin, extent)) > unit:
            unit = 2.0 ** math.ceil(math.log2(least))
        return cls(viewer + origin, 1.0 / min(max(unit, 1.0 / MOST), MOST))

    @property
    def is_world(self) -> bool:
        """Whether nothing is changed by it."""
        return self.scale == 1.0 and not self.origin.any()

    def scene(self, scene: Scene) -> Scene:
        """A scene as it is here: the very same where nothing is changed."""
        return scene if self.is_world else scaled(moved(scene, -self.origin), self.scale)

    def enter(self, positions: np.ndarray) -> np.ndarray:
        """Positions of the world as they are here: (…, 3) float32."""
        if self.is_world:
            return np.asarray(positions, np.float32)
        return ((np.asarray(positions, np.float64) - self.origin) * self.scale).astype(np.float32)

    def leave(self, positions: np.ndarray) -> np.ndarray:
        """Positions of this frame in the world: (…, 3) float32, which far from the world's origin holds less."""
        if self.is_world:
            return np.asarray(positions, np.float32)
        return (np.asarray(positions, np.float64) / self.scale + self.origin).astype(np.float32)

    def about(self, point: np.ndarray) -> "Frame":
        """The frame with its origin at one of its points: (3,), in this frame's lengths."""
        return Frame(self.origin + point / self.scale, self.scale)


WORLD = Frame(np.zeros(3))
"""The frame of the scene's own description."""


def _suits(scene: Scene) -> bool:
    """Whether both needs are met as the scene is placed."""
    corners = np.stack(scene.bounds)
    nearest = np.clip(scene.camera.position, *corners)
    extent = float(np.abs(corners - nearest).max())
    if 1.0 + np.abs(nearest).max() > min(NEAR, PLACED * extent):
        return False
    return _least_unit(scene, WORLD.origin, float(np.abs(corners).max())) <= 1.0


def _least_unit(scene: Scene, origin: np.ndarray, reach: float) -> float:
    """Metres: the least u with which no triangle shadows itself.

    Args:
        reach: the largest coordinate from the origin; where that is small, no triangle need be looked at.
    """
    bound = math.sqrt(3.0) * reach / FINENESS  # Σ |nᵢ| Lᵢ ≤ √3 max L
    return bound if bound <= 1.0 else max(_units(scene, origin), default=0.0)


def _units(scene: Scene, origin: np.ndarray) -> Iterator[float]:
    """The least u of each shape."""
    for shape in scene.shapes:
        if len(shape.world.triangles):
            corners = shape.world.positions.astype(np.float64)[shape.world.triangles] - origin
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            length = np.linalg.norm(normals, axis=1, keepdims=True)
            across = np.abs(normals) / np.where(length > 0, length, np.inf)
            error = (across * np.abs(corners).max(axis=1)).sum(axis=1)
            low, high = corners.min(axis=1), corners.max(axis=1)
            distance = np.maximum(np.maximum(low, -high), 0).max(axis=1)
            yield float((error / FINENESS - distance).max())
