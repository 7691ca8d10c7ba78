"""Techniques for environment maps: furnace, closed forms, quadrature, Monte Carlo, orientation, baking, the plan."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.effects.spherical_harmonics import band_weights
from lightmeter.realtime.effects.split_sum import levels
from lightmeter.realtime.environments.lobes import specular_cube
from lightmeter.realtime.environments.moments import moments
from lightmeter.realtime.environments.source import environment_source
from lightmeter.realtime.graph import Choice, Step, compile_plan
from lightmeter.realtime.shaders import source
from lightmeter.realtime.uniforms import bind, set_uniforms
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Environment, Image, Material, Shape
from lightmeter.scenes.optics import environment as optics
from lightmeter.scenes.optics import microfacet
from lightmeter.scenes.optics.albedo import directional_albedo

from .small_scenes import camera, facing, renderer, scene_of

TECHNIQUES = ("hemisphere_ambient", "spherical_harmonics", "irradiance_cube", "split_sum", "mirror_lookup")
WHITE_MAP = Environment((1.0, 1.0, 1.0), Image(np.ones((4, 8, 3), np.float32)))
MATTE = Material("matte", (1.0, 1.0, 1.0), specular=0.0)


def lit(device, material: Material, environment: Environment, name: str, frame=(24, 24), **settings):
    """(n, 3): `environment` of a ball under one technique, where the ball is seen, and its normals."""
    ball = Shape("ball", shapes.sphere(0.9, segments=48, rings=24), material)
    scene = replace(scene_of(ball, view=camera()), environment=environment)
    small = {"size": 16, "levels": 4, "samples": 64} if name == "split_sum" else {}
    choice = Choice(use=(name,), settings={name: small | settings})
    made = renderer(device, scene, frame, choice).capture()
    seen = made.points.hit & (np.sum(made.points.normal * made.points.view, axis=-1) > 0.05)
    return made.frame["environment"][seen].astype(np.float64), made.points.normal[seen].astype(np.float64)


def directional(values, height: int = 64) -> Environment:
    """A map whose radiance is a function of the directions, (3, n) to (n,)."""
    u, v = np.meshgrid((np.arange(2 * height) + 0.5) / (2 * height), (np.arange(height) + 0.5) / height)
    texels = values(np.stack(optics.direction_at(u.ravel(), v.ravel(), 0.0))).reshape(height, 2 * height, 1)
    return Environment((1.0, 1.0, 1.0), Image(np.repeat(texels, 3, axis=2).astype(np.float32)))


# Furnace: white from everywhere on what reflects everything is white.


@pytest.mark.parametrize("name", TECHNIQUES)
def test_a_white_base_is_white_in_a_furnace(device, name):
    """The base's part of every technique keeps energy. What is left is the sphere's quadrature at 256 rows, of relative
    size π²/(24·256²), and float32 sums of 256 + 512 terms."""
    made, _ = lit(device, MATTE, WHITE_MAP, name, **({"samples": 64} if name == "irradiance_cube" else {}))
    # environment_brdf's and the table's part is 0 with specular 0 and no metal: F0 = F90 = 0.
    np.testing.assert_allclose(made, 1.0, atol=np.pi**2 / (24 * 256**2) + 768 * 2**-24)


@pytest.mark.parametrize("metallic", [0.0, 1.0])
@pytest.mark.parametrize("roughness", [0.1, 0.5, 1.0])
def test_compensated_split_sum_keeps_all_energy(device, metallic, roughness):
    """Fdez-Agüera's sum is 1 by its algebra, whatever the table holds: metal, or a dielectric over a white base."""
    material = Material("white", (1.0, 1.0, 1.0), metallic=metallic, roughness=roughness)
    made, _ = lit(device, material, WHITE_MAP, "split_sum", compensation="fdez_aguera", samples=16, frame=(16, 16))
    np.testing.assert_allclose(made, 1.0, atol=1e-4)


