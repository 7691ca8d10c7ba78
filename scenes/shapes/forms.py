"""Shapes by their equation: what a mesh of them only approaches.

A form gives its mesh at any number of steps, vertices on the true shape with the true normals, and the true surface
next to a point. All are around the local origin, as the shape of the same name is.
"""

from dataclasses import dataclass

import numpy as np

from lightmeter.scenes.model import Mesh
from lightmeter.scenes.shapes.cylinder import cylinder
from lightmeter.scenes.shapes.limits import AROUND
from lightmeter.scenes.shapes.sphere import sphere
from lightmeter.scenes.shapes.torus import torus

FEWEST_STEPS = AROUND[0]

Nearest = tuple[np.ndarray, np.ndarray]
"""Points on the true surface and the outward unit normals there, (N, 3) float64 each."""


@dataclass(frozen=True)
class Sphere:
    """`radius` in metres."""

    radius: float

    def mesh(self, steps: int) -> Mesh:
        """`steps` around the axis, half of them from pole to pole."""
        return sphere(self.radius, steps, max(2, steps // 2))

    def nearest(self, points: np.ndarray) -> Nearest:
        """The true surface next to (N, 3) points, the centre excluded."""
        normals = _unit(points)
        return self.radius * normals, normals


@dataclass(frozen=True)
class Torus:
    """`major` from the axis to the middle of the tube, `minor` the tube's radius, metres."""

    major: float
    minor: float

    def mesh(self, steps: int) -> Mesh:
        """`steps` around the axis, half of them around the tube."""
        return torus(self.major, self.minor, steps, max(FEWEST_STEPS, steps // 2))

    def nearest(self, points: np.ndarray) -> Nearest:
        """The true surface next to (N, 3) points, the axis and the middle of the tube excluded."""
        middle = self.major * _unit(points * (1, 0, 1))
        normals = _unit(points - middle)
        return middle + self.minor * normals, normals


@dataclass(frozen=True)
class Cylinder:
    """`radius` and `height` in metres; `caps`: whether it is closed at both ends."""

    radius: float
    height: float
    caps: bool = True

    def mesh(self, steps: int) -> Mesh:
        """`steps` around the axis; along it one is exact."""
        return cylinder(self.radius, self.height, steps, 1, self.caps)

    def nearest(self, points: np.ndarray) -> Nearest:
        """The true wall, or the true cap where that is nearer, next to (N, 3) points, the axis excluded."""
        around = _unit(points * (1, 0, 1))
        up = np.array([0.0, 1.0, 0.0])
        wall = self.radius * around + points * up
        if not self.caps:
            return wall, around
        side = np.where(points[:, 1:2] < 0, -1.0, 1.0) * up
        cap = points * (1, 0, 1) + 0.5 * self.height * side
        on_cap = np.linalg.norm(points - cap, axis=1) < np.linalg.norm(points - wall, axis=1)
        return np.where(on_cap[:, None], cap, wall), np.where(on_cap[:, None], side, around)


def _unit(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors; a zero vector stays zero."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)
