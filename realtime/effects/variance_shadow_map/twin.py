"""Float64 twins of the variance shadow map's functions."""

import numpy as np

from ...shadows.twin import DEFINES
from ...shared_twins import stack, unit
from ...twin import Argument, Twin, logarithmic, uniform


def kept(depth: np.ndarray, slope: np.ndarray) -> np.ndarray:
    """Mean and mean square of a plane's depth within a texel."""
    return stack(depth, depth**2 + np.sum(slope**2, axis=0) / 4, 0, 0)


def share_beyond(moments: np.ndarray, depth: np.ndarray, least: np.ndarray) -> np.ndarray:
    """The most that may lie beyond a depth, by Chebyshev's one-sided inequality."""
    variance = np.maximum(moments[1] - moments[0] ** 2, least)
    beyond = np.maximum(depth - moments[0], 0)
    return variance / (variance + beyond**2)


def of_depths(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A mean square that depths of 0…1 can have: between the mean's square and the mean."""
    (mean, share), depth, least = inputs
    return [stack(mean, mean**2 + share * (mean - mean**2)), depth, least]


TWINS = (
    Twin(
        "kept.glsl",
        "kept",
        "vec4",
        (unit("depth"), Argument("slope", "vec2", uniform(-0.2, 0.2, 2), ((0.0, 0.0),))),
        kept,
        roundings=4,
        why="both squares of the slope and their sum (2), a quarter of it, the square and the sum",
    ),
    Twin(
        "variance_shadow_map.glsl",
        "share_beyond",
        "float",
        (
            Argument("moments", "vec2", uniform(0.0, 1.0, 2), ((0.5, 0.0), (1.0, 0.0))),
            unit("depth"),
            Argument("least", "float", logarithmic(1e-8, 1e-2)),
        ),
        share_beyond,
        roundings=2 + 2 + 1 + 2.5,
        why="the square and the difference, the square of the depth's difference (2), the sum, the division (2.5)",
        arrange=of_depths,
        defines=DEFINES,
    ),
)
