"""The conventions that `scenes.model` states, on the scene itself; `tests/realtime` holds the renderer to them."""

import numpy as np
import pytest

from lightmeter.realtime.projection import projection_matrix, view_matrix, viewer
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Image, Material, Mesh, Shape, Texture
from lightmeter.scenes.optics.color import srgb_decode, srgb_encode
from lightmeter.scenes.optics.frames import tangent_to_world
from lightmeter.scenes.optics.texture import look_up

TRIANGLE = Mesh(
    np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]),
    np.array([[0, 1, 2]]),
    np.tile(np.float32([0, 0, 1]), (3, 1)),
    tangents=np.tile(np.float32([1, 0, 0, 1]), (3, 1)),
)


def window(camera: Camera, size: tuple[int, int], point, offset=(0.0, 0.0)) -> np.ndarray:
    """Where a point lands, in pixels right and down from the image's top left corner."""
    clip = projection_matrix(camera, size, offset) @ view_matrix(camera) @ np.append(point, 1.0)
    ndc = clip[:3] / clip[3]
    return np.array([(ndc[0] + 1) / 2 * size[0], (1 - ndc[1]) / 2 * size[1]])


def face_normal(mesh: Mesh) -> np.ndarray:
    a, b, c = mesh.positions[mesh.triangles[0]].astype(np.float64)
    n = np.cross(b - a, c - a)
    return n / np.linalg.norm(n)


def test_a_camera_looks_along_minus_z_with_y_up():
    identity = Camera("c", np.eye(4), yfov=np.pi / 2)
    assert np.allclose(window(identity, (10, 10), (0, 0, -1)), (5, 5))
    assert np.allclose(window(identity, (10, 10), (1, 1, -1)), (10, 0))
    matrix = look_at((3, 0, 0), (0, 0, 0))
    assert np.allclose(matrix[:3, :3].T, [[0, 0, -1], [0, 1, 0], [1, 0, 0]])
    assert np.linalg.det(matrix) == pytest.approx(1)


def test_the_height_holds_the_field_and_the_width_follows():
    fov = 0.7
    perspective = Camera("p", np.eye(4), yfov=fov)
    top = (0, 2 * np.tan(fov / 2), -2)
    for size in ((10, 10), (30, 10), (4, 12)):
        assert np.allclose(window(perspective, size, top), (size[0] / 2, 0))
        right = (2 * np.tan(fov / 2) * size[0] / size[1], 0, -2)
        assert np.allclose(window(perspective, size, right), (size[0], size[1] / 2))
    orthographic = Camera("o", np.eye(4), ymag=1.5)
    assert np.allclose(window(orthographic, (20, 10), (3.0, 1.5, -7)), (20, 0))


def test_an_offset_samples_right_and_down():
    """A point seen at p is then found at p − offset: the samples move, and the picture the other way."""
    camera = Camera("c", look_at((1, 2, 3), (0, 0, 0)), yfov=0.6)
    here = window(camera, (64, 48), (0.1, 0.2, 0.3))
    there = window(camera, (64, 48), (0.1, 0.2, 0.3), (0.25, -0.5))
    assert np.allclose(there, here - (0.25, -0.5))


def test_depth_runs_from_near_to_far():
    for lens in ({"yfov": 0.8}, {"ymag": 2.0}):
        camera = Camera("c", np.eye(4), near=0.5, far=20.0, **lens)
        for z, depth in ((-0.5, -1), (-20, 1)):
            clip = projection_matrix(camera, (8, 8)) @ np.array([0, 0, z, 1])
            assert clip[2] / clip[3] == pytest.approx(depth)


def test_the_viewer_is_a_position_or_a_direction():
    matrix = look_at((1, 2, 3), (0, 0, 0))
    assert np.allclose(viewer(Camera("p", matrix, yfov=1.0)), (1, 2, 3, 1))
    assert np.allclose(viewer(Camera("o", matrix, ymag=1.0)), np.append(np.array([1, 2, 3]) / np.sqrt(14), 0))


def test_a_camera_has_one_kind_of_lens():
    for lens in ({}, {"yfov": 1.0, "ymag": 1.0}):
        with pytest.raises(ValueError, match="either yfov"):
            Camera("c", np.eye(4), **lens)


@pytest.mark.parametrize("diagonal", [(1, 1, 1), (-1, 1, 1), (-1, -2, 1), (2, 3, 0.5), (-1, -1, -1)])
def test_shapes_keep_their_front_under_mirroring(diagonal):
    """Triangles turn round with a mirror, normals follow the inverse transpose, the bitangent follows its image."""
    rotation = look_at((1, 2, 3), (0, 0, 0))[:3, :3]
    matrix = np.eye(4)
    matrix[:3, :3] = rotation @ np.diag(diagonal)
    world = Shape("s", TRIANGLE, Material(), matrix).world
    assert np.allclose(face_normal(world), world.normals[0], atol=1e-6)
    tangent, sign = world.tangents[0, :3], world.tangents[0, 3]
    bitangent = sign * np.cross(world.normals[0], tangent)
    image = matrix[:3, :3] @ [0, 1, 0]
    assert np.allclose(tangent, matrix[:3, :3] @ [1, 0, 0] / np.linalg.norm(matrix[:3, :3] @ [1, 0, 0]), atol=1e-6)
    assert np.allclose(bitangent, image / np.linalg.norm(image), atol=1e-6)


