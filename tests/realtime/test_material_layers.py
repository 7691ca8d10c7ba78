"""Layers of materials on the real-time side: the effects that have them against the definition, and what they cost."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.dressing import dressed
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Image, Material, Shape, Texture
from lightmeter.scenes.optics import anisotropy, clear_coat, material, sheen

from .direct_definition import exact_direct, inputs_of
from .small_scenes import LAMP, WHITE, facing, moved, renderer, scene_of
from .test_costs import counted

BUMPY = Texture(Image(np.array([[[150, 110, 230]]], np.uint8)))
FACTORS = Texture(Image(np.array([[[200, 0, 0], [40, 0, 0]]], np.uint8)), min_filter="nearest", mag_filter="nearest")
FELT = {"sheen_color": (0.8, 0.6, 0.9), "sheen_roughness": 0.55}
PAINT = {"base_color": (0.5, 0.1, 0.05), "roughness": 0.6}


def card(**given) -> Shape:
    """A dressed card."""
    shape = facing(Material(**PAINT, **given))
    mesh, made, _ = dressed(shape.mesh, shape.material)
    return Shape("card", mesh, made)


def exact(scene, points) -> np.ndarray:
    """`direct` of the first light at the points where something is seen, (3, N) float64."""
    at = points.at(points.hit).each(lambda a: a.astype(float).T)
    coat = grain = cloth = None
    if at.clearcoat is not None:
        normal = at.normal if at.clearcoat_normal is None else at.clearcoat_normal
        coat = clear_coat.Coat(at.clearcoat, at.clearcoat_roughness, normal)
    if at.anisotropy is not None:
        grain = anisotropy.Grain(at.anisotropy, at.anisotropy_direction)

    if at.sheen_color is not None:
        cloth = sheen.Sheen(at.sheen_color, at.sheen_roughness, sheen.albedo_table().ravel())

    def layered(base_color, metallic, roughness, specular, n, v, to_light):
        point = material.MaterialPoint(base_color, metallic, roughness, specular, coat, grain, cloth)
        return material.evaluate(point, n, v, to_light)

    light = scene.lights[0]
    return exact_direct(light, *inputs_of(points, light), model=layered)


SCENES = {
    "library": lambda: load("material-layers"),
    "normal map of the coat": lambda: scene_of(card(clearcoat=1.0, clearcoat_normal_texture=BUMPY), lights=(LAMP,)),
    "normal map of the base": lambda: scene_of(card(clearcoat=1.0, normal_texture=BUMPY), lights=(LAMP,)),
    "grain": lambda: scene_of(card(anisotropy=0.9, anisotropy_rotation=0.5), lights=(LAMP,)),
    "normal map and grain": lambda: scene_of(card(anisotropy=0.9, normal_texture=BUMPY), lights=(LAMP,)),
    "sheen": lambda: scene_of(card(**FELT), lights=(LAMP,)),
    "sheen under a coat": lambda: scene_of(card(**FELT, clearcoat=0.5, clearcoat_roughness=0.4), lights=(LAMP,)),
    "factors": lambda: scene_of(card(clearcoat=0.9, clearcoat_texture=FACTORS), lights=(LAMP,)),
}


@pytest.mark.parametrize("name", SCENES)
def test_cook_torrance_is_the_definition(device, name):
    """To 1e-3 of the value, and 1e-4 of the mean, as of the effect without layers (test_shading_models.py)."""
    scene = SCENES[name]()
    seen = renderer(device, scene, (40, 40), Choice(only=("cook_torrance",))).capture()
    value = exact(scene, seen.points)
    got = seen.direct[0][seen.points.hit].T
    np.testing.assert_allclose(got, value, rtol=1e-3, atol=1e-4 * value.mean())
    bare = renderer(device, scene, (40, 40), Choice(only=("minnaert",))).capture().direct[0][seen.points.hit].T
    assert np.abs(bare - value).mean() > 0.05 * value.mean()


def test_the_maps_are_told_apart(device):
    """A coat's own map moves its normal alone; a base's map leaves the coat as it is; a texel scales the factor."""
    seen = {name: renderer(device, make(), (8, 8)).capture(terms=False).points for name, make in SCENES.items()}
    own = seen["normal map of the coat"]
    assert (own.normal[own.hit] == (0, 0, 1)).all() and (own.clearcoat_normal[own.hit][:, 2] < 0.99).all()
    base = seen["normal map of the base"]
    assert (base.clearcoat_normal[base.hit] == (0, 0, 1)).all() and (base.normal[base.hit][:, 2] < 0.99).all()
    factors = seen["factors"]
    found = np.unique(factors.clearcoat[factors.hit])
    np.testing.assert_allclose(found, [0.9 * 40 / 255, 0.9 * 200 / 255], rtol=1e-6)
    assert factors.clearcoat_normal is None and seen["library"].clearcoat_normal is None


def test_the_grain_is_turned_by_angle_and_texel(device):
    """A texel that points along the bitangent (green 1) turns by a quarter, the angle by its own; blue is a factor."""
    texel = Texture(Image(np.array([[[128, 255, 51]]], np.uint8)))
    turned = scene_of(card(anisotropy=0.5, anisotropy_rotation=0.3, anisotropy_texture=texel))
    seen = renderer(device, turned, (8, 8)).capture(terms=False).points
    direction = seen.anisotropy_direction[seen.hit]
    angle = np.arctan2(1.0, 2 * 128 / 255 - 1) + 0.3
    np.testing.assert_allclose(direction, np.tile([np.cos(angle), np.sin(angle), 0], (len(direction), 1)), atol=1e-6)
    np.testing.assert_allclose(seen.anisotropy[seen.hit], 0.5 * 51 / 255, rtol=1e-6)


def test_other_parts_than_the_material_s_own_know_no_grain(device):
    """Another distribution is the same with and without."""
    seen = []
    for strength in (0.9, 0.0):
        scene = scene_of(card(anisotropy=strength), lights=(LAMP,))
        choice = Choice(only=("cook_torrance",), settings={"cook_torrance": {"distribution": "beckmann"}})
        seen.append(renderer(device, scene, (8, 8), choice).capture().direct[0])
    assert np.array_equal(*seen)


def test_a_coat_in_constant_light_takes_and_mirrors_its_share(device):
    """Over black c·F remains, to rounding. The definition has c·F·E: what 1 − E loses is the effect's own error."""
    coat = Material("coat", (0.0, 0.0, 0.0), specular=0.0, clearcoat=0.8, clearcoat_roughness=0.5)
    scene = scene_of(Shape("ball", shapes.sphere(0.9, 64), coat), radiance=(1.0, 1.0, 1.0))
    seen = renderer(device, scene, (24, 24), Choice(only=("constant_ambient",))).capture()
    cosine = np.sum(seen.points.normal * seen.points.view, axis=-1)[seen.points.hit]
    got = seen.frame["environment"][seen.points.hit]
    np.testing.assert_allclose(got[:, 1], 0.8 * (0.04 + 0.96 * (1 - cosine) ** 5), rtol=1e-4)


