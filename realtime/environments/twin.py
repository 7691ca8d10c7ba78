"""Float64 twins of the shaders that techniques for environment maps share."""

import numpy as np

from ..shadows.twin import cube_face
from ..shared_twins import alpha, cosine, stack, towards
from ..twin import Argument, Twin, logarithmic, uniform, whole

FACE = Argument("face", "int", whole(0, 5))


def on_face(d: np.ndarray, face: np.ndarray) -> np.ndarray:
    """OpenGL 4.1, table 3.24: s and t over the major axis, −1…1."""
    x, y, z = d
    s = np.choose(face.astype(int), [-z, z, x, x, x, -x])
    t = np.choose(face.astype(int), [-y, -y, z, -z, -y, -y])
    return stack(s, t) / np.choose(face.astype(int) // 2, np.abs(d))


def through_face(place: np.ndarray, face: np.ndarray) -> np.ndarray:
    """The direction whose major axis is 1 long."""
    s, t = place
    one = np.ones_like(s)
    choices = ((one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one), (-s, -t, -one))
    return stack(*(np.choose(face.astype(int), components) for components in zip(*choices, strict=True)))


def first_row(level: np.ndarray, side: np.ndarray) -> np.ndarray:
    """The heights of the levels above, added up."""
    rows = np.zeros_like(side)
    for above in range(int(level.max())):
        rows += np.where(above < level, np.floor(side / 2**above) + 2, 0)
    return rows


def in_atlas(place: np.ndarray, face: np.ndarray, level: np.ndarray, side: np.ndarray) -> np.ndarray:
    """A tile has a border of one texel."""
    texels = np.floor(side / 2**level)
    corner = stack(face * (texels + 2), first_row(level, side)) + 1
    return corner + (place + 1) / 2 * texels


def radical_inverse(index: np.ndarray) -> np.ndarray:
    """The bits of a number of 32 bits behind the point, lowest first."""
    bits = (index.astype(np.int64)[:, None] >> np.arange(32)) & 1
    return bits @ 0.5 ** np.arange(1, 33)


def hammersley(index: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Keller 1997, half a step from 0."""
    return stack((index + 0.5) / count, radical_inverse(index) + 2.0**-33)


def polar(sine: np.ndarray, cosine: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """A unit vector of its angles."""
    return stack(sine * np.cos(turn), sine * np.sin(turn), cosine)


def ggx_half_vector(u: np.ndarray, a: np.ndarray) -> np.ndarray:
    """Walter et al. 2007, eq. 35: θ = atan(α√(u/(1 − u)))."""
    theta = np.arctan(a * np.sqrt(u[0] / (1 - u[0])))
    return polar(np.sin(theta), np.cos(theta), 2 * np.pi * u[1])


def cosine_direction(u: np.ndarray) -> np.ndarray:
    """sin²θ is even for a density of cos θ/π."""
    return polar(np.sqrt(u[0]), np.sqrt(1 - u[0]), 2 * np.pi * u[1])


def turned_to(n: np.ndarray, local: np.ndarray) -> np.ndarray:
    """Duff et al. 2017: the tangent is +X less what of it lies along n ± Z, the bitangent across both."""
    x, y, z = n
    side = np.where(z >= 0, 1.0, -1.0)
    tangent = stack(1 - x * x / (1 + np.abs(z)), -x * y / (1 + np.abs(z)), -side * x)
    bitangent = np.cross(n, tangent, axis=0)
    return tangent * local[0] + bitangent * local[1] + n * local[2]


def basis(index: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Ramamoorthi & Hanrahan 2001, eq. 3; normalised here, where the paper has digits."""
    x, y, z = d[0], d[2], d[1]
    linear, quadratic = np.sqrt(3 / (4 * np.pi)), np.sqrt(15 / (4 * np.pi))
    return np.choose(
        index.astype(int),
        [
            np.full_like(x, np.sqrt(1 / (4 * np.pi))),
            linear * y,
            linear * z,
            linear * x,
            quadratic * x * y,
            quadratic * y * z,
            np.sqrt(5 / (16 * np.pi)) * (3 * z * z - 1),
            quadratic * x * z,
            quadratic / 2 * (x * x - y * y),
        ],
    )


def on_some_face(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """The face that the direction leaves through: on another the place is far away."""
    d, _ = inputs
    return [d, cube_face(d)]


UV = Argument("u", "vec2", uniform(0.0, 0.999, 2), ((0.0, 0.0), (0.5, 0.25)))
"""Two numbers 0…1."""
TURN = 6.3 * 2
"""sin and cos of an angle up to 2π that is known to a rounding, at GLSL's 2⁻¹¹ at worst; llvmpipe's are of full
precision, and the angle's own size counts."""

TWINS = (
    Twin(
        "cube_atlas.glsl",
        "on_face",
        "vec2",
        (towards("d"), FACE),
        on_face,
        roundings=2.5,
        why="the division (2.5)",
        arrange=on_some_face,
    ),
    Twin(
        "cube_atlas.glsl",
        "through_face",
        "vec3",
        (Argument("place", "vec2", uniform(-1.1, 1.1, 2)), FACE),
        through_face,
        roundings=0.5,
        why="nothing is computed",
    ),
    Twin(
        "cube_atlas.glsl",
        "first_row",
        "int",
        (
            Argument("level", "int", whole(0, 5)),
            Argument("side", "int", lambda rng, n: 2.0 ** rng.integers(5, 10, n)),
        ),
        first_row,
        roundings=0,
        why="whole numbers",
    ),
    Twin(
        "cube_atlas.glsl",
        "in_atlas",
        "vec2",
        (
            Argument("place", "vec2", uniform(-1.1, 1.1, 2), ((-1.0, -1.0), (0.0, 1.0))),
            FACE,
            Argument("level", "int", whole(0, 5)),
            Argument("side", "int", lambda rng, n: 2.0 ** rng.integers(5, 10, n)),
        ),
        in_atlas,
        roundings=4,
        why="the half and its sum, the corner's sum and the last",
        cancels=1.0,
    ),
    Twin(
        "sample_lobes.glsl",
        "hammersley",
        "vec2",
        (Argument("index", "int", whole(0, 4095)), Argument("count", "int", whole(4096, 65536))),
        hammersley,
        roundings=1 + 2.5,
        why="the half, the division (2.5)",
    ),
    Twin(
        "sample_lobes.glsl",
        "ggx_half_vector",
        "vec3",
        (UV, alpha("alpha")),
        ggx_half_vector,
        roundings=3 + 2.5 + 1 + 2 + 3 + TURN,
        why="α²u (2), 1 − u and the division (3.5); 1 + slope², inversesqrt (2), the root (3) and products; the turn",
        cancels=1.0,
    ),
    Twin(
        "sample_lobes.glsl",
        "cosine_direction",
        "vec3",
        (UV,),
        cosine_direction,
        roundings=1 + 3 + 1 + TURN,
        why="1 − u, the root (3), the product; the turn",
        cancels=1.0,
    ),
    Twin(
        "sample_lobes.glsl",
        "turned_to",
        "vec3",
        (towards("n"), towards("local")),
        turned_to,
        roundings=1 + 2.5 + 3 + 1 + 3,
        why="side + z, the division (2.5), three products and a sum; the sum of three products",
        cancels=1.0,
    ),
    Twin(
        "sh_irradiance.glsl",
        "basis",
        "float",
        (Argument("index", "int", whole(0, 8)), towards("d")),
        basis,
        roundings=5,
        why="3·y², the difference, the constant and its product",
        cancels=1.0,
        defines={"COEFFICIENTS": 9},
    ),
    Twin(
        "environment_filter.glsl",
        "source_level",
        "float",
        (
            Argument("solid_angle", "float", logarithmic(1e-6, 12.6)),
            Argument("texel", "float", logarithmic(1e-7, 1e-1)),
        ),
        lambda solid_angle, texel: np.maximum(0.5 * np.log2(solid_angle / texel), 0),
        roundings=2.5 + 3 + 1,
        why="the division (2.5), log2 (3) and the half",
        cancels=1.0,
        defines={"SAMPLES": 4},
    ),
    Twin(
        "environment_filter.glsl",
        "represented",
        "float",
        (cosine("density"), Argument("samples", "int", whole(1, 4096))),
        lambda density, samples: 4 / (samples * density),
        roundings=1 + 2.5,
        why="the product and the division (2.5)",
        defines={"SAMPLES": 4},
    ),
)