@pytest.mark.parametrize("name", ["box", "cone", "cylinder", "sphere", "torus"])
def test_procedural_fronts_face_along_their_normals(name):
    mesh = getattr(shapes, name)()
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    faces = np.cross(b - a, c - a)
    assert (np.sum(faces * mesh.normals[mesh.triangles[:, 0]], axis=1) > 0).all()


def test_normal_maps_lean_along_tangent_and_bitangent():
    t, n = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    assert np.allclose(tangent_to_world(t, 1.0, n, np.array([1.0, 0, 0])), t)
    assert np.allclose(tangent_to_world(t, 1.0, n, np.array([0, 1.0, 0])), (0, 1, 0))
    assert np.allclose(tangent_to_world(t, -1.0, n, np.array([0, 1.0, 0])), (0, -1, 0))


def test_the_texture_s_origin_is_its_top_left_and_texels_have_centres():
    texture = Texture(Image(np.float32([[[0.0], [1.0]], [[2.0], [3.0]]])))
    u, v = np.array([0.25, 0.75, 0.25, 0.75, 0.5]), np.array([0.25, 0.25, 0.75, 0.75, 0.5])
    assert np.allclose(look_up(texture, u, v)[0], (0, 1, 2, 3, 1.5))


@pytest.mark.parametrize(
    ("wrap", "expected"),
    [("repeat", [2, 3, 0, 1, 2, 3, 0, 1]), ("clamp", [0, 0, 0, 1, 2, 3, 3, 3]), ("mirror", [1, 0, 0, 1, 2, 3, 3, 2])],
)
def test_wrapping(wrap, expected):
    texture = Texture(Image(np.arange(4, dtype=np.float32).reshape(1, 4, 1)), wrap_u=wrap, wrap_v=wrap)
    u = (np.arange(8) - 2 + 0.5) / 4
    assert np.allclose(look_up(texture, u, np.full(8, 0.5))[0], expected)
    across = Texture(Image(np.arange(4, dtype=np.float32).reshape(4, 1, 1)), wrap_u=wrap, wrap_v=wrap)
    assert np.allclose(look_up(across, np.full(8, 0.5), u)[0], expected)


def test_between_texels_a_wrapped_edge_mixes_its_two_sides():
    texels = Image(np.float32([[[0.0], [1.0], [4.0]]]))
    for wrap, value in (("repeat", 2.0), ("clamp", 4.0), ("mirror", 4.0)):
        assert look_up(Texture(texels, wrap_u=wrap), np.array([1.0]), np.array([0.5]))[0, 0] == pytest.approx(value)


def test_the_texture_transform_scales_then_turns_then_moves():
    """KHR_texture_transform: translation · rotation · scale."""
    texture = Texture(Image(np.zeros((1, 1, 1), np.float32)), offset=(0.1, 0.2), rotation=np.pi / 2, scale=(2.0, 3.0))
    assert np.allclose(texture.matrix @ (1, 0, 1), (0.1, 0.2 - 2))
    assert np.allclose(texture.matrix @ (0, 1, 1), (0.1 + 3, 0.2))


def test_srgb_holds_iec_61966_2_1():
    """The curve's knots, its published mid grey, and the round trip."""
    assert srgb_decode(np.array([0.0, 1.0])) == pytest.approx([0, 1])
    assert srgb_decode(np.array([0.5]))[0] == pytest.approx(0.214041140, abs=1e-9)
    assert srgb_decode(np.array([0.04045]))[0] == pytest.approx(0.04045 / 12.92)
    codes = np.linspace(0, 1, 1001)
    # The standard's rounded constants leave a step of 3e-8 at the knot.
    assert np.abs(srgb_encode(srgb_decode(codes)) - codes).max() < 1e-6


def test_colour_is_decoded_before_it_is_filtered():
    texture = Texture(Image(np.uint8([[[0], [255]]])), srgb=True, wrap_u="clamp")
    assert look_up(texture, np.array([0.5]), np.array([0.5]))[0, 0] == pytest.approx(0.5)


def test_alpha_is_never_decoded():
    texture = Texture(Image(np.uint8([[[128, 128, 128, 128]]])), srgb=True)
    red, _, _, alpha = look_up(texture, np.array([0.5]), np.array([0.5]))[:, 0]
    assert (red, alpha) == (pytest.approx(0.2158605, abs=1e-6), pytest.approx(128 / 255))
