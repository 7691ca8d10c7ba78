"""Twins of the shared shading functions: `scenes/optics` with NumPy float64."""

import numpy as np

from lightmeter.scenes.optics import (
    anisotropy,
    arrays,
    clear_coat,
    environment,
    frames,
    lights,
    material,
    microfacet,
    sheen,
)

from .twin import Argument, Brdf, Twin, direction, logarithmic, uniform

CORNERS = ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (1.0, 0.0, 0.0))


def unit(name: str, boundary: tuple[float, ...] = (0.0, 1.0)) -> Argument:
    """A scalar in 0…1."""
    return Argument(name, "float", uniform(0.0, 1.0), boundary)


def color(name: str) -> Argument:
    """A reflectance, 0…1 per channel."""
    return Argument(name, "vec3", uniform(0.0, 1.0, 3), CORNERS)


def cosine(name: str) -> Argument:
    """A positive cosine, grazing ones as often as steep ones."""
    return Argument(name, "float", logarithmic(1e-7, 1.0), (1e-7, 0.5, 1.0))


def alpha(name: str) -> Argument:
    """GGX's α from the smallest one up."""
    return Argument(name, "float", logarithmic(1e-3, 1.0), (1e-3, 1.0))


def towards(name: str) -> Argument:
    """A unit vector."""
    return Argument(name, "vec3", direction, ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0)))


def stack(*components: np.ndarray) -> np.ndarray:
    """A vector of its components."""
    return np.stack(np.broadcast_arrays(*components))


def point(base_color, metallic, roughness, specular) -> material.MaterialPoint:
    """A material in the order of the GLSL's arguments."""
    return material.MaterialPoint(base_color, metallic, roughness, specular)


def any_point(**given) -> material.MaterialPoint:
    """A material of which only some parameters matter."""
    return material.MaterialPoint(**({"base_color": 0.0, "metallic": 0.0, "roughness": 0.0, "specular": 0.0} | given))


def brdf(base_color, metallic, roughness, specular, n, v, l):  # noqa: E741 (l: light, as in the field)
    """f(v, l)·(n·l) of the whole material."""
    return material.evaluate(point(base_color, metallic, roughness, specular), n, v, l)


MATERIAL_AND_DIRECTIONS = (
    color("base_color"),
    unit("metallic"),
    unit("roughness", (0.0, 0.03, 0.031622, 0.04, 1.0)),
    unit("specular"),
    towards("n"),
    towards("v"),
    towards("l"),
)
"""What a BRDF takes."""
REFLECTED = Brdf()
"""f·(n·l) of n, v and l."""
MASKING = Brdf("n_dot_v", "n_dot_l", normal=None, cosine=False, whole=False)
"""A masking V of two cosines."""


def half_cosines(n, v, l):  # noqa: E741
    """(n·h, |n × h|², v·h) as a vector."""
    return stack(*microfacet.half_cosines(n, v, l))