def test_single_scattering_loses_what_it_should(device):
    """A white metal of roughness 1, uncompensated: 1 − E(n·v), by quadrature; 69 % at normal incidence (1 − ln 2)."""
    metal = Material("metal", (1.0, 1.0, 1.0), metallic=1.0, roughness=1.0)
    made, normals = lit(device, metal, WHITE_MAP, "split_sum", samples=1024, lut=64)
    exact = directional_albedo(microfacet.d_ggx, microfacet.v_smith_ggx_correlated, np.array([1.0]), normals[:, 2])
    # 1024 points of a low-discrepancy set, error some log(N)/N of an integrand up to 1; bilinear between 64 cosines.
    assert np.abs(made[:, 0] - exact).max() < 0.01
    assert made.mean() < 0.5


# Irradiance.


def lobe(axis):
    return lambda d: np.maximum(axis @ d, 0)


AXIS = np.array([0.36, 0.48, 0.8])


def under_a_cosine(cos_angle: np.ndarray) -> np.ndarray:
    """∫ max(a·ω, 0)·max(n·ω, 0) dω over π: (2/3)·(sin γ + (π − γ)·cos γ)/π."""
    angle = np.arccos(np.clip(cos_angle, -1, 1))
    return 2 / 3 * (np.sin(angle) + (np.pi - angle) * np.cos(angle)) / np.pi


@pytest.mark.parametrize("order", [2, 3])
def test_harmonics_of_a_cosine_lobe_are_the_closed_form(device, order):
    """max(cos, 0) = 1/4·P₀ + 1/2·P₁ + 5/16·P₂ + …; irradiance over π is each band times 1, 2/3, 1/4."""
    made, normals = lit(device, MATTE, directional(lobe(AXIS)), "spherical_harmonics", order=order)
    cosine = normals @ AXIS
    bands = np.stack([np.full_like(cosine, 0.25), cosine / 3, 5 / 64 * (3 * cosine**2 - 1) / 2])
    exact = np.maximum(bands[:order].sum(axis=0), 0)
    # The map has 64 rows, bilinear between: it dulls the lobe by some (π/64)²/8 of its curvature, and its kink.
    np.testing.assert_allclose(made[:, 0], exact, atol=2e-3)
    # Nine coefficients are within 1 % of the truth here (Ramamoorthi & Hanrahan 2001); four are not.
    worst = np.abs(exact - under_a_cosine(cosine)).max()
    assert worst < 0.02 if order == 3 else worst > 0.03


def test_an_irradiance_cube_meets_the_closed_form(device):
    made, normals = lit(device, MATTE, directional(lobe(AXIS)), "irradiance_cube", samples=1024)
    np.testing.assert_allclose(made[:, 0], under_a_cosine(normals @ AXIS), atol=5e-3)


def test_hemisphere_is_exact_above_and_below(device):
    sky = directional(lambda d: np.where(d[1] > 0, 2.0, 0.5))
    made, normals = lit(device, MATTE, sky, "hemisphere_ambient")
    np.testing.assert_allclose(made[:, 0], 0.5 + 1.5 * (0.5 + 0.5 * normals[:, 1]), atol=2e-3)


def test_windowed_harmonics_ring_less():
    plain, hann = band_weights(3, "none"), band_weights(3, "hann")
    assert plain[0] == hann[0] == 1.0
    assert hann[4] / plain[4] == pytest.approx(0.25) and hann[1] / plain[1] == pytest.approx(0.75)


# The two sums.


