"""Effects for area lights against quadrature over the light, in float64."""

import numpy as np
import pytest

from lightmeter.realtime.effects.many_sample_light.points import light_points
from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Shape, Texture

from .area_quadrature import of_polygon, reflected
from .area_scenes import GLOW, RADIANCE, direct_of, lit_floor, turned
from .small_scenes import camera, image, moved, renderer

DIFFUSE = Material("diffuse", (0.8, 0.6, 0.4), specular=0.0)
ROUGH = Material("rough", (0.8, 0.6, 0.4), metallic=1.0, roughness=0.7)
MIRROR = Material("mirror", (1.0, 1.0, 1.0), metallic=1.0, roughness=0.0)
EFFECTS = ("area_as_point", "representative_point", "ltc_area_light", "many_sample_light")
OVER = turned((0, 0, 0), (0.3, 1.4, -0.5))
SMALL = {
    "rectangle": shapes.rectangle(0.06, 0.04),
    "disk": shapes.disk(0.03, 64),
    "sphere": shapes.sphere(0.03, 32),
}


def quadrature(points, mesh, matrix, order=2, **given):
    """What the light, as it is drawn, gives at points."""
    world = Shape("light", mesh, GLOW, matrix).world
    corners = world.positions[world.triangles].astype(np.float64)
    parts = [of_polygon(triangle, order) for triangle in corners]
    places, areas = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    return reflected(points, places, areas, RADIANCE, **given)


@pytest.mark.parametrize("material", [DIFFUSE, ROUGH], ids=["diffuse", "rough"])
@pytest.mark.parametrize("kind", SMALL)
def test_a_small_light_is_lit_with_as_a_point(device, kind, material):
    """Where a light is small its point, solid angle and horizon are all there is.

    r/d is 0.03/1 at most: cosines differ by r/d over the light, symmetrically, so that the mean is off by its square
    times the second derivative, below 10 for these lobes: 1 %. Of the lobe's peak α/(α + r/3d) is left, squared, for
    an α of 0.49: 4 % where it mirrors the light.
    """
    matrix = OVER @ np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]]) if kind == "disk" else OVER
    points, got = direct_of(device, lit_floor(material, SMALL[kind], matrix), "representative_point", size=(12, 8))
    exact = quadrature(points, SMALL[kind], matrix)
    assert exact.min() > 0
    np.testing.assert_allclose(got, exact, rtol=0.01 if material is DIFFUSE else 0.05)


@pytest.mark.parametrize("kind", ["rectangle", "sphere"])
def test_a_mirror_shows_the_light_s_own_radiance(device, kind):
    """With the widening that is made for it, seen from straight above: D·(α/α')² is 1/(π·α'²), V·(n·l) is 1/4.

    So what is left is L·Ω/(4π·α'²), α' = α + r/2d, α = 0.001. Ω = π·(r/d)² less its own second order, (r/d)² or less:
    with r/d = 0.1 that is a relative error of 2·0.001/(0.05) + 0.01 + 0.01 (the picture's middle is seen at 1.5°).
    """
    light = shapes.rectangle(0.2, 0.2) if kind == "rectangle" else shapes.sphere(0.1, 64)
    above = camera((0.02, 0.8, 0.0), (0.0, 0.0, 0.0), yfov=0.02)
    scene = lit_floor(MIRROR, light, turned((0, 0, 0), (0, 1, 0)), view=above)
    _, got = direct_of(device, scene, "representative_point", size=(4, 4), normalization="mirror")
    np.testing.assert_allclose(got, np.broadcast_to(RADIANCE, got.shape), rtol=0.06)


def test_other_shapes_keep_the_effect_that_takes_every_shape(device):
    scene = lit_floor(DIFFUSE, shapes.torus(0.3, 0.1), moved(y=1))
    plan = renderer(device, scene, (8, 8), Choice(use=("representative_point",))).plan
    assert plan.lights_of("area_as_point") == (0,) and "representative_point" not in plan.effects
    assert plan.why_absent("representative_point") == "the scene has no light of the kinds it handles"


