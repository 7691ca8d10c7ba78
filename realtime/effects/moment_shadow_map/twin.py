"""Float64 twins of the moment shadow map's functions."""

import numpy as np

from ...shadows.twin import DEFINES
from ...shared_twins import stack, unit
from ...twin import Argument, Twin, logarithmic, uniform

SPREAD = 2 + 2 + 2.5 + 4
"""Roundings of `spread_of`: the variance and the skew (2 each), the slope's division (2.5), the rest (4)."""


def kept(depth: np.ndarray, _slope: np.ndarray) -> np.ndarray:
    """Powers of the depth in −1…1."""
    return stack(*[(2 * depth - 1) ** power for power in (1, 2, 3, 4)])


def blurred(moments: np.ndarray, amount: np.ndarray) -> np.ndarray:
    """The moments, some of the way to (0, 3/8, 0, 3/8)."""
    return moments + amount * (np.array([0, 0.375, 0, 0.375])[:, None] - moments)


def hankel(b: np.ndarray) -> np.ndarray:
    """(n, 3, 3) of the moments of orders 0 to 4."""
    powers = np.stack([np.ones_like(b[0]), *b])
    return np.moveaxis(powers[np.add.outer(np.arange(3), np.arange(3))], -1, 0)


def least_before(b: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The least before z, by a system for the quadratic's coefficients and one for its roots' weights."""
    wanted = np.stack([np.ones_like(z), z, z * z], axis=-1)[..., None]
    constant, linear, quadratic = np.linalg.solve(hankel(b), wanted)[..., 0].T
    reach = np.sqrt(np.maximum(linear**2 - 4 * quadratic * constant, 0)) / (2 * np.abs(quadratic))
    middle = -linear / (2 * quadratic)
    depths = np.stack([z, middle - reach, middle + reach], axis=-1)
    vandermonde = np.stack([np.ones_like(depths), depths, depths**2], axis=-2)
    weights = np.linalg.solve(vandermonde, np.stack([np.ones_like(z), b[0], b[1]], axis=-1)[..., None])[..., 0]
    return np.sum(np.where(depths < z[:, None], weights, 0), axis=-1)


def most_at(b: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The largest share that a distribution with these moments can have at one depth."""
    x = np.stack([np.ones_like(z), z, z * z], axis=-1)
    return 1 / np.sum(x * np.linalg.solve(hankel(b), x[..., None])[..., 0], axis=-1)


def of_depths(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Moments of five depths, none of which has less than a twentieth."""
    _, z = inputs
    depths = rng.uniform(-1, 1, (5, len(z)))
    weights = 0.05 + rng.random((5, len(z)))
    weights /= weights.sum(axis=0)
    return [np.stack([np.sum(weights * depths**power, axis=0) for power in (1, 2, 3, 4)]), z]


TWINS = (
    Twin(
        "kept.glsl",
        "kept",
        "vec4",
        (unit("depth"), Argument("slope", "vec2", uniform(-0.2, 0.2, 2))),
        kept,
        roundings=1 + 3,
        why="2x − 1 and three products",
        cancels=1.0,
    ),
    Twin(
        "moment_shadow_map.glsl",
        "blurred",
        "vec4",
        (Argument("moments", "vec4", uniform(-1.0, 1.0, 4)), Argument("amount", "float", logarithmic(1e-8, 1.0))),
        blurred,
        roundings=3,
        why="1 − amount, a product and the sum",
        defines=DEFINES,
    ),
    Twin(
        "moment_shadow_map.glsl",
        "most_at",
        "float",
        (Argument("b", "vec4", uniform(-1.0, 1.0, 4)), Argument("z", "float", uniform(-1.0, 1.0))),
        most_at,
        roundings=SPREAD + 1 + 4 + 3 + 2 + 2.5,
        why="what the moments say; z − b₁ (1), the other difference (4), its square over D₃ (3 with the division), two "
        "sums and the division (2.5)",
        arrange=of_depths,
        defines=DEFINES,
    ),
    Twin(
        "moment_shadow_map.glsl",
        "least_before",
        "float",
        (Argument("b", "vec4", uniform(-1.0, 1.0, 4)), Argument("z", "float", uniform(-1.0, 1.0))),
        least_before,
        roundings=2 * SPREAD + 1 + 4 + 2.5 + 2 + 4 + 6 + 2 + 2.5 + 13,
        why="what the moments say, twice; z − b₁ (1), quadratic (4 and the division, 2.5), linear (2), constant (4), "
        "the root (6), its sum and half (2), the division (2.5); the most at it (13)",
        arrange=of_depths,
        guards=("1e9",),
        defines=DEFINES,
    ),
)
