"""Alpha masks: light passes through the holes, from either side, and only there."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth import primary
from lightmeter.groundtruth.oracles import environment_visibility, indirect, visibility
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.world import World
from lightmeter.scenes.model import Environment, Image, Material, PointLight, Scene, Shape, Texture

from .noise import assert_same_mean
from .small_scenes import WHITE, floor, looking, points_at, rectangle


def leaf_texture() -> Texture:
    """Opaque at the left, a hole at the right; sharp at the middle since the nearest texel is taken."""
    texels = np.full((2, 2, 4), 255, np.uint8)
    texels[:, 1, 3] = 0
    return Texture(Image(texels), mag_filter="nearest", wrap_u="clamp", wrap_v="clamp")


def leaf(*, double_sided: bool, face: str) -> Shape:
    """A square leaf of 1 m at y = 1; its opaque half is at x < 0. The front is up or down."""
    material = Material(
        base_color=(0.5, 0.8, 0.3),
        specular=0,
        base_color_texture=leaf_texture(),
        alpha_mode="mask",
        double_sided=double_sided,
    )
    mesh = rectangle((-0.5, 1, 0.5), (1, 0, 0), (0, 0, -1))
    if face == "down":
        mesh = replace(mesh, triangles=mesh.triangles[:, ::-1])
    return Shape("leaf", mesh, material)


@pytest.mark.parametrize("double_sided", [False, True])
@pytest.mark.parametrize("face", ["up", "down"])
def test_a_leafs_shadow_under_a_point_light(face, double_sided):
    """The light is at 2 m, the leaf half way: its shadow is twice its size, x from −1 to 0."""
    light = PointLight("lamp", (0, 2, 0), (4, 4, 4))
    floor_shape = Shape("floor", floor(3), WHITE)
    camera = looking((0, 5, 0), (0, 0, 0), ymag=1.5, up=(0, 0, -1))
    world = World.of(
        Scene("leaf", (floor_shape, leaf(double_sided=double_sided, face=face)), camera, lights=(light,), max_depth=2)
    )
    assert world.masked
    x = np.array([-1.3, -1.05, -0.95, -0.5, -0.05, 0.05, 0.5, 0.95, 1.3])
    points = points_at(np.stack([x, 0 * x, 0.2 + 0 * x], axis=1), (0, 1, 0), (0, 1, 0))
    a, b = visibility.evaluate(world, points, 0)[:, 0, :, 0]
    shadowed = (x > -1) & (x < 0)
    np.testing.assert_array_equal(a, np.where(shadowed, 0, b))
    # The picture from above: the leaf hides x in (−0.5, 0); beside it, the floor's shadow must lie where it should.
    image = render_batch(world, (60, 60), 8, 0)[..., 0]
    across = image[28:32].mean(axis=0)
    at = (np.arange(60) + 0.5) / 20 - 1.5
    np.testing.assert_allclose(across[(at > -1) & (at < -0.5)], 0, atol=1e-7)
    lit = (at < -1.06) | (at > 0.06)
    expected = 4 / np.pi * 2 / (4 + at[lit] ** 2) ** 1.5
    np.testing.assert_allclose(across[lit], expected, rtol=0.02)
    front = double_sided or face == "up"
    leaf_seen = across[(at > -0.45) & (at < -0.05)]
    assert np.all(leaf_seen > 0.3) if front else np.all(leaf_seen == 0)


def test_the_leaf_is_lit_from_the_viewers_side_only():
    """A double-sided leaf seen from below while the light is above: no light comes through the opaque half."""
    light = PointLight("lamp", (0, 2, 0), (4, 4, 4))
    camera = looking((-0.25, -1, 0), (-0.25, 1, 0), ymag=0.1, up=(0, 0, -1))
    world = World.of(Scene("leaf", (leaf(double_sided=True, face="up"),), camera, lights=(light,)))
    points = primary.surface_points(world, (8, 8))
    assert points.hit.all()
    assert np.all(points.normal[..., 1] < -0.999)
    assert not visibility.evaluate(world, points, 0).any()
    assert not render_batch(world, (8, 8), 4, 0).any()


def test_the_oracles_and_the_reference_agree_through_holes():
    """Composition and `volpath` with a masked leaf, a point light and an environment."""
    camera = looking((0, 3, 3), (0, 0.3, 0), yfov=0.7)
    scene = Scene(
        "leaf",
        (
            Shape("floor", floor(2), Material(base_color=(0.6, 0.5, 0.4), specular=0)),
            leaf(double_sided=True, face="up"),
        ),
        camera,
        lights=(PointLight("lamp", (0.3, 2, 0.2), (4, 4, 4)),),
        environment=Environment((0.4, 0.5, 0.6)),
    )
    world, size = World.of(scene), (32, 32)
    rng = np.random.default_rng(1)
    truth = np.stack([render_batch(world, size, 64, 1, b).mean(axis=(0, 1)) for b in range(10)])
    composed = []
    for b in range(10):
        total = np.zeros(3)
        for j in range(4):
            points = primary.surface_points(world, size, rng.random((32, 32, 2)))
            light = visibility.evaluate(world, points, 0)[0] + points.emission
            light = light + environment_visibility.evaluate(world, points, spp=16, seed=j, batch=b)[0]
            light = light + indirect.evaluate(world, points, spp=16, seed=j, batch=b)
            total += light.mean(axis=(0, 1)) / 4
        composed.append(total)
    assert_same_mean(np.stack(composed), truth)
