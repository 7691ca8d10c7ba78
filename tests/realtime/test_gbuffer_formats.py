"""The G-buffer's formats: what each does to what it holds, against closed forms; in the frame and in captures alike."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime import layout
from lightmeter.realtime.graph import Choice
from lightmeter.realtime.packing_twins import quantised_normals
from lightmeter.scenes import shapes
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Material, Mesh, Shape
from lightmeter.scenes.optics.color import srgb_decode, srgb_encode

from .small_scenes import LAMP, camera, moved, renderer, scene_of

SIZE = (48, 40)
OFFSET = (0.3, -0.2)
NEAR, FAR = 0.1, 20.0
FLOATS = ("packed_surface", "packed_material")


def packed(**knobs) -> Choice:
    """Both packing effects; what is not named is kept in floats."""
    surface = {"position": "fp32", "normal": "fp32"}
    material = {"albedo": "fp32", "parameters": "fp32"}
    for name, value in knobs.items():
        (material if name in material else surface)[name] = value
    return Choice(use=FLOATS, settings={"packed_surface": surface, "packed_material": material})


def ball(view=None, at=(0.0, 0.0, 0.0), **material):
    """A smooth sphere over a floor, and colours from vertices."""
    round_mesh = shapes.sphere(0.6, 24, 12)
    shades = np.random.default_rng(1).random((len(round_mesh.positions), 4)).astype(np.float32)
    colored = replace(round_mesh, colors=shades)
    floor = shapes.plane(3, 3)
    made = Material("made", metallic=0.31, roughness=0.47, **material)
    placed = (
        Shape("ball", colored, made, moved(*at)),
        Shape("floor", floor, Material("other", roughness=0.91, metallic=0.0), moved(at[0], at[1] - 0.6, at[2])),
    )
    lens = view or {"yfov": 0.9}
    eye = np.add(at, (0.4, 0.5, 2.5))
    return scene_of(*placed, view=camera(tuple(eye), at, near=NEAR, far=FAR, **lens), lights=(LAMP,))


def both(device, scene, choice: Choice):
    """The points in floats and as stored, where a surface is seen."""
    there = renderer(device, scene, SIZE, choice)
    floats = there.capture(OFFSET, terms=False, exact=FLOATS).points
    stored = there.capture(OFFSET, terms=False).points
    np.testing.assert_array_equal(floats.hit, stored.hit)
    return floats.at(floats.hit), stored.at(stored.hit)


def test_in_floats_nothing_changes(device):
    floats, stored = both(device, ball(), packed())
    for name in ("position", "normal", "base_color", "roughness", "metallic"):
        np.testing.assert_array_equal(getattr(floats, name), getattr(stored, name))


@pytest.mark.parametrize("bits", layout.NORMAL_BITS)
def test_octahedral_normals_are_quantised_as_the_twin_says(device, bits):
    """Where a coordinate lies within float32's rounding of the middle of two codes, either is right: a step apart.

    The largest angle: a step of d = 1/(2ᵇ⁻¹ − 1) moves the point on the octahedron by up to (d/2, d/2, −d), which is
    √1.5·d long, at the distance 1/√3 in the middle of a face, hence 3/√2·d: 0.957°, 0.0594° and 0.00371°.
    """
    floats, stored = both(device, ball(), packed(normal=f"oct{bits}"))
    expected = quantised_normals(floats.normal.astype(np.float64).T, bits).T
    step = 1 / (2 ** (bits - 1) - 1)
    same = np.linalg.norm(stored.normal - expected, axis=1) < 1e-6
    assert same.mean() > (0.999 if bits < 16 else 0.95)
    angles = np.linalg.norm(stored.normal - floats.normal.astype(np.float64), axis=1)
    assert angles.max() < 3 / np.sqrt(2) * step + 1e-6
    np.testing.assert_allclose(np.linalg.norm(stored.normal, axis=1), 1, atol=3e-7)


@pytest.mark.parametrize(("bits", "paper"), [(8, 0.95), (12, 0.059), (16, 0.0037)])
def test_the_largest_angle_of_octahedral_normals(bits, paper):
    """The bound of the test before is reached, but not passed, over the whole sphere."""
    normals = np.random.default_rng(2).normal(size=(3, 400_000))
    normals /= np.linalg.norm(normals, axis=0)
    largest = np.linalg.norm(quantised_normals(normals, bits) - normals, axis=0).max()
    bound = 3 / np.sqrt(2) / (2 ** (bits - 1) - 1)
    assert 0.9 * bound < largest <= bound * 1.01
    assert np.degrees(largest) < paper * 1.01


def toward_zero(values: np.ndarray) -> np.ndarray:
    """Half floats no larger than float32 values: OpenGL leaves it to the driver how they are rounded; llvmpipe cuts."""
    nearest = values.astype(np.float16)
    return np.where(np.abs(nearest.astype(np.float32)) > np.abs(values), np.nextafter(nearest, np.float16(0)), nearest)


def test_normals_in_half_floats(device):
    """A component below 1 is off by 2⁻¹¹ at most (by half of that where the driver rounds), all three by √3 of it."""
    floats, stored = both(device, ball(), packed(normal="fp16"))
    errors = np.linalg.norm(stored.normal - floats.normal.astype(np.float64), axis=1)
    assert 0.2 * np.sqrt(3) * 2**-11 < errors.max() <= np.sqrt(3) * 2**-11


@pytest.mark.parametrize("distance", [0.0, 1000.0])
def test_positions_in_half_floats_depend_on_the_distance_from_the_origin(device, distance):
    """A unit in the last place of 11 bits, or half of one: at 1,000 m half a metre."""
    floats, stored = both(device, ball(at=(distance, 0.0, 0.0)), packed(position="fp16"))
    rounded, cut = floats.position.astype(np.float16), toward_zero(floats.position)
    assert ((stored.position == rounded) | (stored.position == cut)).all()
    assert np.abs(stored.position - floats.position).max() > (0.2 if distance else 1e-4)


def step_of(encoding: str, bits: int, z: np.ndarray, parallel: bool) -> np.ndarray:
    """How far apart two neighbouring depths lie at distances z, metres: the step of the code over |d(depth)/dz|."""
    slope = np.full_like(z, 1 / (FAR - NEAR)) if encoding == "linear" or parallel else NEAR * FAR / (FAR - NEAR) / z**2
    if bits < 32:
        return 1 / (2**bits - 2) / slope
    depth = {"linear": (z - NEAR) * slope, "standard": 1 - NEAR / z, "reversed": NEAR / z}[encoding]
    if parallel:
        depth = (FAR - z) * slope if encoding == "reversed" else (z - NEAR) * slope
    return np.spacing(depth.astype(np.float32)) / slope


@pytest.mark.parametrize("lens", [{"yfov": 0.9}, {"ymag": 1.0}], ids=["perspective", "parallel"])
@pytest.mark.parametrize("bits", layout.DEPTH_BITS)
@pytest.mark.parametrize("encoding", layout.DEPTH_ENCODINGS)
def test_positions_rebuilt_from_depth(device, lens, encoding, bits):
    """Along the view: half a step. And where float32 is no finer than that: the distance from world space (4 roundings
    of ~3 m) and some 8 roundings of the depth's formula, whose terms are up to 1, over the depth's slope; for reversed
    depths they are relative to the depth itself.

    Across it: the rasteriser's vertices lie on a grid of 1/256 of a pixel, so a point is off its pixel by half of that,
    2⁻⁹ in each direction, times what the surface's slope makes of it along the view.
    """
    scene = ball(lens)
    floats, stored = both(device, scene, packed(position="depth", depth_encoding=encoding, depth_bits=bits))
    forward, eye = -scene.camera.matrix[:3, 2], scene.camera.position
    z = (floats.position - eye) @ forward
    moved_by = stored.position.astype(np.float64) - floats.position
    parallel = "ymag" in lens
    step = step_of(encoding, bits, z, parallel)
    one_by_slope = step_of(encoding, 16, z, parallel) * (2**16 - 2)
    depth = NEAR / z if encoding == "reversed" and not parallel else 1.0
    rounding = 2.0**-24 * (8 * 3 + 8 * depth * one_by_slope)
    along = np.abs(moved_by @ forward)
    assert (along <= step / 2 + rounding).all()
    if bits == 16:
        assert along.max() > 0.4 * step[along.argmax()]
    pixel = 2 / SIZE[1] if parallel else 2 * np.tan(0.45) / SIZE[1] * z
    spread = 1.0 if parallel else np.linalg.norm(floats.position - eye, axis=1) / z
    across = np.linalg.norm(moved_by - np.outer(moved_by @ forward, forward), axis=1)
    assert (across <= np.sqrt(2) * 2.0**-9 * pixel + spread * along + 3e-6).all()


def test_reversing_helps_floats_alone():
    """z² / near·2⁻ᵇ, the standard depth's step, against a relative 2⁻²⁴ of a reversed float's."""
    z = np.geomspace(0.2, 19, 50)
    np.testing.assert_allclose(step_of("reversed", 16, z, False), step_of("standard", 16, z, False))
    assert (step_of("reversed", 32, z, False) / z < 2.5 * 2.0**-23).all()
    assert (step_of("standard", 32, z[-1:], False) > 50 * step_of("reversed", 32, z[-1:], False)).all()


@pytest.mark.parametrize("albedo", layout.BASE_COLORS)
def test_base_colours_of_eight_bits(device, albedo):
    """Rounded to one of 256 values, of light or of sRGB's codes; a code may be off by one where it is about a half."""
    floats, stored = both(device, ball(), packed(albedo=albedo))
    encode, decode = (srgb_encode, srgb_decode) if albedo == "srgb8" else (np.float64, np.float64)
    codes = encode(stored.base_color.astype(np.float64)) * 255
    assert np.abs(codes - np.round(codes)).max() < 2e-4
    assert np.abs(codes - encode(floats.base_color.astype(np.float64)) * 255).max() < 0.5 + 2e-3
    np.testing.assert_allclose(stored.base_color, decode(np.round(codes) / 255), atol=1e-6)