def apart(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """v and l no nearer to opposite than 0.02 of a turn's cosine: there the half vector is made of rounding."""
    n, v, light = inputs
    return [n, v, np.where(np.sum(v * light, axis=0) < -0.98, -light, light)]


def lit_signs(n, v, l):  # noqa: E741
    """The two cosines that decide between light and none."""
    return [(np.sum(n * d, axis=0), np.sum(np.abs(n * d), axis=0)) for d in (v, l)]


def above(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """The last three are n, v, l: both are turned to n's side, and a fifth of each along the surface, to 1e-4."""
    *others, n, v, light = inputs
    turned = []
    for direct in (v, light):
        cosine = np.sum(n * direct, axis=0)
        along = direct - cosine * n + 1e-9 * np.roll(n, 1, axis=0)  # straight above there is no direction beside n
        along = along - n * np.sum(n * along, axis=0) / np.maximum(np.sum(n * n, axis=0), 1e-300)  # what rounding left
        grazing = rng.random(len(cosine)) < 0.2
        raised = np.where(grazing, logarithmic(1e-4, 1e-1)(rng, len(cosine)), np.maximum(np.abs(cosine), 1e-4))
        turned.append(along / np.linalg.norm(along, axis=0) * np.sqrt(1 - raised**2) + raised * n)
    return [*others, n, *turned]


def specular_lobe(base_color, metallic, roughness, specular, n, v, l):  # noqa: E741
    """F·D·V·(n·l): the whole material less its base, f(base) = (1 − F_d)·c_diff/π·(n·l)."""
    material_point = point(base_color, metallic, roughness, specular)
    n_dot_v, n_dot_l = np.sum(n * v, axis=0), np.sum(n * l, axis=0)
    n_dot_h, sin2_h, v_dot_h = microfacet.half_cosines(n, v, l)
    d = microfacet.d_ggx(n_dot_h, sin2_h, material_point.alpha)
    visible = microfacet.v_smith_ggx_correlated(
        np.maximum(n_dot_v, 1e-7), np.maximum(n_dot_l, 1e-7), material_point.alpha
    )
    fresnel = microfacet.f_schlick(v_dot_h, material_point.f0, material_point.f90)
    return np.where((n_dot_v > 0) & (n_dot_l > 0), fresnel * d * visible * n_dot_l, 0)


def diffuse_lobe(base_color, metallic, specular, v, l):  # noqa: E741
    """(1 − F_d)·c_diff/π, F_d the dielectric's."""
    v_dot_h = np.sum(v * arrays.normalize(v + l), axis=0)
    above = microfacet.f_schlick(v_dot_h, material.DIELECTRIC_F0 * specular, specular)
    return (1 - above) * point(base_color, metallic, 1.0, specular).diffuse / np.pi


def near_the_mirror(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Half of the lanes get a half vector within the lobe, at angles from 1e-5 to 1; a third looks along the surface.

    Evenly drawn directions would hardly ever meet the lobe of a small α.
    """
    base_color, metallic, roughness, specular, n, v, light = inputs
    count = len(metallic)
    grazing = rng.random(count) < 0.3
    tilt = logarithmic(1e-6, 1e-1)(rng, count) * np.sign(rng.uniform(-0.3, 1, count))
    along = v - n * np.sum(n * v, axis=0)
    length = np.linalg.norm(along, axis=0)
    v = np.where(grazing & (length > 0), along / np.where(length > 0, length, 1) + tilt * n, v)
    v = v / np.linalg.norm(v, axis=0)
    v = np.where((np.sum(n * v, axis=0) < 0) & ~grazing & (rng.random(count) < 0.8), -v, v)
    h = n + logarithmic(1e-5, 1.0)(rng, count) * direction(rng, count)
    h = h / np.linalg.norm(h, axis=0)
    mirrored = 2 * np.sum(v * h, axis=0) * h - v
    light = np.where(rng.random(count) < 0.7, mirrored, light)
    return [base_color, metallic, roughness, specular, n, v, light / np.linalg.norm(light, axis=0)]


def brdf_signs(_base_color, _metallic, _roughness, _specular, n, v, light):
    """The two cosines that decide between light and none."""
    return lit_signs(n, v, light)


def light_towards(light_position, at):
    """1/d² and the direction, in the order of the GLSL's result and out argument."""
    to_light, inverse_square = lights.from_position(light_position, at)
    return inverse_square, to_light


def spot(cos_angle, cos_inner, cos_outer):
    """The falloff from cosines; cos(arccos x) is x to 1e-16."""
    return lights.spot_attenuation(cos_angle, np.arccos(cos_inner), np.arccos(cos_outer))


def window(inverse_square, inverse_range_square):
    """The window from the range's inverse square; 0 is no range."""
    return np.maximum(1 - (inverse_range_square / np.maximum(inverse_square, 1e-18)) ** 2, 0)


def transformed(uv, row_u, row_v):
    """Two rows times (u, v, 1)."""
    return stack(row_u[0] * uv[0] + row_u[1] * uv[1] + row_u[2], row_v[0] * uv[0] + row_v[1] * uv[1] + row_v[2])


def cone_around(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Inner cosine above the outer one."""
    cos_angle, first, second = inputs
    return [cos_angle, np.maximum(first, second), np.minimum(first, second)]


def unit_length(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A cosine that leaves nothing of a unit vector out: where both it and the sine vanish there is no D."""
    n_dot_h, sin2_h, a = inputs
    return [np.maximum(n_dot_h, np.sqrt(1 - sin2_h)), sin2_h, a]


def of_one_angle(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Half the lanes by the sine, half by the cosine; and exponents that leave something of most powers."""
    cosine, sin2, exponent = inputs
    by_sine = rng.random(len(cosine)) < 0.5
    cosine = np.where(by_sine, np.sqrt(1 - sin2), cosine)
    sin2 = np.where(by_sine, sin2, 1 - cosine**2)
    highest = 20 / np.maximum(-np.log(np.maximum(cosine, 1e-12)), 1e-6)
    return [cosine, sin2, np.where(rng.random(len(cosine)) < 0.8, np.minimum(exponent, highest), exponent)]


def brightest_at_grazing(_rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """F90 at least F0, as every material here has it: 0.04·s·(1 − m) + b·m ≤ s·(1 − m) + m.

    Else f90 − f0 would cancel and no count of roundings would hold.
    """
    v_dot_h, f0, f90 = inputs
    return [v_dot_h, np.minimum(f0, f90), np.maximum(f0, f90)]


def coat(factor, roughness, normal) -> clear_coat.Coat:
    """A coat in the order of the GLSL's arguments."""
    return clear_coat.Coat(factor, roughness, normal)


def above_the_mirror(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """As `near_the_mirror`, of a roughness, n, v and l, whatever stands before them."""
    *others, roughness, n, v, light = inputs
    unused = np.zeros_like(roughness)
    *_, n, v, light = near_the_mirror(rng, [unused, unused, roughness, unused, n, v, light])
    return [*others, roughness, n, v, light]


def across_normal(grain: np.ndarray, n: np.ndarray) -> np.ndarray:
    """The grain laid across the normal; beside it where the two agree."""
    grain = grain - n * np.sum(n * grain, axis=0)
    grain = np.where(np.linalg.norm(grain, axis=0) > 1e-3, grain, frames.basis(n, stack)[0])
    return grain / np.linalg.norm(grain, axis=0)


def with_grain(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A grain across the normal, light near the mirror, and both directions above the surface."""
    roughness, strength, grain, n, v, light = inputs
    unused = np.zeros_like(roughness)
    *_, n, v, light = above(rng, near_the_mirror(rng, [unused, unused, roughness, unused, n, v, light]))
    return [roughness, strength, across_normal(grain, n), n, v, light]


def along_grain(tangent, bitangent_sign, normal, shading_normal, grain):
    """The direction of the grain, of a pair."""
    return frames.along_grain(tangent, bitangent_sign, normal, shading_normal, grain[0], grain[1], stack)


def leaning_tangents(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """The tangent across the normal, the shading normal within a radian of it: else next to nothing is left."""
    tangent, bitangent_sign, normal, shading_normal, grain = inputs
    tangent = across_normal(tangent, normal)
    shading_normal = normal + 0.5 * shading_normal
    length = np.maximum(np.linalg.norm(grain, axis=0), 0.05)
    return [tangent, bitangent_sign, normal, shading_normal / np.linalg.norm(shading_normal, axis=0), grain / length]


def d_ggx_anisotropic(h, along, across_it):
    """D of the half vector's components."""
    return anisotropy.d_ggx(h[0], h[1], h[2], along, across_it)


def with_grain_seen(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A grain across the normal, seen from above the surface."""
    roughness, strength, grain, n, v = inputs
    n, v, _ = above(rng, [n, v, v])
    return [roughness, strength, across_normal(grain, n), n, v]


def bent_normal(roughness, strength, grain, n, v):
    """What v has in the plane of the grain and n, mixed with n."""
    kept = (1 - strength * (1 - roughness)) ** 4
    in_plane = grain * np.sum(grain * v, axis=0) + n * np.sum(n * v, axis=0)
    return np.where(strength > 0, arrays.normalize(in_plane * (1 - kept) + n * kept), n)


def round_roughness(roughness, strength):
    """(α_t·α_b)^¼."""
    along, across_it = anisotropy.alphas(anisotropy.Grain(strength, strength), roughness**2)
    return np.where(strength > 0, (along * across_it) ** 0.25, roughness)


GRAIN_LOBE_ROUNDINGS = 1 + 3 + 2 + 1 + 3 + (2 * (2.5 + 3) + 4 + 2.5) + (3 + 3 + 3 + 1 + 1 + 2.5) + 2
"""v + l, its square (3), inversesqrt (2) and the product, the components (3); D: two ratios and their squares' sum, all
squared, three products and the division; masking: the stretched vector (3), its length (3 + 3), a product, a sum and
the division; both times ½."""

COAT_LOBE_ROUNDINGS = 1 + 3 + 3 + 2 + 3 + 16 + 12.5 + 3
"""The half vector (12), D (16), V (12.5), n·l and its products (3)."""

CURVE_ROUNDINGS = 2 + 3 + 8 + 2 + 2.5 + 3
"""t (2), the coefficients (3), x to the power of c (8), 1 + b·…(2), the division (2.5), d·x + e (3)."""
SHEEN_ROUNDINGS = 3 * CURVE_ROUNDINGS + 2 + 3
"""Λ: three curves at most, their sum (2), exp (3); that of the exponent stands in the derivatives."""


def white_sheen(roughness) -> sheen.Sheen:
    """A sheen whose lobe alone matters."""
    return sheen.Sheen(0.0, roughness, None)


def under_open_sky(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A roughness of 0.3 and more, whose D is no power beyond float32, and directions above the surface."""
    roughness, n, v, light = inputs
    return [0.3 + 0.7 * roughness, *above(rng, [n, v, light])]


def sheen_scaling(color, albedo_v, albedo_l):
    """What is left of the base."""
    return np.maximum(1 - color.max(axis=0) * np.maximum(albedo_v, albedo_l), 0)


TWINS = (
    Twin(
        "brdf.glsl",
        "half_cosines",
        "vec3",
        (towards("n"), towards("v"), towards("l")),
        half_cosines,
        roundings=1 + 3 + 3 + 2 + 3,
        why="v + l; its square (3); inversesqrt (2) and the product; n × h (2) and its square (3)",
        arrange=apart,
    ),
    Twin(
        "cosine_power.glsl",
        "cosine_power",
        "float",
        (
            cosine("cosine"),
            Argument("sin2", "float", logarithmic(1e-12, 1.0), (0.0, 0.0156249, 0.0156251, 1.0)),
            Argument("exponent", "float", logarithmic(1e-3, 2e6), (0.0, 1.0)),
        ),
        microfacet.cosine_power,
        roundings=7 + 4 + 1 + 3,
        why="the series (7) or log near 1 (2⁻²¹, 4 ε, and 3 ulp elsewhere), the product; exp's 3 ulp, and 2 for each 1 "
        "of its argument, which is |x·∂f/∂x| of the exponent",
        arrange=of_one_angle,
        guards=("0.015625", "0.25", "0.333333333"),
    ),
    Twin(
        "cosine_power.glsl",
        "blinn_exponent",
        "float",
        (alpha("alpha"),),
        microfacet.blinn_exponent,
        roundings=1 + 2.5 + 1,
        why="the square, the division (2.5), the difference",
        cancels=2.0,
    ),
    Twin(
        "brdf.glsl",
        "d_ggx",
        "float",
        (cosine("n_dot_h"), Argument("sin2_h", "float", logarithmic(1e-12, 1.0), (0.0, 1.0)), alpha("alpha")),
        microfacet.d_ggx,
        roundings=2 * (3 + 1 + 2.5) + 3,
        why="k: three products, a sum, a division (2.5 ulp in GLSL's specification), all twice for k²; the square, "
        "1/π and its product",
        arrange=unit_length,
    ),
    Twin(
        "brdf.glsl",
        "v_smith_ggx_correlated",
        "float",
        (cosine("n_dot_v"), cosine("n_dot_l"), alpha("alpha")),
        microfacet.v_smith_ggx_correlated,
        roundings=5 + 3 + 1 + 1 + 2.5,
        why="under the root α², 1 − α², two products and a sum; the root (1/inversesqrt: 2 + 1 ulp), the product, the "
        "sum, the division (2.5)",
        brdf=MASKING,
    ),
    Twin(
        "brdf.glsl",
        "f_schlick",
        "vec3",
        (
            Argument("v_dot_h", "float", uniform(0.0, 1.0), (0.0, 1.0, 1.0000001, -1e-7, -0.05)),
            color("f0"),
            color("f90"),
        ),
        microfacet.f_schlick,
        roundings=1 + 1 + 1 + 1 + 1 + 1 + 1,
        why="1 − v·h, m², m⁴, m⁵, f90 − f0, the product and the sum (m's error counts five times: its derivative)",
        arrange=brightest_at_grazing,
    ),
    Twin(
        "brdf.glsl",
        "diffuse_color",
        "vec3",
        (color("base_color"), unit("metallic")),
        lambda base_color, metallic: any_point(base_color=base_color, metallic=metallic).diffuse,
        roundings=2,
        why="1 − metallic and the product",
    ),
    Twin(
        "brdf.glsl",
        "reflectance_f0",
        "vec3",
        (color("base_color"), unit("metallic"), unit("specular")),
        lambda base_color, metallic, specular: (
            any_point(base_color=base_color, metallic=metallic, specular=specular).f0
        ),
        roundings=2 + 3,
        why="0.04, its product; mix: 1 − t, a product and the sum",
    ),
    Twin(
        "brdf.glsl",
        "reflectance_f90",
        "vec3",
        (unit("metallic"), unit("specular")),
        lambda metallic, specular: stack(*[any_point(metallic=metallic, specular=specular).f90] * 3),
        roundings=3,
        why="mix: 1 − t, a product and the sum",
    ),
    Twin(
        "brdf.glsl",
        "gltf_brdf",
        "vec3",
        MATERIAL_AND_DIRECTIONS,
        brdf,
        roundings=1 + 3 + 3 + 2 + 3 + 16 + 12.5 + 7 + 5 + 6,
        why="v + l; its square (3); inversesqrt (2) and the product; n × h (2) and its square (3); D (16), V (12.5), F "
        "(7) with F0 (5); and in the sum 1 − F, c_diff, 1/π, D·V, F·DV, the sum, n·l: six beyond",
        arrange=near_the_mirror,
        signs=brdf_signs,
        brdf=REFLECTED,
    ),
    Twin(
        "lobes.glsl",
        "specular_lobe",
        "vec3",
        (
            color("base_color"),
            unit("metallic"),
            unit("roughness", (0.0, 0.03, 0.031622, 0.04, 1.0)),
            unit("specular"),
            towards("n"),
            towards("v"),
            towards("l"),
        ),
        specular_lobe,
        roundings=1 + 3 + 3 + 2 + 3 + 16 + 12.5 + 7 + 5 + 3,
        why="as gltf_brdf: the half vector (12), D (16), V (12.5), F (7) with F0 (5), and three products",
        arrange=near_the_mirror,
        signs=brdf_signs,
        brdf=REFLECTED,
    ),
    Twin(
        "lobes.glsl",
        "diffuse_lobe",
        "vec3",
        (color("base_color"), unit("metallic"), unit("specular"), towards("v"), towards("l")),
        diffuse_lobe,
        roundings=1 + 3 + 3 + 2 + 1 + 7 + 5 + 1 + 2 + 3,
        why="v + l, a square (3), a scalar product (3), inversesqrt (2) and the product; F (7) with F0 (5); 1 − F, "
        "c_diff (2), 1/π and two products",
        cancels=1.0,
        brdf=Brdf(normal=None, cosine=False),
    ),
    Twin(
        "clear_coat.glsl",
        "coat_reflectance",
        "float",
        (unit("clearcoat"), Argument("n_dot_v", "float", uniform(-1.0, 1.0), (0.0, 1.0, -1.0, 1e-7))),
        lambda clearcoat, n_dot_v: clearcoat * microfacet.f_schlick(np.abs(n_dot_v), clear_coat.F0, 1.0),
        roundings=7 + 1,
        why="F (7) and the product",
        cancels=1.0,
    ),
    Twin(
        "clear_coat.glsl",
        "coat_lobe",
        "float",
        (unit("roughness", (0.0, 0.03, 0.031622, 0.04, 1.0)), towards("n"), towards("v"), towards("l")),
        lambda roughness, n, v, light: clear_coat.lobe(coat(1.0, roughness, n), v, light),
        roundings=COAT_LOBE_ROUNDINGS,
        why="see COAT_LOBE_ROUNDINGS",
        arrange=above_the_mirror,
        signs=lambda _roughness, n, v, light: lit_signs(n, v, light),
        brdf=REFLECTED,
    ),
    Twin(
        "clear_coat.glsl",
        "coated",
        "vec3",
        (
            color("base"),
            unit("clearcoat"),
            unit("roughness", (0.0, 0.03, 0.031622, 0.04, 1.0)),
            towards("n"),
            towards("v"),
            towards("l"),
        ),
        lambda base, clearcoat, roughness, n, v, light: clear_coat.over(coat(clearcoat, roughness, n), base, v, light),
        roundings=COAT_LOBE_ROUNDINGS + 3 + 8 + 3,
        why="the lobe, n·v (3), the coat's reflectance (8), mix (3)",
        arrange=above_the_mirror,
        signs=lambda _base, _clearcoat, _roughness, n, v, light: lit_signs(n, v, light),
        cancels=1.0,
        brdf=Brdf(below="base"),
    ),
    Twin(
        "anisotropy.glsl",
        "turned",
        "vec2",
        tuple(Argument(name, "vec2", uniform(-1, 1, 2), ((1.0, 0.0), (0.0, 1.0))) for name in ("by", "direction")),
        lambda by, d: stack(by[0] * d[0] - by[1] * d[1], by[1] * d[0] + by[0] * d[1]),
        roundings=2,
        why="two products and a sum",
    ),
    Twin(
        "anisotropy.glsl",
        "across",
        "vec3",
        (towards("n"),),
        lambda n: frames.basis(n, stack)[0],
        roundings=1 + 2.5 + 4,
        why="the sum, the division (2.5), the products (3) and a sum",
        cancels=1.0,
    ),
    Twin(
        "anisotropy.glsl",
        "along_grain",
        "vec3",
        (
            towards("tangent"),
            Argument("bitangent_sign", "float", lambda rng, n: rng.choice([-1.0, 1.0], n)),
            towards("normal"),
            towards("shading_normal"),
            Argument("grain", "vec2", uniform(-1, 1, 2), ((1.0, 0.0), (0.0, 1.0))),
        ),
        along_grain,
        roundings=2 + 3 + 3 + 2 + 3 + 2 + 1,
        why="the cross product (2), the sum of two products (3), n·d (3), its product and the difference, the square "
        "(3), inversesqrt (2) and the product",
        arrange=leaning_tangents,
        guards=("1e-12",),
    ),
    Twin(
        "anisotropy.glsl",
        "d_ggx_anisotropic",
        "float",
        (towards("h"), alpha("along"), alpha("across_it")),
        d_ggx_anisotropic,
        roundings=2 * (2.5 + 1 + 2) + 4 + 2.5,
        why="the ratios (2.5), their squares and sum (3), all squared; four products, the division",
    ),
    Twin(
        "anisotropy.glsl",
        "grain_lobe",
        "float",
        (
            unit("roughness", (0.0, 0.03, 0.031622, 0.04, 1.0)),
            unit("strength"),
            towards("grain"),
            towards("n"),
            towards("v"),
            towards("l"),
        ),
        lambda roughness, strength, grain, n, v, light: anisotropy.lobe(
            anisotropy.Grain(strength, grain), microfacet.alpha_from_roughness(roughness), n, v, light
        ),
        roundings=GRAIN_LOBE_ROUNDINGS,
        why="see GRAIN_LOBE_ROUNDINGS",
        arrange=with_grain,
        brdf=Brdf(cosine=False, grain="grain"),
    ),
    Twin(
        "anisotropy.glsl",
        "bent_normal",
        "vec3",
        (unit("roughness"), unit("strength"), towards("grain"), towards("n"), towards("v")),
        bent_normal,
        roundings=2 + 3 + 2 + (4 * 3 + 2) + 3 + 3 + 2 + 1,
        why="the cross product (2), b·v (3), its product and the difference, what is kept (3, to the fourth power, and "
        "two products), mix (3), the square (3), inversesqrt (2) and the product",
        arrange=with_grain_seen,
        cancels=1.0,
    ),
    Twin(
        "anisotropy.glsl",
        "round_roughness",
        "float",
        (unit("roughness"), unit("strength")),
        round_roughness,
        roundings=1 + 1 + 3 + 1 + 2 * 3,
        why="two squares, mix (3), the product, two roots (3 each)",
    ),
    Twin(
        "sheen.glsl",
        "d_charlie",
        "float",
        (
            cosine("n_dot_h"),
            Argument("sin2_h", "float", logarithmic(1e-3, 1.0), (0.9, 1.0)),
            Argument("alpha", "float", logarithmic(0.1, 1.0), (1.0,)),
        ),
        sheen.d_charlie,
        roundings=2.5 + 2 + 4 + 3 + 3,
        why="1/α (2.5), its products (2), log near 1 (4 ε), exp (3), the sum and two products",
        cancels=1.0,
        guards=("1e-30",),
    ),
    Twin(
        "sheen.glsl",
        "sheen_curve",
        "float",
        (cosine("x"), alpha("alpha")),
        sheen.curve,
        roundings=CURVE_ROUNDINGS,
        why="see CURVE_ROUNDINGS",
        cancels=5.0,
        guards=("1e-30",),
    ),
    Twin(
        "sheen.glsl",
        "sheen_shadowing",
        "float",
        (cosine("cosine"), alpha("alpha")),
        sheen.shadowing,
        roundings=SHEEN_ROUNDINGS * 17,
        why="see SHEEN_ROUNDINGS; the exponent is up to 17, and its rounding that of as many",
        guards=("0.5",),  # where the branches meet
    ),
    Twin(
        "sheen.glsl",
        "sheen_lobe",
        "float",
        (unit("roughness", (0.5, 1.0)), towards("n"), towards("v"), towards("l")),
        lambda roughness, n, v, light: sheen.lobe(white_sheen(roughness), n, v, light),
        roundings=12 + 15 + SHEEN_ROUNDINGS * 17 + 6,
        why="the half vector (12), D (15), Λ twice, the sum, products and the division (6)",
        arrange=under_open_sky,
        signs=lambda _roughness, n, v, light: lit_signs(n, v, light),
        cancels=1e-3,
        guards=("1e-6",),
        brdf=REFLECTED,
    ),
    Twin(
        "sheen.glsl",
        "sheen_scaling",
        "float",
        (color("color"), unit("albedo_v"), unit("albedo_l")),
        sheen_scaling,
        roundings=2,
        why="the product and the difference",
        cancels=1.0,
        brdf=Brdf("albedo_v", "albedo_l", normal=None, cosine=False, whole=False),
    ),
    Twin(
        "lights.glsl",
        "from_position",
        "float",
        (
            Argument("light_position", "vec3", uniform(-10, 10, 3), ((0.0, 0.0, 0.0),)),
            Argument("point", "vec3", uniform(-10, 10, 3), ((0.0, 0.0, 0.0),)),
            Argument("direction", "vec3", out=True),
        ),
        light_towards,
        roundings=1 + 3 + 2.5 + 1,
        why="the difference, a product and two sums, the division (2.5) or inversesqrt (2) and a product",
    ),
    Twin(
        "lights.glsl",
        "range_window",
        "float",
        (
            Argument("inverse_square", "float", logarithmic(1e-4, 1e4), (0.0, 1.0)),
            Argument("inverse_range_square", "float", logarithmic(1e-4, 1e4), (0.0, 1.0)),
        ),
        window,
        roundings=2.5 + 1 + 1,
        why="the division (2.5), the square and the difference",
        cancels=1.0,
    ),
    Twin(
        "lights.glsl",
        "spot_attenuation",
        "float",
        (
            Argument("cos_angle", "float", uniform(-1, 1), (-1.0, 0.0, 0.5, 1.0)),
            Argument("cos_inner", "float", uniform(-1, 1), (1.0, 0.5, 0.0)),
            Argument("cos_outer", "float", uniform(-1, 1), (0.4995, 0.5, -1.0)),
        ),
        spot,
        roundings=2 * (2 + 2.5) + 1,
        why="two differences and the division (2.5), twice for the square; the square",
        arrange=cone_around,
    ),
    Twin(
        "normal_map.glsl",
        "tangent_to_world",
        "vec3",
        (
            towards("tangent"),
            Argument("bitangent_sign", "float", lambda rng, n: rng.choice([-1.0, 1.0], n)),
            towards("normal"),
            Argument("mapped", "vec3", uniform(-1, 1, 3), ((0.0, 0.0, 1.0), (0.0, 0.0, 0.0))),
        ),
        frames.tangent_to_world,
        roundings=2 + 1 + 3 + 3 + 2 + 1,
        why="the cross product, its sign, a sum of three products (3); v² (3), inversesqrt (2) and the product",
    ),
    Twin(
        "normal_map.glsl",
        "decode_normal",
        "vec3",
        (color("texel"), Argument("scale", "float", uniform(-2, 2), (0.0, 1.0))),
        lambda texel, scale: frames.decode_normal(texel, scale, stack),
        roundings=3,
        why="2t is exact; the difference and the product, and one for a driver that fuses neither",
    ),
    Twin(
        "textures.glsl",
        "mirrored",
        "float",
        (Argument("x", "float", uniform(-5, 5), (-2.0, -1.0, 0.0, 0.5, 1.0, 2.0)),),
        lambda x: 1 - np.abs(x - 2 * np.floor(x / 2) - 1),
        roundings=4,
        why="mod: x/2 is exact, the floor's product and the difference; two differences",
        cancels=1.0,
    ),
    Twin(
        "textures.glsl",
        "transformed",
        "vec2",
        (
            Argument("uv", "vec2", uniform(-2, 2, 2), ((0.0, 0.0), (1.0, 1.0))),
            Argument("row_u", "vec3", uniform(-3, 3, 3), ((1.0, 0.0, 0.0),)),
            Argument("row_v", "vec3", uniform(-3, 3, 3), ((0.0, 1.0, 0.0),)),
        ),
        transformed,
        roundings=3,
        why="a product and two sums",
    ),
    Twin(
        "environment_map.glsl",
        "environment_coordinates",
        "vec2",
        (
            Argument("direction", "vec3", direction, ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0))),
            Argument("rotation", "float", uniform(-4, 4), (0.0,)),
        ),
        lambda d, rotation: stack(*environment.coordinates(d, rotation)),
        roundings=4096 + 4,
        why="atan, which GLSL allows 4096 units in the last place; the sum, the product and the half, and the length",
        cancels=1.0,
    ),
)