def albedos_by_quadrature(n_dot_v: float, alpha: float) -> tuple[float, float, float]:
    """Scale, bias and base's weight by brute force over the outgoing hemisphere's half vectors, float64."""
    nodes, weights = np.polynomial.legendre.leggauss(96)
    u, weight = (nodes + 1) / 2, weights / 2
    turn = 2 * np.pi * (np.arange(96) + 0.5) / 96
    v = np.array([np.sqrt(1 - n_dot_v**2), 0.0, n_dot_v])
    theta = np.arctan(alpha * np.sqrt(u / (1 - u)))[:, None]
    h = np.stack(np.broadcast_arrays(np.sin(theta) * np.cos(turn), np.sin(theta) * np.sin(turn), np.cos(theta)))
    v_dot_h = np.tensordot(v, h, 1)
    n_dot_l = 2 * v_dot_h * h[2] - n_dot_v
    lit_up = (n_dot_l > 0) & (v_dot_h > 0)
    visible = microfacet.v_smith_ggx_correlated(n_dot_v, np.where(lit_up, n_dot_l, 1), alpha)
    value = np.where(lit_up, 4 * visible * n_dot_l * v_dot_h / h[2], 0)
    edge = np.clip(1 - v_dot_h, 0, 1) ** 5
    mean = lambda f: float(np.sum(f.mean(axis=1) * weight))  # noqa: E731
    sine = np.sqrt(u)[:, None]
    away = np.stack(np.broadcast_arrays(sine * np.cos(turn), sine * np.sin(turn), np.sqrt(1 - u)[:, None]))
    half = v[:, None, None] + away
    base = (1 - np.tensordot(v, half, 1) / np.linalg.norm(half, axis=0)) ** 5
    return mean(value * (1 - edge)), mean(value * edge), mean(base)


def test_the_table_is_the_quadrature(device):
    """With N points of Hammersley's set an integrand's error is its variation, at most some 4, times log₂(N)/N at most
    (Koksma and Hlawka): 0.04 at 1024, and a fifth of that where the integrand is smooth."""
    samples, side = 1024, 4
    from lightmeter.realtime.environments.fill import fill

    shader = source("table.frag", {"SAMPLES": samples, "SIDE": side}, effects()["split_sum"].folder)
    table = device.read(fill(device, shader, (side, side), {}, {}))[::-1].astype(np.float64)
    for row in range(side):
        for column in range(side):
            n_dot_v = max(column / (side - 1), 1e-3)
            exact = albedos_by_quadrature(n_dot_v, max((row / (side - 1)) ** 2, 1e-3))
            limit = 8e-3 if column else 0.04  # at grazing views the lobe is cut by the horizon
            np.testing.assert_allclose(table[row, column, :3], exact, atol=limit)


def looked_up(device, atlas, directions: np.ndarray, level: float, side: int) -> np.ndarray:
    """(n, 3) of (n, 3) directions."""
    text = '#include "cube_atlas.glsl"\nuniform sampler2D atlas; uniform sampler2D towards; uniform float level;\n'
    text += "out vec4 found;\nvoid main() { vec3 d = texelFetch(towards, ivec2(gl_FragCoord.xy), 0).xyz;\n"
    text += f"    found = vec4(atlas_towards(atlas, d, level, {side}), 1.0); }}\n"
    program = device.program(source(text))
    given = device.gl.texture((len(directions), 1), 3, directions.astype("f4").tobytes(), alignment=1, dtype="f4")
    target = device.target((len(directions), 1))
    device.framebuffer([target]).use()
    device.gl.enable_only(device.gl.NOTHING)
    bind(program, {"atlas": atlas, "towards": given})
    set_uniforms(program, {"level": level})
    device.draw(device.fullscreen(program), 3)
    return device.read(target)[0, :, :3]


def directions(n: int, seed: int = 5) -> np.ndarray:
    found = np.random.default_rng(seed).normal(size=(n, 3))
    return found / np.linalg.norm(found, axis=1, keepdims=True)


