"""What the G-buffer says a surface is made of: sides, textures, alpha, vertex colours, normal maps."""

import numpy as np
import pytest

from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Mesh, Shape, Texture
from lightmeter.scenes.optics.texture import look_up

from .small_scenes import LAMP, WHITE, camera, card, facing, image, moved, points, renderer, scene_of

FRONT = [(-0.9, -0.9, 0), (0.9, -0.9, 0), (0, 0.9, 0)]  # anticlockwise seen from +Z
BACK = [FRONT[0], FRONT[2], FRONT[1]]
TWO_SIDED = Material("both", (1.0, 1.0, 1.0), double_sided=True)
UNITS = np.random.default_rng(3)


def test_the_front_is_where_vertices_run_anticlockwise(device):
    seen = points(device, scene_of(card(FRONT)), (16, 16))
    assert seen.hit.any()
    assert np.array_equal(seen.normal[seen.hit], np.broadcast_to((0, 0, 1), seen.normal[seen.hit].shape))


def test_the_back_of_a_single_sided_surface_is_black_and_hides_what_is_behind(device):
    """Also before an environment, beside an emitter, and where the back itself would emit."""
    glow = Material("glow", emissive=(3, 3, 3))
    behind = facing(WHITE, 2, 2, moved(z=-0.5))
    for material in (WHITE, glow):
        scene = scene_of(card(BACK, material), behind, lights=(LAMP,), radiance=(0.5, 0.5, 0.5))
        image_maker = renderer(device, scene, (24, 24))
        frame, seen = image_maker.render(), image_maker.capture(terms=False).points
        hidden = seen.shape == 0
        assert hidden.sum() > 50
        assert (seen.normal[hidden] == 0).all()
        assert (seen.emission[hidden] == 0).all()
        assert (frame.radiance[hidden] == 0).all()
        assert (frame.radiance[seen.shape == 1] > 0).all()


def test_double_sided_turns_the_normal_to_the_viewer(device):
    for corners in (FRONT, BACK):
        maker = renderer(device, scene_of(card(corners, TWO_SIDED), lights=(LAMP,)), (16, 16))
        seen = maker.capture(terms=False).points
        assert np.allclose(seen.normal[seen.hit], (0, 0, 1), atol=0)
        assert (maker.render().radiance[seen.hit] > 0).all()


def test_interpolated_normals_are_turned_with_the_back(device):
    tilted = np.array([0.3, 0.0, 0.954], np.float32)
    tilted /= np.linalg.norm(tilted)
    seen = points(device, scene_of(card(FRONT, TWO_SIDED, normals=np.tile(tilted, (3, 1)))), (16, 16))
    turned = points(device, scene_of(card(BACK, TWO_SIDED, normals=np.tile(-tilted, (3, 1)))), (16, 16))
    assert np.abs(seen.normal[seen.hit] - tilted).max() < 1e-6
    assert np.abs(turned.normal[turned.hit] - tilted).max() < 1e-6


@pytest.mark.parametrize("mirror", [(-1, 1, 1), (1, -1, 1), (-1, -1, 1), (-2, 0.5, 1)])
def test_a_mirrored_shape_keeps_its_front(device, mirror):
    matrix = np.diag([*mirror, 1.0])
    shape = Shape("mirrored", Mesh(np.array(FRONT, np.float32), np.array([[0, 1, 2]])), WHITE, matrix)
    seen = points(device, scene_of(shape), (16, 16))
    assert seen.hit.any()
    assert np.allclose(seen.normal[seen.hit], (0, 0, 1))


def test_alpha_mask_keeps_what_reaches_the_cutoff(device):
    """From the factor, the texture and the vertices together; ≥ passes."""
    half = image([[[255, 255, 255, 127], [255, 255, 255, 128]]])
    texture = Texture(half, mag_filter="nearest", min_filter="nearest")
    material = Material("leaf", base_color_texture=texture, alpha_mode="mask", alpha_cutoff=128 / 255)
    seen = points(device, scene_of(facing(material)), (8, 8))
    assert not seen.hit[:, :4].any() and seen.hit[:, 4:].all()
    for alpha, there in ((0.49, False), (0.51, True)):
        bare = Material("bare", alpha=alpha, alpha_mode="mask")
        assert points(device, scene_of(facing(bare)), (4, 4)).hit.all() == there
        vertices = np.tile(np.float32([1, 1, 1, alpha]), (3, 1))
        masked = card(FRONT, Material("vertices", alpha_mode="mask"), colors=vertices)
        assert points(device, scene_of(masked), (4, 4)).hit.any() == there
        opaque = Material("opaque", alpha=alpha)
        assert points(device, scene_of(facing(opaque)), (4, 4)).hit.all()


