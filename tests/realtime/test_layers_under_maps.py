"""Layers of materials under an environment map: the split sum's coat, sheen and grain."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.dressing import dressed
from lightmeter.scenes.model import Environment, Material, Scene, Shape, Texture
from lightmeter.scenes.optics import environment as optics
from lightmeter.scenes.optics import sheen

from .small_scenes import camera, image, renderer, scene_of
from .test_costs import counted
from .test_environments import WHITE_MAP, directional

SMALL = {"size": 64, "levels": 4, "samples": 16}
WHITE = {"base_color": (1.0, 1.0, 1.0), "specular": 0.0}
BLACK = {"base_color": (0.0, 0.0, 0.0), "specular": 0.0}
BRUSHED = {"base_color": (1.0, 1.0, 1.0), "metallic": 1.0}
SIDES = directional(lambda d: np.where(d[0] > 0, 2.0, 0.5), 128)


def ball(environment: Environment = WHITE_MAP, **given) -> Scene:
    """A dressed ball, its grain along the horizon."""
    mesh, made, _ = dressed(shapes.sphere(0.9, segments=48, rings=24), Material("ball", **given))
    return replace(scene_of(Shape("ball", mesh, made), view=camera()), environment=environment)


def lit(device, scene: Scene, frame=(24, 24), **settings):
    """(n, 3) float64: `environment` of the split sum where something is seen; its points."""
    choice = Choice(only=("split_sum",), settings={"split_sum": SMALL | settings})
    made = renderer(device, scene, frame, choice).capture()
    points = made.points
    seen = points.hit & (np.sum(points.normal * points.view, axis=-1) > 0.05)
    return made.frame["environment"][seen].astype(np.float64), points.at(seen)


@pytest.mark.parametrize("layers", [
    {"clearcoat": 1.0, "clearcoat_roughness": 0.0},
    {"clearcoat": 0.6, "clearcoat_roughness": 0.7},
    {"sheen_color": (1.0, 1.0, 1.0), "sheen_roughness": 0.5},
    {"sheen_color": (1.0, 1.0, 1.0), "sheen_roughness": 0.8, "clearcoat": 1.0, "clearcoat_roughness": 0.4},
])  # fmt: skip
def test_white_under_layers_is_white_in_a_furnace(device, layers):
    """A layer takes from what lies below as much as it returns of white light from everywhere. To the sums' rounding,
    as of the white base without layers (test_environments.py)."""
    made, _ = lit(device, ball(**WHITE, **layers))
    np.testing.assert_allclose(made, 1.0, atol=np.pi**2 / (24 * 256**2) + 768 * 2**-24)


def test_a_polished_coat_mirrors_the_map_sharply(device):
    """Over black: F(n·v) times the map along the mirror direction, on either side of an edge in the map. Nearer
    than 8° nothing is said: the cube's texels are 1.4° wide, and a direction of the lobe stands for as much. Beyond,
    GGX of α = 10⁻³ has α²/(α² + tan² 4°) = 2·10⁻⁴ of its facets, half of them across the edge, where the map is 4 times
    as bright: 3·10⁻⁴. Float32's cosine and the map's bilinear texels are within the rest."""
    made, points = lit(device, ball(SIDES, **BLACK, clearcoat=1.0, clearcoat_roughness=0.0), frame=(32, 32))
    normal, view = points.normal.astype(float), points.view.astype(float)
    cosine = np.sum(normal * view, axis=-1)
    mirror = 2 * cosine[:, None] * normal - view
    clear = np.abs(mirror[:, 0]) > np.sin(np.radians(8))
    expected = (0.04 + 0.96 * (1 - cosine) ** 5) * optics.radiance(SIDES, mirror.T)[0]
    assert clear.sum() > 100 and len(np.unique(np.round(optics.radiance(SIDES, mirror[clear].T)[0], 3))) == 2
    np.testing.assert_allclose(made[clear, 0], expected[clear], rtol=2e-3)


def test_a_coat_takes_four_percent_straight_on(device):
    """And its base is dimmed by as much: 0.04 + 0.96·0.5, at n·v > 0.99 where (1 − n·v)⁵ is below 1e-10."""
    made, points = lit(device, ball(base_color=(0.5, 0.5, 0.5), specular=0.0, clearcoat=1.0))
    middle = np.sum(points.normal * points.view, axis=-1) > 0.99
    np.testing.assert_allclose(made[middle], 0.04 + 0.96 * 0.5, atol=1e-4)


def test_a_rough_coat_shows_its_own_roughness(device):
    """Blurred where the polished one is sharp, whatever the base's."""
    sharp, blurred = (
        lit(device, ball(SIDES, **BLACK, roughness=0.2, clearcoat=1.0, clearcoat_roughness=r))[0] for r in (0.0, 1.0)
    )
    assert np.ptp(blurred[:, 0] / sharp[:, 0]) > 0.5