def test_a_sheen_in_constant_light_returns_its_albedo(device):
    """color·E + base·(1 − m·E) with E from the table, to rounding; at roughness 1 it is 0.16 at normal incidence."""
    felt = Material("felt", (0.0, 0.0, 0.0), specular=0.0, sheen_color=(1.0, 0.5, 0.0), sheen_roughness=1.0)
    scene = scene_of(Shape("ball", shapes.sphere(0.9, 64), felt), radiance=(1.0, 1.0, 1.0))
    seen = renderer(device, scene, (24, 24), Choice(only=("constant_ambient",))).capture()
    at = seen.points.at(seen.points.hit)
    cosine = np.sum(at.normal * at.view, axis=-1)
    cloth = sheen.Sheen(np.ones((3, 1)), np.ones(1), sheen.albedo_table().ravel())
    got = seen.frame["environment"][seen.points.hit]
    expected = sheen.albedo(cloth, cosine)[:, None] * felt.sheen_color
    np.testing.assert_allclose(got, expected, atol=1e-3)
    assert got[cosine > 0.99, 0] == pytest.approx(0.165, abs=0.005)


def test_more_attachments_than_a_draw_can_write_are_drawn_in_groups(device):
    """Every layer with maps beside emission and occlusion: ten attachments, where OpenGL promises eight."""
    every = {
        "clearcoat": 0.9,
        "clearcoat_texture": FACTORS,
        "clearcoat_normal_texture": BUMPY,
        "anisotropy": 0.5,
        "sheen_color": (0.8, 0.6, 0.9),
        "sheen_roughness": 0.5,
        "sheen_color_texture": replace(FACTORS, srgb=True),
        "occlusion_texture": FACTORS,
        "metallic_roughness_texture": FACTORS,
    }
    glow = Shape("glow", shapes.rectangle(0.5, 0.5), Material("glow", emissive=(2.0, 2.0, 2.0)), moved(x=0.6, z=0.5))
    scene = scene_of(card(**every), glow, lights=(LAMP,))
    maker = renderer(device, scene, (40, 40), Choice(only=("cook_torrance",)))
    for _ in range(2):
        seen = maker.capture()
        value = exact(scene, seen.points)
        np.testing.assert_allclose(seen.direct[0][seen.points.hit].T, value, rtol=1e-3, atol=1e-4 * value.mean())
        assert seen.points.emission.max() == 2 and set(np.unique(seen.points.shape)) == {0, 1}
        assert seen.points.occlusion[seen.points.hit].min() < 0.9