def test_vertex_colours_multiply_the_base_colour(device):
    colors = np.float32([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]])
    material = Material("tinted", (0.5, 0.25, 1.0))
    seen = points(device, scene_of(card(FRONT, material, colors=colors)), (16, 16))
    # Barycentric weights are linear in the position.
    x, y = seen.position[seen.hit][:, 0].astype(float), seen.position[seen.hit][:, 1].astype(float)
    third = (y + 0.9) / 1.8
    second = (x + 0.9 - 0.9 * third) / 1.8
    expected = np.stack([1 - second - third, second, third], axis=1) * (0.5, 0.25, 1.0)
    assert np.abs(seen.base_color[seen.hit] - expected).max() < 4e-6


@pytest.mark.parametrize(
    ("texel", "expected"),
    [
        ((255, 128, 128), (1, 0, 0)),
        ((128, 255, 128), (0, 1, 0)),
        ((0, 128, 128), (-1, 0, 0)),
        ((128, 128, 255), (0, 0, 1)),
    ],
)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_normal_maps_lean_along_tangent_and_bitangent(device, texel, expected, sign):
    """Red leans to the tangent, green to the bitangent = sign·(n × t), here +Y for +1."""
    flat = shapes.rectangle(2, 2)
    tangents = np.tile(np.float32([1, 0, 0, sign]), (len(flat.positions), 1))
    mesh = Mesh(flat.positions, flat.triangles, flat.normals, flat.texcoords, tangents)
    material = Material("bumpy", normal_texture=Texture(image([[texel]])))
    seen = points(device, scene_of(Shape("card", mesh, material)), (4, 4))
    assert np.abs(seen.normal - np.multiply(expected, (1, sign, 1))).max() < 0.012  # 128/255 is not quite a half


def test_the_normal_scale_holds_for_x_and_y(device):
    flat = shapes.rectangle(2, 2)
    mesh = Mesh(flat.positions, flat.triangles, flat.normals, flat.texcoords, np.tile(np.float32([1, 0, 0, 1]), (4, 1)))
    texel = np.float32([[[0.8, 0.5, 0.9]]])
    material = Material("bumpy", normal_texture=Texture(image(texel, np.float32)), normal_scale=2.0)
    seen = points(device, scene_of(Shape("card", mesh, material)), (4, 4))
    expected = np.array([2 * 0.6, 0, 0.8]) / np.hypot(1.2, 0.8)
    assert np.abs(seen.normal - expected).max() < 1e-6


def test_without_tangents_the_interpolated_normal_stays(device):
    material = Material("bumpy", normal_texture=Texture(image([[(255, 128, 128)]])))
    assert np.allclose(points(device, scene_of(facing(material)), (4, 4)).normal, (0, 0, 1))


def test_the_texture_s_origin_is_its_top_left(device):
    corners = image([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]])
    material = Material("corners", base_color_texture=Texture(corners, mag_filter="nearest", min_filter="nearest"))
    seen = points(device, scene_of(facing(material)), (2, 2)).base_color
    assert np.array_equal(seen, [[[1, 0, 0], [0, 1, 0]], [[0, 0, 1], [1, 1, 1]]])


@pytest.mark.parametrize("dtype", [np.uint8, np.float32])
def test_srgb_is_decoded_and_alpha_is_not(device, dtype):
    """IEC 61966-2-1 at every code. A driver's own decoding of 8 bits is its approximation: llvmpipe's polynomial errs
    by up to 0.0012 (Mesa 22.3), a third of a code at the top and 2.5 % of the value at the bottom.
    """
    codes = np.arange(256, dtype=dtype)
    codes = codes / 255 if dtype == np.float32 else codes
    texels = np.repeat(codes[None, :, None], 4, axis=2)
    texture = Texture(image(texels, dtype), srgb=True, mag_filter="nearest", min_filter="nearest")
    material = Material("ramp", base_color_texture=texture, alpha_mode="mask", alpha_cutoff=0.4999)
    seen = points(device, scene_of(facing(material, 2 * 256, 2)), (256, 1))
    assert not seen.hit.all()
    material = Material("ramp", base_color_texture=texture)
    view = camera(ymag=1.0)
    seen = points(device, scene_of(facing(material, 2 * 256, 2), view=view), (256, 1))
    value = np.arange(256) / 255
    linear = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
    assert np.abs(seen.base_color[0, :, 0] - linear).max() < (1.5e-3 if dtype == np.uint8 else 1e-6)


