"""Float64 twins of what techniques for reflections share."""

import numpy as np

from lightmeter.scenes.optics import frames, microfacet
from lightmeter.scenes.optics.material import MaterialPoint

from ..shared_twins import alpha, color, cosine, stack, towards, unit
from ..twin import Argument, Twin, direction, logarithmic, uniform


def visible_normal(v, a, u1, u2):
    """Heitz 2018, listing 1."""
    return microfacet.sample_visible_normal(v, a, u1, u2, stack)


def _upper(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Views above the surface."""
    v, *rest = inputs
    return [stack(v[0], v[1], np.abs(v[2])), *rest]


def shadowed_share(n_dot_v, n_dot_l, a):
    """G2/G1 by the height-correlated G2."""
    a2 = a * a
    masked = 2 * n_dot_v / (n_dot_v + np.sqrt(n_dot_v * n_dot_v * (1 - a2) + a2))
    return 4 * n_dot_v * n_dot_l * microfacet.v_smith_ggx_correlated(n_dot_v, n_dot_l, a) / masked


def ambient_base(base_color, metallic, specular, n_dot_v):
    """The base's albedo, less what the dielectric mirrors at the viewer's angle."""
    point = MaterialPoint(base_color, metallic, 1.0, specular)
    return (1 - microfacet.f_schlick(n_dot_v, 0.04 * specular, specular)) * point.diffuse


def basis(n):
    """(s, t) of Duff et al. 2017."""
    return frames.basis(n, stack)


def towards_wall(point, way, low, high, centre):
    """Where a ray leaves a box that it is in, from the centre."""
    with np.errstate(divide="ignore", invalid="ignore"):
        exits = np.where(way > 0, (high - point) / way, (low - point) / way)
    exits = np.where(way == 0, np.inf, exits)
    return point + way * np.min(exits, axis=0) - centre


def _inside(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A point and a centre in the box, and a direction along no axis to within 10⁻⁶."""
    _point, way, low, high, _centre = inputs
    way = np.where(np.abs(way) < 1e-6, 1e-6, way)
    where = rng.uniform(0.02, 0.98, (2, *low.shape))
    return [low + where[0] * (high - low), way, low, high, low + where[1] * (high - low)]


def inside_share(start, end, size):
    """The share of a segment that stays within 0…size."""
    way = end - start
    limit = np.where(way > 0, size, 0.0)
    shares = np.where(np.abs(way) < 1e-6, 1.0, (limit - start) / np.where(way == 0, 1.0, way))
    return np.clip(np.min(shares, axis=0), 0, 1)


def depth_at(share, depth_over, over_depth):
    """Depth/w over 1/w, each linear."""
    return ((1 - share) * depth_over[0] + share * depth_over[1]) / ((1 - share) * over_depth[0] + share * over_depth[1])


def visible_length(depth, change, least, reach):
    """Where depth + length·change is `least`, within 0…reach."""
    length = np.divide(least - depth, change, out=np.full_like(depth, np.inf), where=change < 0)
    return np.where(change < 0, np.clip(length, 0, reach), reach)


def exit_share(start, way, low, high):
    """Where a ray leaves a rectangle."""
    limit = np.where(way > 0, high, low)
    return np.min((limit - start) / way, axis=0)


def _in_cell(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A start before the cell and a way through it; no component is as small as what counts as none."""
    start, way, low, _high = inputs
    way = np.where(np.abs(way) < 1e-3, 1e-3, way)
    return [start, way, low, low + rng.choice([1.0, 4.0, 16.0], low.shape[1])]


def _on_screen(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A start on the screen, and a segment that is not a rounding long along either axis."""
    start, end, size = inputs
    start = start * size
    way = end - start
    return [start, start + np.where(np.abs(way) < 0.01, 0.01, way), size]


BOX = (
    Argument("point", "vec3", uniform(-1, 1, 3)),
    Argument("direction", "vec3", direction),
    Argument("low", "vec3", uniform(-5, -1, 3)),
    Argument("high", "vec3", uniform(1, 5, 3)),
    Argument("centre", "vec3", uniform(-1, 1, 3)),
)

TWINS = (
    Twin(
        "visible_lobe.glsl",
        "visible_normal",
        "vec3",
        (towards("v"), alpha("alpha"), unit("u1"), unit("u2")),
        visible_normal,
        roundings=1 + 4 + 3 + 4 + 3 + 6 + 4,
        why="α·v (1), normalized (4), t1 (3), sine and cosine of 2π·u (llvmpipe: 4), p1 and p2 (3), p3 by a difference "
        "that cancels (6), the sum normalized (4)",
        arrange=_upper,
        cancels=1.0,
        guards=("1e-6",),
    ),
    Twin(
        "visible_lobe.glsl",
        "shadowed_share",
        "float",
        (cosine("n_dot_v"), cosine("n_dot_l"), alpha("alpha")),
        shadowed_share,
        roundings=6 + 6 + 4,
        why="V (6), the sum with a root (6), two products and a power of two (4)",
    ),
    Twin(
        "visible_lobe.glsl",
        "ambient_base",
        "vec3",
        (color("base_color"), unit("metallic"), unit("specular"), cosine("n_dot_v")),
        ambient_base,
        roundings=1 + 5 + 2 + 2,
        why="F0 (1), Schlick (5), 1 − F and the product (2), c_diff (2)",
        cancels=1.0,
    ),
    Twin(
        "visible_lobe.glsl",
        "basis",
        "vec3",
        (towards("n"), Argument("t", "vec3", out=True)),
        basis,
        roundings=1 + 2.5 + 3 + 1,
        why="the sum (1), the division (2.5), three products, the sum",
        cancels=1.0,
    ),
    Twin(
        "cube_box.glsl",
        "towards_wall",
        "vec3",
        BOX,
        towards_wall,
        roundings=1 + 2.5 + 1 + 2,
        why="the difference (1), the division (2.5), the product, two sums",
        arrange=_inside,
        cancels=5.0,
    ),
    Twin(
        "screen_rays.glsl",
        "inside_share",
        "float",
        (
            Argument("start", "vec2", uniform(0, 1, 2)),
            Argument("end", "vec2", uniform(-2000, 3000, 2)),
            Argument("size", "vec2", uniform(100, 1000, 2)),
        ),
        inside_share,
        roundings=2 + 2.5,
        why="two differences, the division (2.5)",
        arrange=_on_screen,
    ),
    Twin(
        "screen_rays.glsl",
        "depth_at",
        "float",
        (
            unit("share"),
            Argument("depth_over", "vec2", uniform(0.5, 2.0, 2)),
            Argument("over_depth", "vec2", logarithmic(1e-2, 10.0, 2)),
        ),
        depth_at,
        roundings=3 + 3 + 2.5,
        why="two mixes (3 each), the division (2.5)",
    ),
    Twin(
        "screen_rays.glsl",
        "visible_length",
        "float",
        (
            Argument("depth", "float", uniform(0.1, 20.0)),
            Argument("change", "float", uniform(-1.0, 1.0)),
            Argument("least", "float", uniform(0.01, 0.1)),
            Argument("reach", "float", uniform(1.0, 50.0)),
        ),
        visible_length,
        roundings=1 + 2.5,
        why="the difference (1), the division (2.5)",
    ),
    Twin(
        "screen_rays.glsl",
        "exit_share",
        "float",
        (
            Argument("start", "vec2", uniform(0, 100, 2)),
            Argument("way", "vec2", uniform(-500, 500, 2)),
            Argument("low", "vec2", lambda rng, n: rng.integers(0, 100, (2, n)).astype(np.float64)),
            Argument("high", "vec2", uniform(0, 100, 2)),
        ),
        exit_share,
        roundings=1 + 2.5,
        why="the difference (1), the division (2.5)",
        arrange=_in_cell,
        guards=("1e-6", "3.4e38"),
    ),
)