@pytest.mark.parametrize("effect", EFFECTS)
def test_light_leaves_the_front_alone_unless_the_light_has_two_sides(device, effect):
    """A rectangle that looks away gives nothing; with two sides, what it gives turned round.

    Turned round its points lie elsewhere on it: what is made of 16 of them may differ by a tenth.
    """
    light, back = shapes.rectangle(0.4, 0.3), turned((0, 2, 0), (0, 1, 0))
    both = Material("both", (0.0, 0.0, 0.0), specular=0.0, emissive=RADIANCE, double_sided=True)
    _, dark = direct_of(device, lit_floor(DIFFUSE, light, back), effect, size=(12, 8))
    _, lit = direct_of(device, lit_floor(DIFFUSE, light, back, both), effect, size=(12, 8))
    _, front = direct_of(device, lit_floor(DIFFUSE, light, turned((0, 0, 0), (0, 1, 0))), effect, size=(12, 8))
    assert (dark == 0).all() and front.min() > 0
    np.testing.assert_allclose(lit, front, rtol=0.1 if effect == "many_sample_light" else 1e-5)


@pytest.mark.parametrize("effect", ["ltc_area_light", "many_sample_light"])
def test_a_solid_shines_with_its_outside_alone(device, effect):
    """Exporters make most materials double-sided; a lamp's far side does not shine through its near one."""
    both = Material("both", (0.0, 0.0, 0.0), specular=0.0, emissive=RADIANCE, double_sided=True)
    box, place = shapes.box(0.5, 0.4, 0.3), moved(y=1)
    _, once = direct_of(device, lit_floor(DIFFUSE, box, place), effect, size=(12, 8))
    _, twice = direct_of(device, lit_floor(DIFFUSE, box, place, both), effect, size=(12, 8))
    assert np.array_equal(once, twice) and once.max() > 0


def test_points_on_a_light_are_even_by_area_and_carry_its_power():
    """Each set: one point to a stratum of the area; weights add up to L·A; the mean is the centroid.

    The centroid of n points, one to each of n strata of a unit square halved along a diagonal, is off by less than a
    stratum's width along one axis and, the other coordinate being a rank-1 sequence, by O(log n/n): 0.02 for 256.
    """
    matrix = turned((0, 0, 0), (0.3, 1.4, -0.5))
    shape = Shape("light", shapes.rectangle(1, 1), GLOW, matrix)
    for points in light_points(shape, 256, 4).reshape(4, 256, 3, 3):
        position, normal, weight = (points[:, i] for i in range(3))
        np.testing.assert_allclose(weight.sum(axis=0), RADIANCE, rtol=1e-6)
        np.testing.assert_allclose(normal, np.broadcast_to(matrix[:3, 2], normal.shape), atol=1e-6)
        local = (position - matrix[:3, 3]) @ matrix[:3, :3]
        assert np.abs(local).max() <= 0.5 + 1e-6 and np.abs(local[:, 2]).max() < 1e-6
        assert np.abs(local.mean(axis=0)).max() < 0.02
        quarters = np.histogram2d(local[:, 0], local[:, 1], 2, [[-0.5, 0.5]] * 2)[0]
        assert np.abs(quarters - 64).max() <= 8


def test_points_shine_through_the_light_s_texture_and_not_in_its_holes():
    """Two texels: the left one emits twice as much; then the right one is a hole."""
    two = Texture(image(np.float32([[[1.0, 1, 1, 1], [0.5, 0.5, 0.5, 0.25]]]), np.float32), mag_filter="nearest")
    textured = Material("textured", emissive=RADIANCE, emissive_texture=two)
    points = light_points(Shape("light", shapes.rectangle(2, 1), textured), 64, 1).reshape(64, 3, 3)
    left = points[:, 0, 0] < 0
    each = 2 * np.array(RADIANCE) / 64
    np.testing.assert_allclose(points[:, 2], np.where(left[:, None], each, each / 2), rtol=1e-6)
    holed = Material("holed", emissive=RADIANCE, base_color_texture=two, alpha_mode="mask")
    points = light_points(Shape("light", shapes.rectangle(2, 1), holed), 64, 1).reshape(64, 3, 3)
    np.testing.assert_allclose(points[:, 2], np.where(left[:, None], each, 0), rtol=1e-6)


@pytest.mark.parametrize("light", ["rectangle", "box"])
def test_many_points_converge_to_the_light(device, light):
    """The error falls at least as 1/√n, and is below a hundredth in the end."""
    mesh = shapes.rectangle(1.0, 0.6) if light == "rectangle" else shapes.box(0.5, 0.4, 0.3)
    scene = lit_floor(ROUGH, mesh, OVER)
    errors = []
    for samples in (4, 64, 1024):
        points, got = direct_of(device, scene, "many_sample_light", size=(12, 8), samples=samples, tile=2)
        exact = quadrature(points, mesh, OVER, order=16)
        errors.append(np.sqrt(np.mean((got - exact) ** 2)) / exact.mean())
    assert errors[1] < errors[0] / 4 and errors[2] < errors[1] / 4 and errors[2] < 0.01
