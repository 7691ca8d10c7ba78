"""Layers of materials on the truth's side: the BSDF's sampling and values, textures, the oracles, closure."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth.oracles import coverage, direct
from lightmeter.groundtruth.primary import seen_emission, surface_points
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.variant import mi
from lightmeter.groundtruth.world import World
from lightmeter.scenes import shapes
from lightmeter.scenes.dressing import dressed
from lightmeter.scenes.model import Environment, Image, Material, PointLight, Scene, Shape, Texture
from lightmeter.scenes.optics import anisotropy, clear_coat, lights, sheen
from lightmeter.scenes.optics import material as optics

from .aligned import aligned
from .noise import assert_same_mean
from .small_scenes import floor, looking
from .test_bsdf import seen_from, tilted
from .test_truth_closure import composed

COATED = Material("coated", base_color=(0.8, 0.3, 0.1), roughness=0.5, clearcoat=0.8, clearcoat_roughness=0.3)


def texel(*values: int) -> Texture:
    """A texture of one colour."""
    return Texture(Image(np.array([[values]], np.uint8)))


BRUSHED = Material("brushed", (0.8, 0.6, 0.5), metallic=1.0, roughness=0.4, anisotropy=0.7, anisotropy_rotation=0.4)
FELT = Material("felt", (0.1, 0.2, 0.4), roughness=0.8, sheen_color=(0.9, 0.6, 0.3), sheen_roughness=0.5)
COATED_FELT = replace(COATED, name="coated felt", sheen_color=(0.5, 0.5, 0.9), sheen_roughness=0.7)
LAYERED = (COATED, BRUSHED, FELT, COATED_FELT)
BUMPY = Material(
    base_color=(0.8, 0.3, 0.1),
    roughness=0.5,
    normal_texture=texel(100, 128, 230),
    clearcoat=0.9,
    clearcoat_roughness=1.0,
    clearcoat_texture=texel(204, 7, 9),
    clearcoat_roughness_texture=texel(5, 102, 8),
    clearcoat_normal_texture=texel(160, 120, 220),
    clearcoat_normal_scale=0.5,
    anisotropy=0.8,
    anisotropy_rotation=0.2,
    anisotropy_texture=texel(255, 200, 153),
    sheen_color=(0.5, 0.4, 0.2),
    sheen_roughness=0.9,
    sheen_color_texture=replace(texel(188, 255, 0), srgb=True),
    sheen_roughness_texture=texel(1, 2, 3, 204),
)


def scene_of(material: Material, **given) -> Scene:
    """A floor seen from above."""
    mesh, material, _ = dressed(floor(), material)
    return Scene(
        "floor", (Shape("floor", mesh, material),), looking((0, 3, 0), (0, 0, 0), yfov=0.5, up=(0, 0, -1)), **given
    )


def layered(parameters: Material, count: int) -> optics.MaterialPoint:
    """A material without textures at many points of the floor, whose tangent is +X and whose bitangent is −Z."""
    up = np.tile([[0.0], [1.0], [0.0]], count)
    color = np.repeat(np.array(parameters.base_color)[:, None], count, 1)
    scalars = (np.full(count, x, float) for x in (parameters.metallic, parameters.roughness, parameters.specular))
    point = optics.MaterialPoint(color, *scalars)
    if parameters.clearcoat:
        factors = (np.full(count, x) for x in (parameters.clearcoat, parameters.clearcoat_roughness))
        point = replace(point, coat=clear_coat.Coat(*factors, up))
    if parameters.anisotropy:
        turn = parameters.anisotropy_rotation
        direction = np.tile([[np.cos(turn)], [0], [-np.sin(turn)]], count)
        point = replace(point, grain=anisotropy.Grain(np.full(count, parameters.anisotropy), direction))
    if max(parameters.sheen_color) > 0:
        color = np.repeat(np.array(parameters.sheen_color)[:, None], count, 1)
        cloth = sheen.Sheen(color, np.full(count, parameters.sheen_roughness), sheen.albedo_table().ravel())
        point = replace(point, sheen=cloth)
    return point


@pytest.mark.parametrize("material", LAYERED, ids=lambda material: material.name)
@pytest.mark.parametrize("degrees", [20, 75])
def test_the_bsdf_is_the_optics(material, degrees):
    """Values and densities against float64, to float32's 2e-4 as of the material without layers (test_bsdf.py)."""
    count = 4096
    world, view = World.of(scene_of(material)), tilted(degrees)
    rng = np.random.default_rng(3)
    u = aligned(rng.random((3, count)))
    si, bsdf = seen_from(world, view, count)
    drawn, weight = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[0]), mi.Point2f(u[1], u[2]))
    value, density = bsdf.eval_pdf(mi.BSDFContext(), si, drawn.wo)
    up = np.zeros((3, count))
    up[1] = 1
    point = layered(material, count)
    light, seen = si.to_world(drawn.wo).numpy().astype(float), np.repeat(view[:, None], count, 1)
    np.testing.assert_allclose(value.numpy(), optics.evaluate(point, up, seen, light), rtol=2e-4, atol=1e-6)
    np.testing.assert_allclose(density.numpy(), optics.pdf(point, up, seen, light), rtol=2e-4, atol=1e-6)
    kept = drawn.pdf.numpy() > 0
    np.testing.assert_allclose(weight.numpy()[:, kept], value.numpy()[:, kept] / density.numpy()[kept], rtol=1e-4)


