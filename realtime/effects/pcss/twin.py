"""Float64 twins of pcss.glsl's geometry; its comparisons read the map and are tested on scenes."""

import math

import numpy as np

from ...shadows.twin import DEFINES as VIEWS
from ...shadows.twin import views
from ...shared_twins import stack
from ...twin import Argument, Twin, logarithmic, uniform, whole

GOLDEN = (math.sqrt(5) - 1) / 2
DEFINES = VIEWS | {"SAMPLES": 4, "SEARCH_SAMPLES": 4}


def places(i: np.ndarray, count: np.ndarray, shift: np.ndarray) -> list[np.ndarray]:
    """Both coordinates before they are moved round."""
    return [i / count + shift[0], i * GOLDEN + shift[1]]


def spread(i: np.ndarray, count: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Point i of the golden lattice, shifted, in 0…1."""
    return stack(*[place % 1 for place in places(i, count, shift)])


def spread_wraps(i: np.ndarray, count: np.ndarray, shift: np.ndarray):
    """How far both coordinates are from wrapping, and the numbers that they are fractions of."""
    found = places(i[0], count[0], shift)
    return [(np.minimum(place % 1, 1 - place % 1), place) for place in found]


def through(to_point: np.ndarray, part: np.ndarray, nearness: np.ndarray) -> np.ndarray:
    """The ray by linear interpolation."""
    return nearness * to_point + (1 - nearness) * part


def axial(depth: np.ndarray, near: np.ndarray, far: np.ndarray) -> np.ndarray:
    """The inverse of a perspective depth: 1/w is linear in it, from 1/near to 1/far."""
    return 1 / ((1 - depth) / near + depth / far)


def ray_at(view: np.ndarray, place: np.ndarray) -> np.ndarray:
    """The direction whose homogeneous coordinate is 1 and whose clip coordinates are the place: a 3 × 3 system."""
    rows = view.reshape(4, 4, -1)[:3, [0, 1, 3]].transpose(2, 1, 0)  # lane, clip component, world axis
    wanted = np.stack([place[0], place[1], np.ones_like(place[0])], axis=-1)
    return np.linalg.solve(rows, wanted[..., None])[..., 0].T


TWINS = (
    Twin(
        "pcss.glsl",
        "spread",
        "vec2",
        (
            Argument("i", "int", whole(0, 255)),
            Argument("count", "int", whole(1, 256)),
            Argument("shift", "vec2", uniform(0.01, 1.0, 2)),
        ),
        spread,
        roundings=2.5 + 1 + 1,
        why="the division (2.5), its product and the sum (the fraction is exact)",
        signs=spread_wraps,
        cancels=256.0,
        defines=DEFINES,
    ),
    Twin(
        "pcss.glsl",
        "through",
        "vec3",
        (
            Argument("to_point", "vec3", uniform(-10.0, 10.0, 3)),
            Argument("part", "vec3", uniform(-1.0, 1.0, 3)),
            Argument("nearness", "float", uniform(0.0, 1.0), (0.0, 1.0)),
        ),
        through,
        roundings=3,
        why="1 − nearness, a product and the sum",
        defines=DEFINES,
    ),
    Twin(
        "pcss.glsl",
        "axial",
        "float",
        (
            Argument("depth", "float", uniform(0.0, 1.0), (0.0, 1.0)),
            Argument("near", "float", logarithmic(0.01, 1.0)),
            Argument("far", "float", uniform(2.0, 50.0)),
        ),
        axial,
        roundings=1 + 3 + 2.5,
        why="near·far; far − near, its product and the difference; the division (2.5)",
        defines=DEFINES,
    ),
    Twin(
        "pcss.glsl",
        "ray_at",
        "vec3",
        (
            Argument("view", "mat4", views),
            Argument("place", "vec2", uniform(-1.0, 1.0, 2), ((0.0, 0.0), (1.0, -1.0))),
        ),
        ray_at,
        roundings=2 + 3 + 2.5 + 1,
        why="two products and their sum (2); the square (3), the division (2.5) and the last sum",
        defines=DEFINES,
    ),
)
