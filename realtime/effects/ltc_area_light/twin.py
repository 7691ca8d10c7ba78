"""Float64 twins of polygon_irradiance.glsl; what cuts polygons is held against quadrature on scenes."""

import numpy as np

from ...twin import Argument, Twin, logarithmic, uniform

LARGEST = 1 - 1e-7
"""Of |cos θ| that the closed form below is evaluated at; there it is off by 1e-7·θ²/6."""


def angle_over_sine(x: np.ndarray) -> np.ndarray:
    """θ/sin θ, from cos θ = x."""
    held = np.clip(x, -1, LARGEST)
    return np.arccos(held) / np.sqrt(np.maximum(1 - held**2, 1e-7))


def side_irradiance(base: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """θ·(b × a)/|b × a|, of corners at base + a and base + b, θ the angle between them."""
    start, end = base + a, base + b
    across = np.cross(end, start, axis=0)
    size = np.linalg.norm(across, axis=0)
    angle = np.arctan2(size, np.sum(start * end, axis=0))
    return across * (angle / np.where(size > 0, size, 1))


def on_horizon(a: np.ndarray, b: np.ndarray, height_a: np.ndarray, height_b: np.ndarray) -> np.ndarray:
    """Where a line's height is 0."""
    return a + (b - a) * (height_a / (height_a - height_b))


def opposite(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Heights on both sides."""
    a, b, height_a, height_b = inputs
    return [a, b, height_a, -np.sign(height_a) * height_b]


TWINS = (
    Twin(
        "polygon_irradiance.glsl",
        "angle_over_sine",
        "float",
        (Argument("x", "float", uniform(-0.9999, 1), (-0.5, 0.0, 0.5, 1.0), kind="cosine"),),
        angle_over_sine,
        roundings=6 + 2.5 + 4,
        why="three products and sums in the divisor, the division (2.5); 1 − y² (2) and inversesqrt (2). The fit's own "
        "2e-8 is a sixth of a rounding",
        cancels=1.0,
        guards=("1e-7",),
    ),
    Twin(
        "polygon_irradiance.glsl",
        "side_irradiance",
        "vec3",
        (
            Argument("base", "vec3", uniform(-3, 3, 3)),
            Argument("a", "vec3", uniform(-1, 1, 3), ((0.0, 0.0, 0.0),)),
            Argument("b", "vec3", uniform(-1, 1, 3), ((0.5, 0.5, 0.5),)),
        ),
        side_irradiance,
        roundings=1 + 3 + 3 + 1 + 2 + 4 + 12.5 + 2,
        why="a difference and the cross product (3); two squares (3), their product and inversesqrt (2); the cosine "
        "(4), the angle over its sine (12.5), two products",
    ),
    Twin(
        "polygon_irradiance.glsl",
        "on_horizon",
        "vec3",
        (
            Argument("a", "vec3", uniform(-2, 2, 3)),
            Argument("b", "vec3", uniform(-2, 2, 3)),
            Argument("height_a", "float", uniform(-2, 2), (1e-6,)),
            Argument("height_b", "float", logarithmic(1e-6, 2)),
        ),
        on_horizon,
        roundings=1 + 1 + 2.5 + 2,
        why="two differences, the division (2.5), a product and a sum",
        arrange=opposite,
    ),
)
