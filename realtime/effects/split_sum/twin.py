"""Float64 twins of split_sum.glsl and albedo_samples.glsl."""

import numpy as np

from lightmeter.scenes.optics import arrays, microfacet

from ...environments.twin import TURN, UV, cosine_direction, ggx_half_vector
from ...shared_twins import alpha, color, cosine, stack, towards, unit
from ...twin import Argument, Twin, uniform

TABLE = {"LEVELS": 2, "SPECULAR_SIDE": 16, "COEFFICIENTS": 9, "COMPENSATION": "single_scattering"}


def view_at(n_dot_v: np.ndarray) -> np.ndarray:
    """A view in the plane of X and Z."""
    return stack(np.sqrt(1 - n_dot_v**2), np.zeros_like(n_dot_v), n_dot_v)


def schlick_weight(v_dot_h: np.ndarray) -> np.ndarray:
    """(1 − v·h)⁵."""
    return np.clip(1 - v_dot_h, 0, 1) ** 5


def specular_sample(u: np.ndarray, n_dot_v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """D·V·(n·l) over D·(n·h)/(4·(v·h)), without and with Schlick's weight."""
    h = ggx_half_vector(u, a)
    v_dot_h = np.sum(view_at(n_dot_v) * h, axis=0)
    n_dot_l = 2 * v_dot_h * h[2] - n_dot_v
    lit = (n_dot_l > 0) & (v_dot_h > 0)
    visible = microfacet.v_smith_ggx_correlated(n_dot_v, np.where(lit, n_dot_l, 1.0), a)
    weight = np.where(lit, 4 * visible * n_dot_l * v_dot_h / h[2], 0)
    return weight * stack(1 - schlick_weight(v_dot_h), schlick_weight(v_dot_h))


def sample_signs(u, n_dot_v, a):
    """The two cosines that decide, and what they are the sum of: sines and cosines of the turn are known to a few ε."""
    n_dot_v, a = np.ravel(n_dot_v), np.ravel(a)
    h, v = ggx_half_vector(u, a), view_at(n_dot_v)
    v_dot_h = np.sum(v * h, axis=0)
    size = TURN * np.sum(np.abs(v * h), axis=0)
    return [(2 * v_dot_h * h[2] - n_dot_v, 2 * size * h[2] + n_dot_v), (v_dot_h, size)]


def diffuse_sample(u: np.ndarray, n_dot_v: np.ndarray) -> np.ndarray:
    """Schlick's weight at the half vector of v and a direction from the cosine."""
    v = view_at(n_dot_v)
    return schlick_weight(np.sum(v * arrays.normalize(v + cosine_direction(u)), axis=0))


def single_scattering(f0, f90, base, specular, table, mirrored, around):
    """The lobe's albedo times what it sees, and the base's."""
    above = specular * (0.04 + 0.96 * table[2])
    return mirrored * (f0 * table[0] + f90 * table[1]) + around * base * (1 - above)


def multiple_scattering(f0, f90, base, _specular, table, mirrored, around):
    """Fdez-Agüera 2019, listing 3, as the sum of the geometric series of bounces between microfacets."""
    once = f0 * table[0] + f90 * table[1]
    lost = 1 - table[0] - table[1]
    mean = f0 * (20 / 21) + f90 / 21
    again = once * (1 / (1 - mean * lost) - 1)
    return mirrored * once + around * (again + base * (1 - once - again))


def possible(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """F90 at least F0, and an albedo of at most 0.95: with none lost 1 − mean·lost would have nothing to divide by."""
    f0, f90, base, specular, table, mirrored, around = inputs
    table = stack(0.05 + 0.6 * table[0], 0.3 * table[1], table[2])
    return [np.minimum(f0, f90), np.maximum(f0, f90), base, specular, table, mirrored, around]


PARTS = (
    color("f0"),
    color("f90"),
    color("base"),
    unit("specular"),
    Argument("table", "vec3", uniform(0.0, 1.0, 3)),
    Argument("mirrored", "vec3", uniform(0.0, 10.0, 3)),
    Argument("around", "vec3", uniform(0.0, 10.0, 3)),
)

TWINS = (
    Twin(
        "split_sum.glsl",
        "lobe_axis",
        "vec3",
        (towards("n"), towards("v")),
        lambda n, v: 2 * np.sum(n * v, axis=0) * n - v,
        roundings=3 + 1 + 1,
        why="a scalar product (3), the product and the difference",
        cancels=1.0,
        defines=TABLE,
    ),
    Twin(
        "split_sum.glsl",
        "single_scattering",
        "vec3",
        PARTS,
        single_scattering,
        roundings=4 + 1 + 2 + 2 + 1,
        why="above (4), 1 − above, two products; beside two products and a sum; the last sum",
        cancels=10.0,
        defines=TABLE,
    ),
    Twin(
        "split_sum.glsl",
        "multiple_scattering",
        "vec3",
        PARTS,
        multiple_scattering,
        roundings=3 + 2 + 3 + 2 + 2 + 2.5 + 4,
        why="once (3), lost (2), the mean (3), two products, 1 − mean·lost (2), the division (2.5), and four beyond",
        arrange=possible,
        cancels=10.0,
        defines=TABLE,
    ),
    Twin(
        "albedo_samples.glsl",
        "view_at",
        "vec3",
        (cosine("n_dot_v"),),
        view_at,
        roundings=2 + 3,
        why="1 − x² (2), the root (3)",
        cancels=1.0,
    ),
    Twin(
        "albedo_samples.glsl",
        "schlick_weight",
        "float",
        (unit("v_dot_h", (0.0, 1.0, 1.0000001, -1e-7, -0.05)),),
        schlick_weight,
        roundings=1 + 3,
        why="1 − v·h and three products",
        cancels=1.0,
    ),
    Twin(
        "albedo_samples.glsl",
        "specular_sample",
        "vec2",
        (UV, cosine("n_dot_v"), alpha("alpha")),
        specular_sample,
        roundings=8.5 + TURN + 5 + 3 + 3 + 12.5 + 2.5 + 7,
        why="h (8.5 and the turn), v (5), v·h (3), n·l (3), V (12.5), the division (2.5), (1 − v·h)⁵ (4), products (3)",
        signs=sample_signs,
        cancels=1.0,
    ),
    Twin(
        "albedo_samples.glsl",
        "diffuse_sample",
        "float",
        (UV, cosine("n_dot_v")),
        diffuse_sample,
        roundings=5 + TURN + 5 + 1 + 5 + 3 + 4,
        why="l (5 and the turn), v (5), their sum, its length (5), v·h (3), (1 − v·h)⁵ (4)",
        cancels=1.0,
    ),
)
