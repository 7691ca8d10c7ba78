"""Textures, vertex colours and normal maps on the truth's side, against float64 NumPy."""

import numpy as np
import pytest

from lightmeter.groundtruth import primary
from lightmeter.groundtruth.oracles import material
from lightmeter.groundtruth.world import World
from lightmeter.scenes.model import Image, Material, Mesh, Scene, Shape, Texture
from lightmeter.scenes.optics.texture import look_up

from .small_scenes import looking, rectangle

CAMERA = looking((0.1, 0.2, 3), (0, 0, 0), yfov=0.6)


def noise_texture(seed, shape=(13, 7, 4), **how) -> Texture:
    return Texture(Image(np.random.default_rng(seed).integers(0, 256, shape, dtype=np.uint8)), **how)


def textured(**slots) -> World:
    mesh = rectangle((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    tangents = np.tile([1.0, 0, 0, 1], (4, 1))
    mesh = Mesh(mesh.positions, mesh.triangles, np.tile([0.0, 0, 1], (4, 1)), mesh.texcoords, tangents)
    return World.of(Scene("textured", (Shape("card", mesh, Material(**slots)),), CAMERA))


def coordinates(points) -> tuple[np.ndarray, np.ndarray]:
    """Texture coordinates of points on the card, from their positions."""
    return (points.position[..., 0].ravel().astype(float) + 1) / 2, (
        1 - points.position[..., 1].ravel().astype(float)
    ) / 2


@pytest.mark.parametrize("wrap", ["repeat", "clamp", "mirror"])
@pytest.mark.parametrize("mag_filter", ["nearest", "linear"])
def test_textures_are_looked_up_as_the_optics_say(wrap, mag_filter):
    """Coordinates are float32 up to 3: texel positions are good to 3·13·6e-8·2, values to that times a step of 1."""
    how = {"wrap_u": wrap, "wrap_v": wrap, "mag_filter": mag_filter}
    how |= {"offset": (0.3, -1.1), "rotation": 0.4, "scale": (2.5, 3.0)}
    color, metal = noise_texture(1, srgb=True, **how), noise_texture(2, (5, 9, 3), **how)
    emissive = noise_texture(3, (4, 4, 1), srgb=True)
    occlusion = noise_texture(4, (6, 3, 3))
    world = textured(
        base_color=(0.5, 0.7, 0.9),
        metallic=0.8,
        roughness=0.6,
        base_color_texture=color,
        metallic_roughness_texture=metal,
        emissive=(3, 2, 1),
        emissive_texture=emissive,
        occlusion_texture=occlusion,
        occlusion_strength=0.7,
    )
    points = primary.surface_points(world, (48, 48))
    u, v = coordinates(points)
    expected = {
        "base_color": look_up(color, u, v)[:3].T * (0.5, 0.7, 0.9),
        "metallic": look_up(metal, u, v)[2] * 0.8,
        "roughness": look_up(metal, u, v)[1] * 0.6,
        "emission": look_up(emissive, u, v)[:3].T * (3, 2, 1),
        "occlusion": 1 + 0.7 * (look_up(occlusion, u, v)[0] - 1),
    }
    for name, value in expected.items():
        got = getattr(points, name).reshape(value.shape)
        wrong = np.abs(got - value).reshape(len(u), -1).max(axis=1) > 2e-4
        # At a texel's border the nearest one may be either.
        assert wrong.mean() <= (0.002 if mag_filter == "nearest" else 0), name


def test_normal_maps_bend_the_normal_in_the_tangent_frame():
    texels = np.full((4, 4, 3), 128, np.uint8)
    texels[..., 0], texels[..., 1], texels[..., 2] = 200, 90, 220
    world = textured(normal_texture=Texture(Image(texels)), normal_scale=0.5)
    points = primary.surface_points(world, (8, 8))
    x, y, z = (200 / 255 * 2 - 1) * 0.5, (90 / 255 * 2 - 1) * 0.5, 220 / 255 * 2 - 1
    expected = np.array([x, y, z]) / np.linalg.norm([x, y, z])
    np.testing.assert_allclose(points.normal.reshape(-1, 3), np.tile(expected, (64, 1)), atol=2e-6)


def test_vertex_colours_are_interpolated_and_multiplied_in():
    mesh = rectangle((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    colors = np.array([[0, 0.5, 1, 1], [1, 0.5, 1, 1], [1, 0.5, 0, 1], [0, 0.5, 0, 1]])
    mesh = Mesh(mesh.positions, mesh.triangles, None, (), None, colors)
    world = World.of(Scene("c", (Shape("card", mesh, Material(base_color=(1, 0.5, 1))),), CAMERA))
    points = primary.surface_points(world, (16, 16))
    u, v = coordinates(points)
    expected = np.stack([u, np.full_like(u, 0.25), v], axis=1)
    np.testing.assert_allclose(points.base_color.reshape(-1, 3), expected, atol=2e-6)


def test_texels_beyond_2_to_the_24_are_found():
    """Two images in one array: the second one's texels have numbers that float32 cannot hold."""
    large = Texture(Image(np.zeros((4097, 4099, 1), np.uint8)))
    small = noise_texture(5, (3, 5, 3), mag_filter="nearest", wrap_u="clamp", wrap_v="clamp")
    mesh = rectangle((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    far = rectangle((-1, -1, -5), (2, 0, 0), (0, 2, 0))
    world = World.of(
        Scene(
            "large",
            (
                Shape("behind", far, Material(base_color_texture=large)),
                Shape("card", mesh, Material(base_color_texture=small)),
            ),
            CAMERA,
        )
    )
    points = primary.surface_points(world, (32, 32))
    assert np.all(points.shape == 1)
    u, v = coordinates(points)
    wrong = np.abs(points.base_color.reshape(-1, 3) - look_up(small, u, v)[:3].T).max(axis=1) > 1e-6
    assert wrong.mean() < 0.01


def test_the_material_oracle_keeps_position_and_view_and_mends_the_rest():
    world = textured(base_color_texture=noise_texture(1), roughness=0.4)
    exact = primary.surface_points(world, (16, 16))
    spoilt = material.evaluate(world, exact)
    np.testing.assert_array_equal(spoilt.position, exact.position)
    np.testing.assert_allclose(spoilt.base_color, exact.base_color, atol=1e-6)


def test_smooth_normals_are_turned_to_the_viewer_on_the_back_of_double_sided_shapes():
    mesh = rectangle((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    normals = np.tile([0.2, 0, 0.9797959], (4, 1))
    behind = looking((0, 0, -3), (0, 0, 0), yfov=0.4)
    for double_sided in (False, True):
        shape = Shape(
            "card",
            Mesh(mesh.positions, mesh.triangles, normals),
            Material(double_sided=double_sided, emissive=(1, 1, 1)),
        )
        points = primary.surface_points(World.of(Scene("card", (shape,), behind)), (4, 4))
        sign = -1 if double_sided else 1
        np.testing.assert_allclose(points.normal[0, 0], sign * normals[0], atol=1e-6)
        assert points.emission.all() == double_sided


def test_a_point_on_a_triangle_that_is_not_there_is_refused():
    from dataclasses import replace

    from lightmeter.groundtruth.oracles import indirect

    world = textured()
    points = primary.surface_points(world, (4, 4))
    with pytest.raises(ValueError, match="triangle 7 of shape 0, expected 0…1"):
        indirect.evaluate(world, replace(points, triangle=np.full_like(points.triangle, 7)))
    with pytest.raises(ValueError, match="shape 3, expected below 1"):
        indirect.evaluate(world, replace(points, shape=np.full_like(points.shape, 3)))


def test_a_mesh_that_lacks_what_its_material_looks_up_is_refused():
    mesh = rectangle((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    bumpy = Shape("card", mesh, Material(normal_texture=noise_texture(1)))
    with pytest.raises(ValueError, match="'card': a normal texture needs a mesh with normals and tangents"):
        World.of(Scene("bumpy", (bumpy,), CAMERA))
    elsewhere = Shape("card", mesh, Material(base_color_texture=noise_texture(1, texcoord=1)))
    with pytest.raises(ValueError, match="needs texture coordinates 1, the mesh has 1 sets"):
        World.of(Scene("elsewhere", (elsewhere,), CAMERA))
