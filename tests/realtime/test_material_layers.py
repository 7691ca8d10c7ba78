"""Layers of materials on the real-time side: the effects that have them against the definition, and what they cost."""

import numpy as np
import pytest

from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.dressing import dressed
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Image, Material, Shape, Texture
from lightmeter.scenes.optics import clear_coat, material

from .direct_definition import exact_direct, inputs_of
from .small_scenes import LAMP, WHITE, facing, moved, renderer, scene_of
from .test_costs import counted

BUMPY = Texture(Image(np.array([[[150, 110, 230]]], np.uint8)))
FACTORS = Texture(Image(np.array([[[200, 0, 0], [40, 0, 0]]], np.uint8)), min_filter="nearest", mag_filter="nearest")
PAINT = {"base_color": (0.5, 0.1, 0.05), "roughness": 0.6}


def card(**given) -> Shape:
    """A dressed card."""
    shape = facing(Material(**PAINT, **given))
    mesh, made, _ = dressed(shape.mesh, shape.material)
    return Shape("card", mesh, made)


def exact_coated(scene, points) -> np.ndarray:
    """`direct` of the first light at the points where something is seen, (3, N) float64."""
    at = points.at(points.hit)
    normal = at.normal if at.clearcoat_normal is None else at.clearcoat_normal
    coat = clear_coat.Coat(*(a.astype(float) for a in (at.clearcoat, at.clearcoat_roughness)), normal.astype(float).T)

    def coated(base_color, metallic, roughness, specular, n, v, to_light):
        point = material.MaterialPoint(base_color, metallic, roughness, specular, coat)
        return material.evaluate(point, n, v, to_light)

    light = scene.lights[0]
    return exact_direct(light, *inputs_of(points, light), model=coated)


SCENES = {
    "library": lambda: load("material-layers"),
    "normal map of the coat": lambda: scene_of(card(clearcoat=1.0, clearcoat_normal_texture=BUMPY), lights=(LAMP,)),
    "normal map of the base": lambda: scene_of(card(clearcoat=1.0, normal_texture=BUMPY), lights=(LAMP,)),
    "factors": lambda: scene_of(card(clearcoat=0.9, clearcoat_texture=FACTORS), lights=(LAMP,)),
}


@pytest.mark.parametrize("name", SCENES)
def test_cook_torrance_is_the_definition(device, name):
    """To 1e-3 of the value, and 1e-4 of the mean, as of the effect without layers (test_shading_models.py)."""
    scene = SCENES[name]()
    seen = renderer(device, scene, (40, 40), Choice(only=("cook_torrance",))).capture()
    value = exact_coated(scene, seen.points)
    got = seen.direct[0][seen.points.hit].T
    np.testing.assert_allclose(got, value, rtol=1e-3, atol=1e-4 * value.mean())
    bare = renderer(device, scene, (40, 40), Choice(only=("lambert",))).capture().direct[0][seen.points.hit].T
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


def test_a_coat_in_constant_light_takes_and_mirrors_its_share(device):
    """Over black c·F remains, to rounding. The definition has c·F·E: what 1 − E loses is the effect's own error."""
    coat = Material("coat", (0.0, 0.0, 0.0), specular=0.0, clearcoat=0.8, clearcoat_roughness=0.5)
    scene = scene_of(Shape("ball", shapes.sphere(0.9, 64), coat), radiance=(1.0, 1.0, 1.0))
    seen = renderer(device, scene, (24, 24), Choice(only=("constant_ambient",))).capture()
    cosine = np.sum(seen.points.normal * seen.points.view, axis=-1)[seen.points.hit]
    got = seen.frame["environment"][seen.points.hit]
    np.testing.assert_allclose(got[:, 1], 0.8 * (0.04 + 0.96 * (1 - cosine) ** 5), rtol=1e-4)


def test_a_coat_costs_what_it_needs_and_nothing_where_there_is_none():
    """A coat that is the same everywhere: nothing but arithmetic; factors that differ: one attachment; a normal map
    of its own: another, and the map itself.
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
    mapped = counted(scene_of(card(clearcoat=0.5, clearcoat_normal_texture=BUMPY), lights=(LAMP,)), alone)
    assert mapped[1]["textures"] == bare[1]["textures"] + 2