def looked_up(device, texture: Texture, size=(48, 48), uv=None):
    """Base colour as captured, and the exact lookup at the same points."""
    sheet = shapes.rectangle(2, 2)
    coordinates = sheet.texcoords[0] * np.float32([3, 3]) - np.float32([1, 1]) if uv is None else uv(sheet.texcoords[0])
    mesh = Mesh(sheet.positions, sheet.triangles, sheet.normals, (sheet.texcoords[0], coordinates))
    seen = points(device, scene_of(Shape("sheet", mesh, Material("image", base_color_texture=texture))), size)
    place = seen.position.astype(np.float64)
    u, v = (place[..., 0] + 1) / 2, (1 - place[..., 1]) / 2
    if texture.texcoord == 1:
        u, v = 3 * u - 1, 3 * v - 1
    return seen.base_color, look_up(texture, u.ravel(), v.ravel())[:3].T.reshape(*u.shape, 3), (u, v)


WRAPS = ("repeat", "clamp", "mirror")


@pytest.mark.parametrize("wrap_u", WRAPS)
@pytest.mark.parametrize("wrap_v", WRAPS)
@pytest.mark.parametrize("filtering", ["nearest", "linear"])
def test_wrapping_and_bilinear_lookup(device, wrap_u, wrap_v, filtering):
    """Level 0 against the shared definition, three times over the image's width.

    A filter's weights have 8 bits on common hardware: 2⁻⁹ for rounding in each direction, times the contrast 1. A
    coordinate carries 8·ε·3, hence `nearest` is compared away from the texels' edges.
    """
    texels = UNITS.random((5, 4, 3)).astype(np.float32)
    texture = Texture(image(texels, np.float32), False, wrap_u, wrap_v, filtering, filtering, texcoord=1)
    got, expected, (u, v) = looked_up(device, texture)
    to_edge = np.minimum(np.abs(u * 4 - np.round(u * 4)), np.abs(v * 5 - np.round(v * 5)))
    sure = (to_edge > 1e-4) | (filtering == "linear")
    assert sure.mean() > 0.9
    assert np.abs(got - expected)[sure].max() <= (2 * 2.0**-9 + 1e-5 if filtering == "linear" else 0)


@pytest.mark.parametrize(
    ("offset", "rotation", "scale"),
    [((0.25, -0.5), 0.0, (1.0, 1.0)), ((0.0, 0.0), 0.7, (1.0, 1.0)), ((0.1, 0.3), -2.0, (2.0, 0.5))],
)
def test_texture_transforms(device, offset, rotation, scale):
    texture = Texture(
        image(UNITS.random((6, 6, 3)).astype(np.float32), np.float32),
        min_filter="linear",
        offset=offset,
        rotation=rotation,
        scale=scale,
    )
    got, expected, _ = looked_up(device, texture)
    assert np.abs(got - expected).max() <= 2 * 2.0**-9 + 1e-5


def test_a_quarter_turn_is_anticlockwise(device):
    """KHR_texture_transform: rotation turns the coordinates anticlockwise, so that the image turns clockwise."""
    corners = image([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]])
    texture = Texture(corners, mag_filter="nearest", min_filter="nearest", rotation=np.pi / 2)
    seen = points(device, scene_of(facing(Material("turned", base_color_texture=texture))), (2, 2)).base_color
    # (u, v) → (v, −u): the top left pixel (¼, ¼) looks at (¼, −¼ ≡ ¾), the image's bottom left.
    assert np.array_equal(seen, [[[0, 0, 1], [1, 0, 0]], [[1, 1, 1], [0, 1, 0]]])


def test_the_second_set_of_coordinates(device):
    texture = Texture(image(UNITS.random((4, 4, 3)).astype(np.float32), np.float32), texcoord=1, min_filter="linear")
    got, expected, _ = looked_up(device, texture)
    assert np.abs(got - expected).max() <= 2 * 2.0**-9 + 1e-5


