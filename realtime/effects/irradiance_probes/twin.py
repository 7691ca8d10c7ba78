"""Float64 twins of irradiance_probes.glsl's weights."""

import numpy as np

from ...shared_twins import towards
from ...twin import Argument, Twin, uniform


def corner_weight(share: np.ndarray, corner: np.ndarray) -> np.ndarray:
    """Trilinear."""
    return np.prod(np.where(corner > 0, share, 1 - share), axis=0)


def facing_weight(normal: np.ndarray, to_probe: np.ndarray) -> np.ndarray:
    """((1 + cos θ)/2)² + 0.2."""
    cosine = np.sum(normal * to_probe, axis=0) / np.linalg.norm(to_probe, axis=0)
    return ((1 + cosine) / 2) ** 2 + 0.2


TWINS = (
    Twin(
        "irradiance_probes.glsl",
        "corner_weight",
        "float",
        (
            Argument("share", "vec3", uniform(0.0, 1.0, 3)),
            Argument("corner", "vec3", lambda rng, n: rng.integers(0, 2, (3, n)).astype(np.float64)),
        ),
        corner_weight,
        roundings=1 + 2 + 2,
        why="1 − share, mix (2), two products",
        cancels=1.0,
    ),
    Twin(
        "irradiance_probes.glsl",
        "facing_weight",
        "float",
        (towards("normal"), Argument("to_probe", "vec3", uniform(-3.0, 3.0, 3))),
        facing_weight,
        roundings=3 + 3 + 2 + 1 + 1 + 2,
        why="two scalar products (3 each), inversesqrt (2), its product, the sum, the square and the last sum",
        cancels=1.0,
    ),
)
