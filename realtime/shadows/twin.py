"""Float64 twins of the shared shadow shaders; what reads a map is tested on scenes."""

import numpy as np

from ..shared_twins import stack, unit
from ..twin import Argument, Twin, direction, logarithmic, uniform, whole
from .views import CUBE_FACES

DEFINES = {"VIEWS": 6, "COLUMNS": 3, "RESOLUTION": 16, "FILTER_RADIUS": 1, "MEAN_RADIUS": 1}


def cube_face(d: np.ndarray) -> np.ndarray:
    """The face whose axis a direction is nearest to; x before y before z where two are alike."""
    looks = np.array([look for look, _ in CUBE_FACES], dtype=np.float64)
    # argmax takes the first of equals; +0 and −0 count as positive, as in GLSL's comparison.
    return np.argmax(looks @ d, axis=0).astype(np.float64)


def bias_distance(n_dot_l, n_dot_a, l_dot_a, texel, constant, slope, radius) -> np.ndarray:
    """Metres towards the light: `constant` texels, and a texel's depth on the slope times the filter's reach."""
    across = np.sqrt(np.maximum(1 - n_dot_a * n_dot_a, 0))
    return texel * (constant + slope * radius * across * np.abs(l_dot_a) / np.clip(n_dot_l, 0.001, 1.0))


def normal_distance(n_dot_l, texel, amount) -> np.ndarray:
    """Metres along the normal: `amount` texels, times the sine of the light's angle to it."""
    return texel * amount * np.sqrt(np.maximum(1 - n_dot_l * n_dot_l, 0))


def project(view: np.ndarray, point: np.ndarray):
    """Whether the point lies before the light, and its window coordinates 0…1. `view` holds a matrix's columns."""
    columns = view.reshape(4, 4, -1)
    clip = columns[0] * point[0] + columns[1] * point[1] + columns[2] * point[2] + columns[3]
    safe = np.where(clip[3] == 0, 1e-300, clip[3])
    return (clip[3] > 0).astype(np.float64), stack(*(clip[:3] / safe * 0.5 + 0.5))


def before_the_light(view: np.ndarray, point: np.ndarray):
    """What decides between before and behind: the homogeneous coordinate."""
    columns = view.reshape(4, 4, -1)
    terms = [columns[0][3] * point[0], columns[1][3] * point[1], columns[2][3] * point[2], columns[3][3]]
    return [(np.sum(terms, axis=0), np.sum(np.abs(terms), axis=0))]


def linear_depth(point: np.ndarray, light: np.ndarray, depths: np.ndarray) -> np.ndarray:
    """Where between two distances a point lies, from a position or along a direction."""
    away = np.where(light[3] > 0, np.linalg.norm(point - light[:3], axis=0), -np.sum(point * light[:3], axis=0))
    return (away - depths[0]) / (depths[1] - depths[0])


def darkened(share: np.ndarray, least: np.ndarray) -> np.ndarray:
    """A ramp from `least` to 1."""
    return np.maximum((share - least) / (1 - least), 0)


def position_or_direction(rng: np.random.Generator, n: int) -> np.ndarray:
    """(4, n) lights: positions with 1, directions with 0."""
    near = rng.random(n) < 0.5
    return np.concatenate([np.where(near, rng.uniform(-5, 5, (3, n)), direction(rng, n)), near[None].astype(float)])