def test_a_double_sided_coat_is_the_same_from_below():
    """With a normal map of its own that leans: seen from behind, both normals are turned."""
    mesh, material, _ = dressed(floor(), Material(clearcoat=1.0, clearcoat_normal_texture=texel(160, 120, 220)))
    camera = looking((0, 3, 0), (0, 0, 0), yfov=1, up=(0, 0, -1))
    found = []
    for sign in (1, -1):
        shape = Shape("floor", mesh, Material(**(vars(material) | {"double_sided": True})))
        world = World.of(Scene("floor", (shape,), camera))
        si, bsdf = seen_from(world, sign * tilted(30), 64)
        rng = np.random.default_rng(1)
        wo = rng.normal(size=(3, 64))
        wo[1] = np.abs(wo[1])
        wo = sign * wo / np.linalg.norm(wo, axis=0)
        found.append(bsdf.eval(mi.BSDFContext(), si, si.to_local(mi.Vector3f(*aligned(wo)))).numpy())
    assert found[0].max() > 0
    np.testing.assert_allclose(found[1], found[0], rtol=1e-4, atol=1e-6)


def test_textures_are_read_by_their_channels():
    """Factor in red, roughness in green; the coat's normal map is its own and scaled by its own factor."""
    points = surface_points(World.of(scene_of(BUMPY)), (4, 4))
    np.testing.assert_allclose(points.clearcoat, 0.9 * 204 / 255, rtol=1e-6)
    np.testing.assert_allclose(points.clearcoat_roughness, 102 / 255, rtol=1e-6)
    x, y, z = (2 * np.array([160, 120, 220]) / 255 - 1) * (0.5, 0.5, 1)
    # The floor's u grows along +X, and green points up the image, along −Z.
    expected = np.array([x, z, -y]) / np.linalg.norm([x, y, z])
    np.testing.assert_allclose(points.clearcoat_normal.reshape(-1, 3), np.tile(expected, (16, 1)), atol=1e-6)
    assert np.abs(points.clearcoat_normal - points.normal).max() > 0.1
    np.testing.assert_allclose(points.anisotropy, 0.8 * 153 / 255, rtol=1e-6)
    np.testing.assert_allclose(points.sheen_color[0, 0], [0.5 * 0.502886, 0.4, 0], rtol=1e-4)  # IEC 61966-2-1 of 188
    np.testing.assert_allclose(points.sheen_roughness, 0.9 * 204 / 255, rtol=1e-6)
    turn = np.arctan2(2 * 200 / 255 - 1, 1) + 0.2
    flat = np.array([np.cos(turn), 0, -np.sin(turn)])
    normal = points.normal[0, 0].astype(float)
    across = flat - normal * (flat @ normal)
    found = points.anisotropy_direction.reshape(-1, 3)
    np.testing.assert_allclose(found, np.tile(across / np.linalg.norm(across), (16, 1)), atol=1e-6)


def test_a_smooth_coat_over_a_bumpy_base_keeps_the_surface_s_normal():
    points = surface_points(World.of(scene_of(Material(normal_texture=texel(100, 128, 230), clearcoat=1.0))), (4, 4))
    np.testing.assert_allclose(points.clearcoat_normal.reshape(-1, 3), np.tile([0, 1, 0], (16, 1)), atol=1e-7)
    assert points.normal[..., 1].max() < 0.99


