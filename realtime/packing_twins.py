"""Twins of packing.glsl and of the decoding curve beside it: what the G-buffer's formats do to what they hold."""

import numpy as np

from lightmeter.scenes.optics.color import srgb_decode

from .twin import Argument, Twin, direction, logarithmic, uniform, whole

RANGE = Argument(
    "range", "vec2", lambda rng, n: np.stack([np.exp(rng.uniform(-5, 0, n)), np.exp(rng.uniform(1, 7, n))])
)
"""Near and far."""
DISTANCE = Argument("z", "float", logarithmic(1e-2, 1e3))
DEPTH = Argument("depth", "float", uniform(0.0, 1.0), (0.0, 1.0))
FEW = Argument("largest", "float", lambda rng, n: rng.choice([255.0, 4095.0, 65535.0], n))
"""Up to 16 bits: of more, float32 cannot tell many halves."""
LARGEST = Argument("largest", "float", lambda rng, n: rng.choice([255.0, 65535.0, 16777215.0], n))
HALF_RANGE = Argument("half_range", "float", lambda rng, n: rng.choice([127.0, 2047.0, 32767.0], n))


def within(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Distances between near and far."""
    z, span = inputs
    return [np.clip(z, span[0], span[1]), span]


def standard_depth(z, span):
    """0 at the near plane, 1 at the far one, linear in 1/z."""
    return (1 / span[0] - 1 / z) / (1 / span[0] - 1 / span[1])


def from_standard_depth(depth, span):
    """The distance along the view."""
    return 1 / (1 / span[0] + depth * (1 / span[1] - 1 / span[0]))


def depth_code(depth, largest):
    """0…1 to whole numbers 1…largest."""
    return 1 + np.round(np.clip(depth, 0, 1) * (largest - 1))


def octahedral(n):
    """(2, N) coordinates −1…1 of unit vectors (3, N) (Cigolle et al. 2014)."""
    x, y, z = n / np.sum(np.abs(n), axis=0)
    folded = [np.where(z < 0, (1 - np.abs(b)) * np.where(a >= 0, 1, -1), a) for a, b in ((x, y), (y, x))]
    return np.stack(folded)


def from_octahedral(e):
    """Unit vectors (3, N)."""
    x, y = e
    z = 1 - np.abs(x) - np.abs(y)
    folded = [np.where(z < 0, (1 - np.abs(b)) * np.where(a >= 0, 1, -1), a) for a, b in ((x, y), (y, x))]
    v = np.stack([*folded, z])
    return v / np.linalg.norm(v, axis=0)


def signed_codes(x, half_range):
    """−1…1 to whole numbers 0…2·half_range, the middle for 0."""
    return np.round(np.clip(x, -1, 1) * half_range) + half_range


def quantised_normals(normals: np.ndarray, bits: int) -> np.ndarray:
    """(3, N) unit vectors as `bits` for each octahedral coordinate give them back."""
    half_range = 2 ** (bits - 1) - 1
    return from_octahedral(signed_codes(octahedral(normals), half_range) / half_range - 1)


def near_halves(scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where rounding may go either way: how far from the middle of two whole numbers, and what that is a part of."""
    return np.abs(scaled - np.floor(scaled) - 0.5), np.abs(scaled) + 1


def byte_triples(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Whole numbers."""
    return [np.floor(values) for values in inputs]


DIVISIONS = "two differences, a product each above and below, the division (2.5)"

TWINS = (
    Twin(
        "packing.glsl",
        "linear_depth",
        "float",
        (DISTANCE, RANGE),
        lambda z, span: (z - span[0]) / (span[1] - span[0]),
        roundings=1 + 1 + 2.5,
        why="two differences and the division (2.5)",
        arrange=within,
    ),
    Twin(
        "packing.glsl",
        "from_linear_depth",
        "float",
        (DEPTH, RANGE),
        lambda depth, span: span[0] + depth * (span[1] - span[0]),
        roundings=3,
        why="the difference, the product and the sum",
    ),
    Twin(
        "packing.glsl",
        "linear_depth_reversed",
        "float",
        (DISTANCE, RANGE),
        lambda z, span: (span[1] - z) / (span[1] - span[0]),
        roundings=1 + 1 + 2.5,
        why="two differences and the division (2.5)",
        arrange=within,
    ),
    Twin(
        "packing.glsl",
        "from_linear_depth_reversed",
        "float",
        (DEPTH, RANGE),
        lambda depth, span: span[1] - depth * (span[1] - span[0]),
        roundings=3,
        why="the difference, the product and the difference",
    ),
    Twin(
        "packing.glsl",
        "standard_depth",
        "float",
        (DISTANCE, RANGE),
        standard_depth,
        roundings=2 + 2 + 2.5 + 1,
        why=f"{DIVISIONS}; 1 less that",
        arrange=within,
    ),
    Twin(
        "packing.glsl",
        "from_standard_depth",
        "float",
        (DEPTH, RANGE),
        from_standard_depth,
        roundings=1 + 1 + 3 + 2.5,
        why="1 − depth; near·far; below a difference, a product, a sum; the division (2.5)",
    ),
    Twin(
        "packing.glsl",
        "reversed_depth",
        "float",
        (DISTANCE, RANGE),
        lambda z, span: (1 / z - 1 / span[1]) / (1 / span[0] - 1 / span[1]),
        roundings=2 + 2 + 2.5,
        why=DIVISIONS,
        arrange=within,
    ),
    Twin(
        "packing.glsl",
        "from_reversed_depth",
        "float",
        (DEPTH, RANGE),
        lambda depth, span: from_standard_depth(1 - depth, span),
        roundings=1 + 3 + 2.5,
        why="near·far; below a difference, a product, a sum; the division (2.5)",
    ),
    Twin(
        "packing.glsl",
        "depth_code",
        "float",
        (Argument("depth", "float", uniform(0.0, 1.0), (0.0, 1.0, -0.5, 1.5)), FEW),
        depth_code,
        roundings=2,
        why="the product; codes are whole numbers below 2²⁴",
        signs=lambda depth, largest: [near_halves(np.clip(depth[0], 0, 1) * (largest[0] - 1))],
    ),
    Twin(
        "packing.glsl",
        "from_depth_code",
        "float",
        (Argument("code", "float", lambda rng, n: np.floor(logarithmic(1, 1.6e7)(rng, n)), (1.0,)), LARGEST),
        lambda code, largest: (code - 1) / (largest - 1),
        roundings=2.5,
        why="the differences are exact; the division (2.5)",
    ),
    Twin(
        "packing.glsl",
        "bytes_of",
        "vec3",
        (Argument("code", "float", whole(0, 16777215), (0.0, 65535.0, 65536.0, 16777215.0)),),
        lambda code: np.stack([code // 65536, code // 256 % 256, code % 256]),
        roundings=0.1,
        why="whole numbers below 2²⁴, divided by powers of two",
    ),
    Twin(
        "packing.glsl",
        "from_bytes",
        "float",
        (Argument("bytes", "vec3", lambda rng, n: rng.integers(0, 256, (3, n)).astype(float)),),
        lambda b: 65536 * b[0] + 256 * b[1] + b[2],
        roundings=0.1,
        why="whole numbers below 2²⁴",
    ),
    Twin(
        "packing.glsl",
        "sign_not_zero",
        "vec2",
        (Argument("v", "vec2", uniform(-1, 1, 2), ((0.0, 0.0), (1.0, -1.0))),),
        lambda v: np.where(v >= 0, 1.0, -1.0),
        roundings=0.1,
        why="nothing is computed",
    ),
    Twin(
        "packing.glsl",
        "octahedral",
        "vec2",
        (Argument("n", "vec3", direction, ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.6, 0.0, -0.8), (-0.8, 0.6, 0.0))),),
        octahedral,
        roundings=2 + 2.5 + 1,
        why="the sum of three, the division (2.5), and folded 1 − |p|",
        cancels=1.0,
    ),
    Twin(
        "packing.glsl",
        "from_octahedral",
        "vec3",
        (Argument("e", "vec2", uniform(-1, 1, 2), ((0.0, 0.0), (1.0, 1.0), (-1.0, 1.0), (0.5, -0.5))),),
        from_octahedral,
        roundings=2 + 1 + 3 + 2 + 1,
        why="two differences, 1 − |e|, a square (3), inversesqrt (2) and the product",
        cancels=1.0,
    ),
    Twin(
        "packing.glsl",
        "signed_codes",
        "vec2",
        (Argument("x", "vec2", uniform(-1.1, 1.1, 2), ((0.0, 0.0), (1.0, -1.0), (-1.5, 1.5))), HALF_RANGE),
        signed_codes,
        roundings=2,
        why="the product; codes are whole numbers below 2¹⁶",
        signs=lambda x, half_range: [near_halves(c * half_range[0]) for c in np.clip(x, -1, 1)],
    ),
    Twin(
        "packing.glsl",
        "from_signed_codes",
        "vec2",
        (Argument("codes", "vec2", uniform(0, 254, 2), ((127.0, 127.0),)), HALF_RANGE),
        lambda codes, half_range: (codes - half_range) / half_range,
        roundings=1 + 2.5,
        why="the difference and the division (2.5)",
        arrange=byte_triples,
    ),
    Twin(
        "packing.glsl",
        "bytes_of_pair",
        "vec3",
        (Argument("codes", "vec2", lambda rng, n: rng.integers(0, 4096, (2, n)).astype(float), ((4095.0, 4095.0),)),),
        lambda c: np.stack([c[0] // 16, c[0] % 16 * 16 + c[1] // 256, c[1] % 256]),
        roundings=0.1,
        why="whole numbers below 2¹², divided by powers of two",
    ),
    Twin(
        "packing.glsl",
        "pair_from_bytes",
        "vec2",
        (Argument("bytes", "vec3", lambda rng, n: rng.integers(0, 256, (3, n)).astype(float)),),
        lambda b: np.stack([b[0] * 16 + b[1] // 16, b[1] % 16 * 256 + b[2]]),
        roundings=0.1,
        why="whole numbers below 2¹²",
    ),
    Twin(
        "srgb_curve.glsl",
        "srgb_decode",
        "vec3",
        (Argument("code", "vec3", uniform(0.0, 1.0, 3), ((0.0, 1.0, 0.5), (0.04045, 0.0404, 0.0405))),),
        srgb_decode,
        roundings=2 + 13 + 7 + 2,
        why="a sum and a division (2.5) before pow: log2 3 ulp of at most 4.6 (14 eps) times 2.4 ln 2, exp2 3 + 2·4.6, "
        "the product between; as in srgb_encode, and one for the exponent's own rounding",
    ),
)