def test_parameters_of_eight_bits(device):
    floats, stored = both(device, ball(), packed(parameters="unorm8"))
    for name in ("roughness", "metallic"):
        expected = np.round(getattr(floats, name).astype(np.float64) * 255) / 255
        np.testing.assert_allclose(getattr(stored, name), expected, atol=1e-7)
    np.testing.assert_array_equal(stored.specular, floats.specular)  # the same everywhere: a constant, not stored


@pytest.mark.parametrize(
    "knobs",
    [
        {"position": "fp16", "normal": "fp16", "albedo": "linear8"},
        {"position": "depth", "depth_bits": 32, "normal": "oct12", "albedo": "srgb8", "parameters": "unorm8"},
        {"position": "depth", "depth_encoding": "linear", "depth_bits": 24, "normal": "oct8", "parameters": "unorm8"},
        {"normal": "oct16"},
        {"albedo": "srgb8"},
    ],
    ids=lambda knobs: "-".join(map(str, knobs.values())),
)
def test_captures_add_up_to_the_frame_in_every_format(device, knobs):
    """The frame reads its packed G-buffer; captures read what was stored and unpacked. They are one picture."""
    there = renderer(device, load("posts"), SIZE, packed(**knobs))
    frame, found = there.render().radiance, there.capture()
    total = found.points.emission.astype(np.float64)
    total += sum(found.direct[light] * found.visibility[light] for light in found.direct)
    total += found.frame["environment"] + found.frame["indirect"]
    # A handful of float32 additions and products of values up to the brightest.
    np.testing.assert_allclose(total, frame, atol=16 * 2.0**-24 * frame.max())
    plain = renderer(device, load("posts"), SIZE).render().radiance
    assert np.abs(plain - frame).max() > 1e-5 * frame.max()


