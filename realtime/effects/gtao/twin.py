"""Float64 twins of GTAO's integrals and heuristics; what it reads from the screen is tested on scenes."""

import numpy as np

from ...shared_twins import color, stack, towards, unit
from ...twin import Argument, Twin, logarithmic, uniform, whole

DEFINES = {"SLICES": 1, "STEPS": 1, "SCALE": 1, "SPECULAR_OCCLUSION": "specular_lagarde"}
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def over_slice(h: np.ndarray, n: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles (24, …) between the viewer and a horizon, and there cos(θ − n)·|sin θ| times the quadrature's weights."""
    angle = h * (NODES[:, None] + 1) / 2
    return angle, np.cos(angle - n) * np.abs(np.sin(angle)) * np.abs(h) / 2 * WEIGHTS[:, None]


def slice_visibility(h: np.ndarray, n: np.ndarray) -> np.ndarray:
    """The visible share by quadrature."""
    return over_slice(h, n)[1].sum(axis=0)


def slice_mean(h: np.ndarray, n: np.ndarray) -> np.ndarray:
    """The mean direction by quadrature: sine and cosine, weighted."""
    angle, weight = over_slice(h, n)
    return stack((np.sin(angle) * weight).sum(axis=0), (np.cos(angle) * weight).sum(axis=0))


def counted(distance_to: np.ndarray, reach: np.ndarray, fading: np.ndarray) -> np.ndarray:
    """A ramp from 1 to 0 that ends at the radius."""
    return np.clip((reach - distance_to) / np.maximum(reach * fading, 1e-6), 0, 1)


def into_slice(offset: np.ndarray, across: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Less its component across the slice, which is taken away along the plane of the normal."""
    tangent = across - normal * np.sum(across * normal, axis=0)
    return offset - tangent * np.sum(offset * across, axis=0) / np.maximum(np.sum(tangent**2, axis=0), 1e-6)


def raised(horizon: np.ndarray, seen: np.ndarray, falls_back: np.ndarray) -> np.ndarray:
    """Up at once, down by a part of the difference."""
    difference = seen - horizon
    return horizon + np.maximum(difference, 0) + falls_back * np.minimum(difference, 0)


def pattern(column: np.ndarray, row: np.ndarray) -> np.ndarray:
    """Of 16 turns each once in every 4 × 4 pixels; of four shifts each once along every row and every diagonal."""
    return stack((4 * ((column + row) % 4) + column % 4) / 16, ((row - column) % 4) / 4 + 0.125)


def multi_bounce(visibility: np.ndarray, albedo: np.ndarray) -> np.ndarray:
    """The cubic of eq. 10, term by term."""
    cubic = (2.0404 * albedo - 0.3324) * visibility**3 + (0.6417 - 4.7951 * albedo) * visibility**2
    return np.maximum(visibility, cubic + (2.7552 * albedo + 0.6903) * visibility)


ANGLES = (
    Argument("h", "float", uniform(-np.pi, np.pi), (0.0,)),
    Argument("n", "float", uniform(-np.pi / 2, np.pi / 2), (0.0,)),
)

TWINS = (
    Twin(
        "horizons.glsl",
        "slice_visibility",
        "float",
        ANGLES,
        slice_visibility,
        roundings=2 + 4 + 3,
        why="the angle (2), its cosine (llvmpipe: 4·2⁻²⁴), two sums and a quarter",
        cancels=8.0,
        defines=DEFINES,
    ),
    Twin(
        "horizons.glsl",
        "slice_mean",
        "vec2",
        ANGLES,
        slice_mean,
        roundings=2 + 4 + 5,
        why="the angle (2), its sine (llvmpipe: 4·2⁻²⁴), three sums, a product and the division",
        cancels=8.0,
        defines=DEFINES,
    ),
    Twin(
        "horizons.glsl",
        "counted",
        "float",
        (
            Argument("distance_to", "float", uniform(0.0, 3.0), (0.0,)),
            Argument("reach", "float", logarithmic(0.1, 3.0)),
            Argument("fading", "float", uniform(0.05, 1.0), (1.0,)),
        ),
        counted,
        roundings=1 + 1 + 2.5,
        why="the difference, the product, the division (2.5)",
        guards=("1e-6",),
        defines=DEFINES,
    ),
    Twin(
        "horizons.glsl",
        "into_slice",
        "vec3",
        (
            Argument("offset", "vec3", uniform(-2.0, 2.0, 3), ((0.0, 0.0, 0.0),)),
            towards("across"),
            towards("normal"),
        ),
        into_slice,
        roundings=3 + 2 + 3 + 3 + 2.5 + 2,
        why="a scalar product (3), its product and the difference; a square (3); a scalar product (3) and the division "
        "(2.5); a product and the difference",
        cancels=4.0,
        guards=("1e-6",),
        defines=DEFINES,
    ),
    Twin(
        "horizons.glsl",
        "raised",
        "float",
        (
            Argument("horizon", "float", uniform(-1.0, 1.0), (-1.0, 1.0)),
            Argument("seen", "float", uniform(-1.0, 1.0), (-1.0, 1.0)),
            unit("falls_back"),
        ),
        raised,
        roundings=3,
        why="mix: 1 − t, a product and the sum",
        cancels=1.0,
        defines=DEFINES,
    ),
    Twin(
        "horizons.glsl",
        "pattern",
        "vec2",
        (Argument("column", "int", whole(0, 4095)), Argument("row", "int", whole(0, 4095))),
        pattern,
        roundings=1,
        why="quarters and sixteenths are exact",
        defines=DEFINES,
    ),
    Twin(
        "gtao.glsl",
        "multi_bounce",
        "vec3",
        (unit("visibility"), color("albedo")),
        multi_bounce,
        roundings=3 + 4,
        why="a coefficient (2), two products and two sums of the cubic by Horner's rule",
        cancels=4.7951,
        defines=DEFINES,
    ),
)