def test_without_coats_there_are_no_parameters_and_without_normal_maps_no_second_normal():
    bare = surface_points(World.of(scene_of(Material())), (4, 4))
    assert bare.clearcoat is None and bare.clearcoat_roughness is None and bare.clearcoat_normal is None
    assert bare.sheen_color is None and bare.sheen_roughness is None
    assert bare.anisotropy is None and bare.anisotropy_direction is None
    coated = surface_points(World.of(scene_of(COATED)), (4, 4))
    assert (coated.clearcoat == np.float32(0.8)).all() and coated.clearcoat_normal is None


def test_the_oracle_of_direct_light_is_the_definition():
    """A point light, in double precision: to the rounding of the float32 points, 1e-5."""
    lamp = PointLight("lamp", (0.4, 1.5, 0.2), (3.0, 2.0, 1.0))
    world = World.of(scene_of(BUMPY, lights=(lamp,)))
    points = surface_points(world, (8, 8))
    found = direct.evaluate(world, points, 0).reshape(-1, 3).T
    at = points.at(points.hit)
    at = at.each(lambda a: a.astype(float).T)
    coat = clear_coat.Coat(at.clearcoat, at.clearcoat_roughness, at.clearcoat_normal)
    cloth = sheen.Sheen(
        at.sheen_color, at.sheen_roughness, sheen.albedo_table().astype(np.float32).astype(float).ravel()
    )
    grain = anisotropy.Grain(at.anisotropy, at.anisotropy_direction)
    point = optics.MaterialPoint(at.base_color, at.metallic, at.roughness, at.specular, coat, grain, cloth)
    towards, inverse_square = lights.from_position(np.array(lamp.position)[:, None], at.position)
    value = optics.evaluate(point, at.normal, at.view, towards)
    np.testing.assert_allclose(found, np.array(lamp.intensity)[:, None] * inverse_square * value, rtol=1e-5)


def test_a_point_without_a_normal_is_black():
    """The back of a single-sided surface: a cosine that is no number looks nothing up."""
    lamp = PointLight("lamp", (0.4, 1.5, 0.2), (3.0, 2.0, 1.0))
    world = World.of(scene_of(BUMPY, lights=(lamp,)))
    points = surface_points(world, (8, 8))
    assert (direct.evaluate(world, replace(points, normal=0 * points.normal), 0) == 0).all()


def test_the_composition_of_all_oracles_is_the_reference():
    """A coated ball on a coated floor with normal maps, under a lamp, a point light and an environment."""
    mesh, bumpy, _ = dressed(shapes.plane(4.0, 4.0), BUMPY)
    up = np.eye(4)
    up[1, 3] = 0.5
    lamp = np.eye(4)
    lamp[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]  # a rectangle faces +Z; this one faces down
    lamp[:3, 3] = -0.8, 2.0, 0.3
    glow = Material("glow", (0, 0, 0), specular=0.0, emissive=(6.0, 6.0, 6.0))
    scene = Scene(
        "coats",
        (
            Shape("floor", mesh, bumpy),
            Shape("ball", shapes.sphere(0.5, 48), COATED, up),
            Shape("lamp", shapes.rectangle(0.8, 0.8), glow, lamp),
        ),
        looking((0, 1.6, 2.6), (0, 0.4, 0), yfov=0.7),
        (PointLight("point", (1.5, 2.0, 1.0), (2.0, 2.0, 2.0)),),
        Environment((0.3, 0.35, 0.4)),
    )
    world, size, count = World.of(scene), (32, 32), 12
    steady = seen_emission(world, size, spp=256)
    offsets = coverage.evaluate(count, 4, seed=3)
    ours = np.stack([composed(world, size, 8, b, offsets[b], steady) for b in range(count)])
    truth = np.stack([render_batch(world, size, 64, 1, b) for b in range(count)])
    a, b = ours.mean(axis=(1, 2, 3)), truth.mean(axis=(1, 2, 3), dtype=float)
    error = np.sqrt(a.var(ddof=1) / count + b.var(ddof=1) / count) / b.mean()
    print(f"bias {a.mean() / b.mean() - 1:.2e}, standard error {error:.2e}")
    assert error < 3e-3
    assert_same_mean(a, b)