def test_filtered_maps_meet_monte_carlo(device):
    """Against 20,000 directions of the same lobe, in float64; the map is smooth over some 30°, and a cube of 64."""
    around = directional(lambda d: 1 + d[0] * d[1] + np.maximum(d[2], 0) ** 2)
    side, count = 64, 4
    atlas = specular_cube(device, environment_source(device, around), side, count, 256, True)
    axes, rng = directions(12), np.random.default_rng(1)
    for level in range(count):
        alpha = max((level / (count - 1)) ** 2, 1e-3)
        u = rng.random((2, 20000))
        theta = np.arctan(alpha * np.sqrt(u[0] / (1 - u[0])))
        h = np.stack(
            [np.sin(theta) * np.cos(2 * np.pi * u[1]), np.sin(theta) * np.sin(2 * np.pi * u[1]), np.cos(theta)]
        )
        local = np.stack([2 * h[2] * h[0], 2 * h[2] * h[1], 2 * h[2] ** 2 - 1])
        weight = np.maximum(local[2], 0)
        exact = []
        for axis in axes:
            tangent = np.cross(axis, [0.3, 0.5, -0.8])
            tangent /= np.linalg.norm(tangent)
            d = tangent[:, None] * local[0] + np.cross(axis, tangent)[:, None] * local[1] + axis[:, None] * local[2]
            exact.append(np.sum(optics.radiance(around, d)[0] * weight) / weight.sum())
        made = looked_up(device, atlas, axes, float(level), side)[:, 0]
        # Monte Carlo: 0.6/√20000, thrice; the faces' texels of 0.2 at the last level, and directions that stand for up
        # to 0.1 sr, each blur a curvature of 2 by 0.2²/8·2 = 0.01.
        np.testing.assert_allclose(made, exact, atol=0.013 + 2 * 0.01)


def test_between_two_levels_the_lookup_is_linear(device):
    around = directional(lambda d: 2 + d[0] + d[1])
    atlas = specular_cube(device, environment_source(device, around), 32, 3, 16, True)
    towards = directions(40)
    low, high, middle = (looked_up(device, atlas, towards, level, 32) for level in (0.0, 1.0, 0.25))
    np.testing.assert_allclose(middle, 0.75 * low + 0.25 * high, rtol=1e-5)


def test_a_cube_has_no_seams(device):
    """Either side of every edge and corner, a hair apart, the same radiance: borders hold what lies beyond the edge."""
    around = directional(lambda d: 2 + d[0] + d[1] * d[2])
    side = 16
    atlas = specular_cube(device, environment_source(device, around), side, 2, 16, True)
    rng = np.random.default_rng(2)
    edge = np.sign(rng.normal(size=(200, 3)))
    edge[np.arange(200), rng.integers(0, 3, 200)] *= rng.random(200)  # two coordinates of ±1: an edge
    sides = [edge * (1 + 1e-4 * np.eye(3)[axis]) for axis in range(3)]
    made = np.stack([looked_up(device, atlas, s, 0.0, side)[:, 0] for s in sides])
    # Faces' grids differ: on a face's plane texels are h = 1/8 and the curvature is at most 3, so that bilinear is off
    # by h²/8·3 on either side. A border that repeats its edge would leave half a texel's slope, 0.06.
    assert np.ptp(made, axis=0).max() < 2 * 3 / 8 / 64


# Orientation: a marked direction.


@pytest.mark.parametrize("name", ["spherical_harmonics", "irradiance_cube", "split_sum", "mirror_lookup"])
def test_the_bright_side_is_where_the_map_says(device, name):
    """A spot about a direction, turned with the map: the ball's brightest normal looks there (mirrors: half way)."""
    rotation, seen = 0.7, np.array([0.5, 0.3, 0.6]) / np.linalg.norm([0.5, 0.3, 0.6])
    u, v = optics.coordinates(seen[:, None], rotation)
    marked = np.stack(optics.direction_at(u, v, 0.0))[:, 0]  # where the spot lies in the map as it is not turned
    spot = replace(directional(lambda d: np.exp(8 * (marked @ d - 1))), rotation=rotation)
    mirror = name in ("split_sum", "mirror_lookup")
    material = Material("m", (1.0, 1.0, 1.0), metallic=1.0, roughness=0.3) if mirror else MATTE
    made, normals = lit(device, material, spot, name, frame=(48, 48), **({"size": 64} if name == "split_sum" else {}))
    expected = seen + np.array([0.0, 0.0, 1.0]) if mirror else seen  # the camera is orthographic, along −Z
    expected /= np.linalg.norm(expected)
    brightest = normals[np.argmax(made[:, 0])]
    # A pixel of the ball's 43 across is up to 3° of its normal here, a cube's texel less; a nine-term lobe is round.
    assert np.degrees(np.arccos(np.clip(brightest @ expected, -1, 1))) < 6