def test_a_layer_costs_what_it_needs_and_nothing_where_there_is_none():
    """A coat that is the same everywhere: nothing but arithmetic; factors that differ: one attachment; a normal map
    of its own: another, and the map itself. A grain: one attachment.
    """
    ball = Shape("ball", shapes.sphere(0.4, segments=16), WHITE, moved(z=0.6))
    bare = counted(scene_of(card(), lights=(LAMP,)))
    assert counted(scene_of(card(clearcoat=0.0, clearcoat_texture=FACTORS), lights=(LAMP,))) == bare
    assert counted(scene_of(card(clearcoat=0.5), lights=(LAMP,))) == bare
    two = scene_of(card(), ball, lights=(LAMP,)), scene_of(card(clearcoat=0.5), ball, lights=(LAMP,))
    plain, mixed = (counted(scene, Choice(without=("constant_ambient",))) for scene in two)
    assert mixed[1]["textures"] == plain[1]["textures"] + 1 and mixed[1]["shaders"] == plain[1]["shaders"]
    plain, mixed = (counted(s, Choice(use=("lambert",), without=("constant_ambient",))) for s in two)
    assert mixed[1] == plain[1]
    # A bumpy card is not flat: light can be in its own way, and come from itself.
    alone = Choice(without=("shadow_map", "constant_ambient"))
    grain = counted(scene_of(card(anisotropy=0.5), lights=(LAMP,)))
    assert grain[1]["textures"] == bare[1]["textures"] + 1 and grain[1]["shaders"] == bare[1]["shaders"]
    # A sheen that is the same everywhere: its table of albedos.
    cloth = counted(scene_of(card(**FELT), lights=(LAMP,)))
    assert cloth[1]["textures"] == bare[1]["textures"] + 1 and cloth[1]["shaders"] == bare[1]["shaders"]
    mapped = counted(scene_of(card(clearcoat=0.5, clearcoat_normal_texture=BUMPY), lights=(LAMP,)), alone)
    assert mapped[1]["textures"] == bare[1]["textures"] + 2
