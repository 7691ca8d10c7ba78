"""Float64 twin of dynamic_cube_map.glsl."""

import numpy as np

from ...twin import Argument, Twin, uniform


def within(point: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Whether a point lies in a box, its faces included."""
    return np.all((point >= low) & (point <= high), axis=0).astype(np.float64)


def _about_the_faces(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Points within, on faces and beyond."""
    point, low, high = inputs
    on = rng.choice([0.0, 1.0, 2.0], point.shape, p=[0.8, 0.1, 0.1])
    return [np.where(on == 1, low, np.where(on == 2, high, point)), low, high]


TWINS = (
    Twin(
        "dynamic_cube_map.glsl",
        "within",
        "bool",
        (
            Argument("point", "vec3", uniform(-1, 1, 3)),
            Argument("low", "vec3", uniform(-1, 0, 3)),
            Argument("high", "vec3", uniform(0, 1, 3)),
        ),
        within,
        roundings=0,
        why="comparisons of the inputs only",
        arrange=_about_the_faces,
        defines={"SAMPLES": 1, "CUBES": 1},
    ),
)