# A sun.


def test_filtering_tames_a_sun(device):
    """A texel of 70,000: unfiltered directions meet it or miss it, filtered ones spread it. Both keep its energy."""
    texels = np.full((64, 128, 3), 0.5, np.float32)
    texels[20, 40] = 70000.0
    sun = Environment((1.0, 1.0, 1.0), Image(texels))
    cube = environment_source(device, sun)
    spread = {}
    for filtered in (False, True):
        atlas = specular_cube(device, cube, 32, 3, 64, filtered)
        lobes = looked_up(device, atlas, directions(2000), 2.0, 32)[:, 0]
        spread[filtered] = np.std(lobes) / np.mean(lobes)
    assert spread[True] < 0.8 * spread[False]


# Baking and the plan.


def mapped():
    ball = Shape("ball", shapes.sphere(0.5, segments=16), MATTE)
    return replace(scene_of(ball, facing(MATTE)), environment=WHITE_MAP)


def test_a_map_takes_the_split_sum_and_leaves_the_rest_to_ambient():
    plan = compile_plan(mapped(), effects())
    assert Step("split_sum", ("environment",)) in plan.steps
    assert Step("constant_ambient", ("indirect",)) in plan.steps
    assert plan.terms_of("constant_ambient") == ("indirect",)
    assert plan.effect_of("environment") == "split_sum"
    constant = compile_plan(replace(mapped(), environment=Environment((1.0, 1.0, 1.0))), effects())
    assert Step("constant_ambient", ("environment", "indirect")) in constant.steps
    assert not set(TECHNIQUES) & set(constant.effects)


def test_one_effect_may_be_asked_for_both_terms():
    plan = compile_plan(mapped(), effects(), Choice(use=("constant_ambient",)))
    assert plan.terms_of("constant_ambient") == ("environment", "indirect") and "split_sum" not in plan.effects


def test_baking_happens_once_and_frames_do_not_pay():
    device = Device()
    made = renderer(device, mapped(), (16, 16), Choice(settings={"split_sum": {"size": 16, "levels": 3, "samples": 4}}))
    baked = made.baking.milliseconds["split_sum"]
    before = device.counts["draws"]
    made.draw()
    frame = device.counts["draws"] - before
    # G-buffer (two shapes, sky), split sum, constant ambient, tone, encode.
    assert frame == 3 + 1 + 1 + 2
    textures = device.counts["textures"]
    made.capture()
    made.capture()
    assert made.baking.milliseconds == {"split_sum": baked}
    # Its G-buffer and its buffers only: a bake makes a cube of its own, two atlases, a table, the map and the sums.
    assert device.counts["draws"] - before - frame == 2 * (3 + 2)
    assert device.counts["textures"] > textures


def test_a_small_cube_has_fewer_levels(device):
    choice = Choice(settings={"split_sum": {"size": 16, "levels": 6, "samples": 4}})
    assert levels(dict(compile_plan(mapped(), effects(), choice).effects["split_sum"][1])) == 4
    assert np.isfinite(renderer(device, mapped(), (8, 8), choice).render().radiance).all()


def test_moments_do_not_depend_on_how_the_map_is_turned(device):
    """All but a map's own texels: the same sum of columns, begun elsewhere."""
    around = directional(lobe(AXIS), 32)
    text = "float basis(int index, vec3 direction) { return 1.0; }"
    plain, turned = (
        device.read(moments(device, replace(around, rotation=angle), text, (1.0,)))[0, 0, 0] for angle in (0.0, 1.0)
    )
    assert plain == pytest.approx(turned, rel=1e-5)
    assert plain == pytest.approx(np.pi, rel=5e-3)  # of a clamped cosine