def test_mipmaps_average_what_is_smaller_than_a_pixel(device):
    checks = np.indices((64, 64)).sum(axis=0) % 2
    sharp = Texture(image(checks.astype(np.float32), np.float32), min_filter="nearest", mag_filter="nearest")
    soft = Texture(image(checks.astype(np.float32), np.float32), min_filter="linear_mipmap_linear")
    seen = {
        t.min_filter: points(device, scene_of(facing(Material("checks", base_color_texture=t))), (8, 8))
        for t in (sharp, soft)
    }
    assert set(np.unique(seen["nearest"].base_color)) <= {0.0, 1.0}
    assert np.abs(seen["linear_mipmap_linear"].base_color - 0.5).max() < 1e-3


@pytest.mark.parametrize("own", ["nearest", "linear_mipmap_linear"])
def test_one_filter_can_be_set_for_every_texture(device, own):
    """Whatever the sampler says: `nearest` sees single texels, mipmaps see their mean."""
    checks = np.indices((64, 64)).sum(axis=0) % 2
    texture = Texture(image(checks.astype(np.float32), np.float32), min_filter=own)
    scene = scene_of(facing(Material("checks", base_color_texture=texture)))
    seen = {}
    for name in ("nearest", "linear_mipmap_linear"):
        choice = Choice(settings={"texture_filtering": {"filter": name}})
        seen[name] = renderer(device, scene, (8, 8), choice).capture(terms=False).points.base_color
    assert set(np.unique(seen["nearest"])) <= {0.0, 1.0}
    assert np.abs(seen["linear_mipmap_linear"] - 0.5).max() < 1e-3


def test_anisotropy_keeps_what_a_tilted_surface_shows(device):
    """Stripes along the direction in which the card recedes: mipmaps blur them away, a narrow footprint does not."""
    stripes = np.broadcast_to(np.arange(64) // 4 % 2, (64, 64)).astype(np.float32)
    material = Material("stripes", base_color_texture=Texture(image(stripes, np.float32)))
    tilt = np.eye(4)
    tilt[1:3, 1:3] = [[0.1, -0.995], [0.995, 0.1]]  # 84° about the x axis: sixteen texels a pixel along y, one along x
    scene = scene_of(facing(material, matrix=tilt))
    spread = {}
    for ratio in (1.0, 16.0):
        choice = Choice(settings={"texture_filtering": {"anisotropy": ratio}})
        points = renderer(device, scene, (64, 64), choice).capture(terms=False).points
        spread[ratio] = points.base_color[points.hit].std()
    assert spread[16.0] > 2 * spread[1.0]


def test_mipmaps_of_srgb_images_average_light(device):
    checks = (np.indices((64, 64)).sum(axis=0) % 2 * 255).astype(np.uint8)
    texture = Texture(image(checks), srgb=True)
    seen = points(device, scene_of(facing(Material("checks", base_color_texture=texture))), (8, 8))
    assert np.abs(seen.base_color - 0.5).max() < 0.01  # levels are stored in 8 bits


def test_factors_multiply_the_textures(device):
    packed = Texture(image(np.float32([[[0.9, 0.5, 0.25]]]), np.float32), min_filter="linear")
    material = Material(
        "all",
        (0.5, 0.6, 0.7),
        metallic=0.8,
        roughness=0.6,
        specular=0.3,
        emissive=(2.0, 4.0, 8.0),
        base_color_texture=packed,
        metallic_roughness_texture=packed,
        occlusion_texture=packed,
        occlusion_strength=0.5,
        emissive_texture=packed,
    )
    seen = points(device, scene_of(facing(material)), (4, 4))
    expected = {
        "base_color": (0.45, 0.3, 0.175),
        "metallic": 0.2,
        "roughness": 0.3,
        "specular": 0.3,
        "occlusion": 1 + 0.5 * (0.9 - 1),
        "emission": (1.8, 2.0, 2.0),
    }
    for name, value in expected.items():
        assert np.abs(getattr(seen, name) - value).max() < 4e-7 * np.max(value), name


def test_a_texture_whose_coordinates_lack_is_left_out(device):
    material = Material("bare", (0.5, 0.5, 0.5), base_color_texture=Texture(image([[0]])))
    assert np.allclose(points(device, scene_of(card(FRONT, material)), (8, 8)).base_color[4, 4], 0.5)


def test_the_background_is_the_environment(device):
    maker = renderer(device, scene_of(card(FRONT), radiance=(0.25, 0.5, 2.0)), (16, 16), Choice(without=("narkowicz",)))
    seen = maker.capture(terms=False).points
    assert np.allclose(maker.render().radiance[~seen.hit], (0.25, 0.5, 2.0))
    assert np.allclose(seen.emission[~seen.hit], (0.25, 0.5, 2.0))