def apart(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Lights with 0 or 1 for the last component; ranges of some length."""
    point, light, depths = inputs
    return [point, light, np.stack([depths[0], depths[0] + 1 + np.abs(depths[1])])]


def noise(pixel: np.ndarray) -> np.ndarray:
    """Interleaved gradient noise, 0…1."""
    inner = 0.06711056 * pixel[0] + 0.00583715 * pixel[1]
    return 52.9829189 * (inner % 1) % 1


def noise_wraps(pixel: np.ndarray):
    """How far both fractions are from wrapping, and the numbers that they are fractions of."""
    inner = 0.06711056 * pixel[0] + 0.00583715 * pixel[1]
    outer = 52.9829189 * (inner % 1)
    return [(np.minimum(f % 1, 1 - f % 1), size) for f, size in ((inner, inner), (outer, 52.9829189 * inner))]


def turned(point: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """A point of the plane, rotated by a cosine and a sine."""
    return stack(point[0] * turn[0] - point[1] * turn[1], point[0] * turn[1] + point[1] * turn[0])


def views(rng: np.random.Generator, n: int) -> np.ndarray:
    """(16, n) perspective views from the origin's neighbourhood, 5 to 170 degrees wide, along −z, column by column."""
    scale = 1 / np.tan(np.radians(rng.uniform(2.5, 85, n)))
    near, far = rng.uniform(0.01, 0.5, n), rng.uniform(5, 50, n)
    columns = np.zeros((4, 4, n))
    columns[0, 0] = columns[1, 1] = scale
    columns[2, 2], columns[3, 2], columns[2, 3] = (far + near) / (near - far), 2 * far * near / (near - far), -1
    columns[3, :2] = rng.uniform(-1, 1, (2, n))
    return columns.reshape(16, n)


TWINS = (
    Twin(
        "cube_face.glsl",
        "cube_face",
        "int",
        (
            Argument(
                "d",
                "vec3",
                direction,
                (
                    (1.0, 1.0, 1.0),
                    (-1.0, 1.0, 1.0),
                    (0.0, -1.0, 1.0),
                    (0.0, 0.0, -1.0),
                    (0.5, -1.0, -1.0),
                    (-2.0, 0.0, 0.0),
                ),
            ),
        ),
        cube_face,
        roundings=0,
        why="comparisons of the inputs only",
        defines=DEFINES,
    ),
    Twin(
        "shadow_views.glsl",
        "bias_distance",
        "float",
        (
            Argument("n_dot_l", "float", uniform(0.0, 1.0), (0.0, 0.001, 0.00100001, 0.999999, 1.0, 1.02)),
            Argument("n_dot_a", "float", uniform(-1.0, 1.0), (0.0, 0.9, -0.9)),
            Argument("l_dot_a", "float", uniform(-1.0, 1.0), (0.0, 1.0, -1.0)),
            Argument("texel", "float", logarithmic(1e-5, 1.0)),
            Argument("constant", "float", uniform(0.0, 2.0), (0.0,)),
            Argument("slope", "float", uniform(0.0, 2.0), (0.0,)),
            Argument("radius", "float", uniform(0.7, 3.0), (0.70710678,)),
        ),
        bias_distance,
        roundings=2 + 3 + 3 + 2.5 + 2,
        why="1 − (n·a)² (2), its root (3), three products, the division (2.5), the sum and the texel (2)",
        defines=DEFINES,
    ),
    Twin(
        "project.glsl",
        "project",
        "bool",
        (
            Argument("view", "mat4", views),
            Argument("point", "vec3", uniform(-5, 5, 3), ((0.0, 0.0, -1.0),)),
            Argument("coordinate", "vec3", out=True),
        ),
        project,
        roundings=4 + 2.5 + 2,
        why="a product and three sums, the division (2.5), the half and its sum",
        signs=before_the_light,
    ),
    Twin(
        "shadow_views.glsl",
        "normal_distance",
        "float",
        (
            Argument("n_dot_l", "float", uniform(-1.0, 1.0), (0.0, 1.0, 1.0000001)),
            Argument("texel", "float", logarithmic(1e-5, 1.0)),
            Argument("amount", "float", uniform(0.0, 4.0), (0.0,)),
        ),
        normal_distance,
        roundings=2 + 3 + 2,
        why="1 − (n·l)² (2), its root (3), two products",
        defines=DEFINES,
    ),
    Twin(
        "noise.glsl",
        "interleaved_noise",
        "float",
        (Argument("pixel", "vec2", lambda rng, n: whole(0, 4095)(rng, 2 * n).reshape(2, n)),),
        noise,
        roundings=2 + 2 + 2,
        why="both constants, a product and a sum; the constant and the product (fractions are exact)",
        signs=noise_wraps,
    ),
    Twin(
        "shadow_filter.glsl",
        "turned",
        "vec2",
        (
            Argument("point", "vec2", uniform(-1.0, 1.0, 2), ((0.0, 0.0), (1.0, 0.0))),
            Argument("turn", "vec2", uniform(-1.0, 1.0, 2), ((1.0, 0.0), (0.0, -1.0))),
        ),
        turned,
        roundings=2,
        why="a product and the sum",
        defines=DEFINES,
    ),
    Twin(
        "shadow_depth.glsl",
        "linear_depth",
        "float",
        (
            Argument("point", "vec3", uniform(-5, 5, 3)),
            Argument("light", "vec4", position_or_direction),
            Argument("range", "vec2", uniform(-5, 5, 2)),
        ),
        linear_depth,
        roundings=1 + 3 + 3 + 2 + 2.5,
        why="the difference, its square (3) and root (3); both differences (2) and the division (2.5)",
        arrange=apart,
    ),
    Twin(
        "shadow_lookup.glsl",
        "darkened",
        "float",
        (unit("share"), Argument("least", "float", uniform(0.0, 0.99), (0.0,))),
        darkened,
        roundings=2 + 2.5,
        why="both differences and the division (2.5)",
        cancels=1.0,
        defines=DEFINES,
    ),
)
