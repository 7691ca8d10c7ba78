"""Float64 twins of the shaders for dielectric solids."""

import numpy as np

from lightmeter.scenes.optics import dielectric

from ..shared_twins import cosine
from ..twin import Argument, Twin, direction, uniform

ETA = Argument("eta", "float", uniform(0.3, 3.0), (1.5, 1 / 1.5, 2.417))
N, V = Argument("normal", "vec3", direction), Argument("view", "vec3", direction)


def distance_to_plane(start: np.ndarray, towards: np.ndarray, plane: np.ndarray) -> np.ndarray:
    """How far it is along a ray to a plane that it leaves through."""
    return np.maximum(plane[3] - np.sum(plane[:3] * start, axis=0), 0.0) / np.maximum(
        np.sum(plane[:3] * towards, axis=0), 1e-4
    )


def critical(c: np.ndarray, eta: np.ndarray):
    """How far from the critical angle: beyond it all is mirrored, before it float32 may not know."""
    return [((1 - (1 - c * c) / (eta * eta))[0], (1 + (1 + c * c) / (eta * eta))[0])]


TWINS = (
    Twin(
        "dielectric.glsl",
        "cosine_beyond",
        "float",
        (cosine("cosine"), ETA),
        dielectric.cosine_beyond,
        signs=critical,
        cancels=1.0,
        roundings=2 + 1 + 2.5 + 1 + 3,
        why="both squares, a difference, the division (2.5), a difference, the root (3)",
    ),
    Twin(
        "dielectric.glsl",
        "dielectric_reflectance",
        "float",
        (cosine("cosine"), ETA),
        dielectric.reflectance,
        signs=critical,
        cancels=1.0,
        roundings=10.5 + 2 * (2 + 2.5) + 3,
        why="the refracted cosine (10.5); in both fractions products and sums (2) and a division (2.5); squares, a sum",
    ),
    Twin(
        "dielectric.glsl",
        "refracted",
        "vec3",
        (N, V, cosine("cosine"), ETA),
        lambda n, v, c, eta: dielectric.refracted(n, v, c, eta),
        cancels=1.0,
        roundings=2.5 + 10.5 + 3,
        why="two divisions (2.5), the refracted cosine (10.5), differences and the product",
        signs=lambda n, v, c, eta: critical(c, eta),
    ),
    Twin(
        "solid_planes.glsl",
        "distance_to_plane",
        "float",
        (
            Argument("start", "vec3", uniform(-1.0, 1.0, 3)),
            Argument("direction", "vec3", direction),
            Argument("plane", "vec4", uniform(-1.0, 1.0, 4), ((0.0, 0.0, 1.0, 1.0),)),
        ),
        distance_to_plane,
        roundings=5 + 1 + 5 + 2.5,
        why="a scalar product of three (5) and a difference, another, the division (2.5)",
        guards=("1e-4",),
        defines={"SOLIDS": 1, "ITERATIONS": 1},
    ),
)
