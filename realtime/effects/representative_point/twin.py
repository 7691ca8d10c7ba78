"""Float64 twin of representative_point.glsl."""

import numpy as np

from ...shared_twins import alpha, stack, towards, unit
from ...twin import Argument, Twin, logarithmic, uniform


def length_of(v: np.ndarray) -> np.ndarray:
    """The length of vectors, (n,)."""
    return np.linalg.norm(v, axis=0)


def nearest_on_sphere(to_centre: np.ndarray, radius: np.ndarray, ray: np.ndarray) -> np.ndarray:
    """The point of the sphere nearest to the ray, from the ray's origin; on the ray where it meets the sphere."""
    across = np.maximum(np.sum(to_centre * ray, axis=0), 0) * ray - to_centre
    return to_centre + across * np.minimum(1, radius / np.maximum(length_of(across), 1e-15))


def meets_plane(to_centre, u, v, normal, ray) -> np.ndarray:
    """Where the ray meets the plane, along u and v from the centre."""
    t = -np.sum(to_centre * normal, axis=0) / np.maximum(-np.sum(ray * normal, axis=0), 1e-4)
    offset = t * ray - to_centre
    return stack(np.sum(offset * u, axis=0), np.sum(offset * v, axis=0))


def held_within(place: np.ndarray, extent: np.ndarray, disk: np.ndarray) -> np.ndarray:
    """The nearest point of the rectangle, or of the disk of radius extent.x."""
    onto_disk = place * np.minimum(1, extent[0] / np.maximum(length_of(place), 1e-15))
    return np.where(disk > 0, onto_disk, np.clip(place, -extent, extent))


def solid_angle_of_disk(square_ratio: np.ndarray, cos_light: np.ndarray) -> np.ndarray:
    """2π·(1 − 1/√(1 + r²/d²))·cos, written without the difference."""
    s = np.sqrt(1 + square_ratio)
    return 2 * np.pi * cos_light * square_ratio / (s * (1 + s))


def lowered_peak(alpha_: np.ndarray, angles: np.ndarray, width: np.ndarray) -> np.ndarray:
    """α²/(α'·α″), with an α' ≤ 1 for each axis."""
    widened = np.minimum(alpha_ + width * angles, 1)
    return alpha_**2 / (widened[0] * widened[1])


def clamped_cosine(n: np.ndarray, offset: np.ndarray) -> np.ndarray:
    """max(n·l, 0) towards an offset."""
    return np.maximum(np.sum(n * offset, axis=0), 0) / np.maximum(length_of(offset), 1e-15)


def mean_of_five(n, to_centre, u, v, disk) -> np.ndarray:
    """Over the centre, and the corners ±u ± v or the rim's ±u, ±v."""
    a, b = np.where(disk > 0, u, u + v), np.where(disk > 0, v, u - v)
    return np.mean([clamped_cosine(n, to_centre + offset) for offset in (np.zeros_like(a), a, -a, b, -b)], axis=0)


def offset(name: str) -> Argument:
    """A vector of some metres."""
    return Argument(name, "vec3", uniform(-3, 3, 3), ((0.0, 0.0, 2.0), (0.0, -1.0, 0.0)))


def onto_the_light(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A receiver before the plane, and a ray that meets it; a tenth leaves it or runs along it.

    Nearly along the plane, t is the quotient of the height and a difference that float32 hardly knows; those lanes
    are kept few, not none: their tolerance grows with the derivative.
    """
    to_centre, u, v, normal, ray = inputs
    height = np.sum(to_centre * normal, axis=0)
    to_centre = np.where(height > 0, -to_centre, to_centre)
    leaving = (np.sum(ray * normal, axis=0) > 0) & (_rng.random(ray.shape[1]) < 0.9)
    return [to_centre, u, v, normal, np.where(leaving, -ray, ray)]


flag = Argument("disk", "bool", lambda rng, n: rng.integers(0, 2, n).astype(np.float64))

TWINS = (
    Twin(
        "representative_point.glsl",
        "nearest_on_sphere",
        "vec3",
        (offset("to_centre"), Argument("radius", "float", logarithmic(1e-3, 1.0)), towards("ray")),
        nearest_on_sphere,
        roundings=3 + 2 + 3 + 2 + 2 + 1,
        why="a scalar product (3), its product and difference; a square (3), inversesqrt (2), two products, the sum",
    ),
    Twin(
        "representative_point.glsl",
        "meets_plane",
        "vec2",
        (offset("to_centre"), towards("u"), towards("v"), towards("normal"), towards("ray")),
        meets_plane,
        roundings=3 + 3 + 2.5 + 2 + 3,
        why="two scalar products (3 each), the division (2.5), a product and a difference, a scalar product (3)",
        arrange=onto_the_light,
    ),
    Twin(
        "representative_point.glsl",
        "held_within",
        "vec2",
        (
            Argument("place", "vec2", uniform(-2, 2, 2), ((0.0, 0.0), (1.0, 1.0))),
            Argument("extent", "vec2", uniform(0.01, 1.5, 2), ((1.0, 1.0),)),
            flag,
        ),
        held_within,
        roundings=2 + 2 + 2,
        why="a square (2), inversesqrt (2), two products",
    ),
    Twin(
        "representative_point.glsl",
        "solid_angle_of_disk",
        "float",
        (Argument("square_ratio", "float", logarithmic(1e-8, 1e4)), unit("cos_light")),
        solid_angle_of_disk,
        roundings=1 + 3 + 2 + 3 + 2.5,
        why="a sum, the root (3), a sum and a product; π and three products; the division (2.5)",
    ),
    Twin(
        "representative_point.glsl",
        "lowered_peak",
        "float",
        (
            alpha("alpha"),
            Argument("angles", "vec2", logarithmic(1e-3, 1e2, 2)),
            Argument("width", "float", uniform(0, 0.5), (0.0, 0.5)),
        ),
        lowered_peak,
        roundings=2 * 2 + 1 + 1 + 2.5,
        why="a product and a sum for each of two, their product; α² and the division (2.5)",
    ),
    Twin(
        "representative_point.glsl",
        "clamped_cosine",
        "float",
        (towards("n"), offset("offset")),
        clamped_cosine,
        roundings=3 + 3 + 2 + 1,
        why="two scalar products (3 each), inversesqrt (2) and the product",
    ),
    Twin(
        "representative_point.glsl",
        "mean_of_five",
        "float",
        (towards("n"), offset("to_centre"), offset("u"), offset("v"), flag),
        mean_of_five,
        roundings=2 + 9 + 4 + 2,
        why="two sums of vectors, a clamped cosine (9), four sums, 0.2 and its product",
    ),
)