def test_a_sheen_returns_its_albedo_of_the_irradiance(device):
    """Over black under a uniform map: color·E."""
    made, points = lit(device, ball(**BLACK, sheen_color=(1.0, 0.5, 0.0), sheen_roughness=1.0))
    cloth = sheen.Sheen(np.ones((3, 1)), np.ones(1), sheen.albedo_table().ravel())
    cosine = np.sum(points.normal * points.view, axis=-1)
    expected = sheen.albedo(cloth, cosine)[:, None] * np.array((1.0, 0.5, 0.0))
    np.testing.assert_allclose(made, expected, atol=1e-3)


@pytest.mark.parametrize("grain", ["round", "bent"])
def test_no_strength_is_no_grain_bit_for_bit(device, grain):
    """A texel of 0 leaves the layer and takes its strength. Roughness is a texture's, in a buffer with and without: the
    compiler folds a constant's products, and rounds them otherwise than the device."""
    nothing = Texture(image([[[255, 128, 0]]]))
    steel = BRUSHED | {"metallic_roughness_texture": Texture(image([[[0, 100, 255], [0, 60, 255]]]))}
    grained = ball(SIDES, **steel, anisotropy=0.9, anisotropy_texture=nothing)
    assert "grain" in grained.shapes[0].material.layers
    made = [lit(device, scene, grain=grain)[0] for scene in (grained, ball(SIDES, **steel))]
    assert np.array_equal(*made)


def test_a_full_grain_is_as_round_as_its_solid_angle(device):
    """α_t = 1 and α_b = r²: a round lobe of α = r, of roughness √r."""
    grained, plain = (
        lit(device, ball(SIDES, **BRUSHED, **given))[0]
        for given in ({"roughness": 0.36, "anisotropy": 1.0}, {"roughness": 0.6})
    )
    np.testing.assert_allclose(grained, plain, rtol=1e-5)


def test_a_bent_lobe_does_not_turn_along_the_grain(device):
    """On the horizon the grain and the normal span the plane of the view: the polished brushed ball shows what is
    behind the camera all along, where the round lobe's turns with the normal."""
    around = directional(lambda d: 1.5 + d[0])
    spread = {}
    for grain in ("round", "bent"):
        made, points = lit(device, ball(around, **BRUSHED, roughness=0.05, anisotropy=1.0), grain=grain)
        row = (np.abs(points.normal[:, 1]) < 0.06) & (np.abs(points.normal[:, 0]) < 0.8)
        spread[grain] = np.ptp(made[row, 0])
    # r's turn about the grain's bitangent is of second order in the normal's height, 0.06, and in what is kept, 0.05⁴.
    assert spread["bent"] < 0.02 < 0.2 < spread["round"]


def test_layers_cost_a_lookup_and_nothing_else():
    """No shader, texture or draw for a coat that is the same everywhere; a sheen has its table."""
    choice = Choice(only=("split_sum",), settings={"split_sum": SMALL})
    plain, coated, cloth = (
        counted(ball(**WHITE, **given), choice)[1]
        for given in ({}, {"clearcoat": 1.0}, {"sheen_color": (1.0, 1.0, 1.0)})
    )
    assert coated == plain
    assert cloth == plain | {"textures": plain["textures"] + 1}