def test_the_dark_back_of_a_surface_stays_dark(device):
    """A single-sided surface's back has no normal: an octahedron has a code for that."""
    mesh = Mesh(np.float32([[-0.9, -0.9, 0], [0, 0.9, 0], [0.9, -0.9, 0]]), np.array([[0, 1, 2]]))
    scene = scene_of(Shape("back", mesh, Material("m")), lights=(LAMP,))
    for normal in layout.NORMALS:
        found = renderer(device, scene, SIZE, packed(normal=normal)).capture().points
        assert found.hit.any() and (found.normal[found.hit] == 0).all()


def test_what_is_not_asked_for_costs_nothing(device):
    plain = renderer(device, ball(), SIZE)
    assert not {"packed_surface", "packed_material"} & set(plain.plan.effects)
    assert plain.plan.stored() == {}
    assert "STORED_FORMATS" not in {name for name, value in plain._stage.gbuffer.defines().items() if value}


def test_bytes_per_pixel():
    assert layout.bytes_per_pixel({"position": "fp32", "normal": "fp32"}) == 28
    assert layout.bytes_per_pixel({"position": "reversed32", "normal": "oct8"}) == 4 + 2
    assert layout.bytes_per_pixel({"position": "standard24", "normal": "oct12"}) == 3 + 3
    assert layout.bytes_per_pixel({"base_color": "srgb8", "parameters": "unorm8"}) == 3 + 4
