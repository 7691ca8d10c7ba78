"""Float64 twin of planar_mirror.glsl."""

import numpy as np

from ...shared_twins import towards
from ...twin import Argument, Twin, uniform


def lies_on(plane: np.ndarray, point: np.ndarray, normal: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Whether a point with its normal lies on a plane's front."""
    height = np.sum(plane[:3] * point, axis=0) + plane[3]
    return ((np.abs(height) <= near) & (np.sum(plane[:3] * normal, axis=0) > 0.999)).astype(np.float64)


def _signs(plane, point, normal, near):
    products = plane[:3] * point
    height = products.sum(axis=0) + plane[3]
    magnitude = np.abs(products).sum(axis=0) + np.abs(plane[3]) + near[0]
    alike = plane[:3] * normal
    return [
        (np.abs(height) - near[0], magnitude),
        (alike.sum(axis=0) - 0.999, np.abs(alike).sum(axis=0) + 0.999),
    ]


def _near_the_plane(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Normals of the plane or about so, and points on it or a little beside."""
    _plane, point, normal, near = inputs
    front = normal / np.linalg.norm(normal, axis=0)
    tilted = front + rng.normal(size=front.shape) * rng.choice([0.0, 0.02, 0.3], front.shape[1])
    height = rng.choice([0.0, 0.5, 0.9, 1.1, 3.0], front.shape[1]) * near
    offset = height - np.sum(front * point, axis=0)
    return [np.concatenate([front, offset[None]]), point, tilted / np.linalg.norm(tilted, axis=0), near]


TWINS = (
    Twin(
        "planar_mirror.glsl",
        "lies_on",
        "bool",
        (
            Argument("plane", "vec4", uniform(-1, 1, 4)),
            Argument("point", "vec3", uniform(-3, 3, 3)),
            towards("normal"),
            Argument("near", "float", uniform(0.01, 0.2)),
        ),
        lies_on,
        roundings=0,
        why="yes or no",
        arrange=_near_the_plane,
        signs=_signs,
        defines={"MIRRORS": 1},
    ),
)
