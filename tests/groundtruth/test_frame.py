"""A scene's truth is the same wherever the scene is and whatever its size: all is traced where float32 does best."""

import math
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
import pytest

from lightmeter.groundtruth.ambient_occlusion import ambient_occlusion
from lightmeter.groundtruth.content import scene_key
from lightmeter.groundtruth.frame import MOST, WORLD, Frame
from lightmeter.groundtruth.mirrored import mirrored_hits
from lightmeter.groundtruth.oracles import environment_visibility, indirect, material, visibility
from lightmeter.groundtruth.primary import seen_emission, surface_points
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.world import World
from lightmeter.scenes import library, shapes
from lightmeter.scenes.load import load
from lightmeter.scenes.model import (
    DirectionalLight,
    Environment,
    Image,
    Material,
    PointLight,
    Scene,
    Shape,
    SpotLight,
    Texture,
)
from lightmeter.scenes.moving import moved, scaled
from lightmeter.scenes.points import SurfacePoints

from .small_scenes import looking, placed, rectangle

AWAY = np.array([1000.0, 300.0, -1000.0])
SMALL = 2.0**-10
SIZE = (16, 12)


def stage(camera=None) -> Scene:
    """All kinds of lights, a textured floor, a textured lamp, a map around, and a ball and a slab that cast shadows."""
    texels = np.random.default_rng(5).integers(40, 255, (8, 8, 3), np.uint8)
    checks = Texture(Image(texels), mag_filter="nearest")
    ground = Material("ground", base_color_texture=checks, roughness=0.4)
    lamp = Material("lamp", (0.1, 0.1, 0.1), emissive=(6.0, 5.0, 4.0), emissive_texture=checks, double_sided=True)
    glow = Material("glow", (0.1, 0.1, 0.1), emissive=(3.0, 4.0, 6.0))
    sky = np.random.default_rng(6).random((4, 8, 3), np.float32)
    return Scene(
        "stage",
        (
            Shape("floor", rectangle((-3, 0, 3), (6, 0, 0), (0, 0, -6)), ground),
            Shape("ball", shapes.sphere(0.5, 24), Material(metallic=1.0, roughness=0.3), placed(y=0.6)),
            Shape("slab", shapes.box(0.6, 0.1, 0.6), Material(base_color=(0.8, 0.3, 0.2)), placed(-1.0, 0.2, 0.4)),
            Shape("lamp", rectangle((0.9, 0.8, -0.6), (0, 0.7, 0), (0, 0, 0.8)), lamp),
            Shape("glow", rectangle((-1.6, 0.6, -0.8), (0.7, 0, 0), (0, 0.7, 0)), glow),
        ),
        looking((0.3, 1.6, 3.6), (0, 0.4, 0), yfov=0.75) if camera is None else camera,
        (
            PointLight("point", (1.2, 2.0, 1.5), (5.0, 4.0, 3.0), range=6.0),
            SpotLight("spot", (-1.5, 2.2, 1.0), (0.55, -0.75, -0.37), (9.0, 9.0, 6.0), 0.2, 0.5),
            DirectionalLight("sun", (-0.5, -0.8, -0.3), (1.0, 0.9, 0.8)),
        ),
        Environment((0.5, 0.5, 0.5), Image(sky)),
        max_depth=3,
    )


@dataclass(frozen=True, eq=False)
class Place:
    """Where a copy of the stage is: enlarged, then moved."""

    size: float = 1.0
    by: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def scene(self, scene: Scene) -> Scene:
        return moved(scaled(scene, self.size), self.by)

    def positions(self, positions: np.ndarray) -> np.ndarray:
        return positions.astype(np.float64) * self.size + self.by


HERE = Place()
COPIES = {"away": Place(1.0, AWAY), "small": Place(SMALL), "small and away": Place(SMALL, SMALL * AWAY)}
"""The G-buffer's points of those that are away are rounded to 2⁻¹⁵ of a metre of the stage, as they are there."""

POINTWISE = ("light 0", "light 1", "light 2", "light 3", "light 4", "around", "indirect", "occlusion")


@cache
def stage_points() -> SurfacePoints:
    return surface_points(World.of(stage()), SIZE)


@cache
def everything(place: Place) -> tuple[Frame, dict[str, np.ndarray]]:
    """What the truth says of the stage at a place, at the same points and with the same random numbers everywhere.

    No world is kept: with two of them alive Dr.Jit compiles its kernels anew.
    """
    found = {}
    eye = looking((0.3, 1.6, 3.6), (0, 0.4, 0), ymag=1.3)
    found["orthographic"] = render_batch(World.of(place.scene(stage(eye))), SIZE, 8, 0)
    points = stage_points()
    points = replace(points, position=place.positions(points.position).astype(np.float32))
    world = World.of(place.scene(stage()))
    found["reference"] = render_batch(world, SIZE, 8, 0)
    found["emission"] = seen_emission(world, SIZE, spp=8)
    for light in range(5):
        found[f"light {light}"] = visibility.evaluate(world, points, light, spp=8)
    found["around"] = environment_visibility.evaluate(world, points, spp=8)
    found["indirect"] = indirect.evaluate(world, points, spp=8)
    found["occlusion"] = ambient_occlusion(world, points, RADIUS * place.size, spp=8)
    found["mirrored"] = mirrored_hits(world, points)
    seen, exact = surface_points(world, SIZE), material.evaluate(world, points)
    found |= {"seen": seen.position, "shapes": seen.shape, "kept": exact.position}
    found |= {"color": exact.base_color, "roughness": exact.roughness, "normal": exact.normal}
    return world.frame, found


RADIUS = 0.4
"""Metres of the stage: how far ambient occlusion reaches."""

SAME = 0.02
"""RMS difference over the mean of what is evaluated with the same random numbers. Rays start 2·10⁻⁴ of a scene's extent
off their surfaces or less, and points that a G-buffer stores are rounded by less than that: a shadow's edge moves by
1/300 of a pixel. Of 200 pixels less than one is likely to have one of its 8 samples on the other side, and that is
1/8 of its light, over √200."""


def difference(found: np.ndarray, expected: np.ndarray) -> float:
    """RMS, over the mean."""
    return float(np.sqrt(np.mean(np.square(found - expected, dtype=np.float64))) / np.abs(expected).mean())


@pytest.mark.parametrize("copy", COPIES)
@pytest.mark.parametrize("what", ["reference", "orthographic", "emission", *POINTWISE])
def test_light_is_the_same(what, copy):
    frame, found = everything(COPIES[copy])
    assert not frame.is_world
    assert difference(found[what], everything(HERE)[1][what]) < SAME


@pytest.mark.parametrize("copy", COPIES)
def test_what_is_told_is_in_the_world(copy):
    """Where rays from the camera and mirrored ones arrive, and the parameters there."""
    place = COPIES[copy]
    found, expected = everything(place)[1], everything(HERE)[1]
    same = (found["shapes"] == expected["shapes"]) & (found["shapes"] >= 0)
    assert same.mean() > 0.5
    assert np.abs(found["seen"] - place.positions(expected["seen"]))[same].max() < 2e-4 * place.size
    there, here = (np.any(images["mirrored"][1] != 0, axis=-1) for images in (found, expected))
    assert np.mean(there == here) > 0.99
    off = np.linalg.norm(found["mirrored"][0] - place.positions(expected["mirrored"][0]), axis=-1)
    assert np.median(off[there & here]) < 2e-3 * place.size
    assert not found["mirrored"][0][~there].any()
    for name in ("color", "roughness", "normal"):  # at a texel's edge a rounded point may read the next one
        assert np.isclose(found[name], expected[name], atol=1e-3).mean() > 0.99
    np.testing.assert_array_equal(found["kept"], place.positions(stage_points().position).astype(np.float32))


@pytest.mark.parametrize("distance", [1e3, 1e5, 1e6])
def test_vertices_are_moved_before_they_are_rounded(distance):
    """Float32 in the scene's own extent, 2⁻²⁴ · 6 m, and double at the distance."""
    scene, by = stage(), distance * np.array([1.0, 0.3, -1.0])
    there = moved(scene, by)
    frame = Frame.of(there)
    for mine, theirs in zip(frame.scene(there).shapes, scene.shapes, strict=True):
        expected = theirs.world.positions.astype(np.float64) + by - frame.origin
        found = mine.world.positions / frame.scale
        assert np.abs(found - expected).max() < 8 * 2.0**-24 + 4 * 2.0**-52 * distance


def tilted(half: float) -> Scene:
    """A white plane that lies in no plane of the axes, 1.5 m below the camera, in the light of a sun."""
    a, b = np.radians(31.0), np.radians(17.0)
    turn = np.array([[np.cos(b), -np.sin(b), 0], [np.sin(b), np.cos(b), 0], [0, 0, 1]])
    turn @= np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    matrix = np.eye(4)
    matrix[:3, :3] = turn
    plane = rectangle((-half * 0.93, 0, half * 0.87), (2 * half, 0, 0), (0, 0, -2 * half))
    camera = looking(turn @ (0.2, 1.5, 0.3), turn @ (0, 0, -1), yfov=0.8, up=turn[:, 1])
    sun = -(turn @ (0.3, 1, 0.2))
    lights = (DirectionalLight("sun", tuple(sun / np.linalg.norm(sun)), (math.pi, math.pi, math.pi)),)
    white = Material(base_color=(1, 1, 1), specular=0)
    return Scene("tilted", (Shape("plane", plane, white, matrix),), camera, lights, max_depth=2)


@pytest.mark.parametrize("half", [8.0, 2.0**12, 2.0**20])
def test_a_large_triangle_does_not_shadow_itself(half):
    """A white plane's radiance is its irradiance over π: the cosine, 1/√(0.3² + 1 + 0.2²)."""
    image = render_batch(World.of(tilted(half)), (8, 8), 4, 0)
    np.testing.assert_allclose(image, 1 / math.sqrt(1.13), rtol=1e-5)


def test_a_scene_that_suits_float32_is_traced_as_it_is():
    for name in library.names():
        scene = load(name)
        frame = Frame.of(scene)
        assert frame.is_world, name
        assert frame.scene(scene) is scene
    assert Frame.of(replace(stage(), shapes=())).is_world
    positions = np.float32([[1e6, 2, 3]])
    assert WORLD.enter(positions) is positions
    assert Frame.of(scaled(stage(), 4.0)).is_world  # the camera is 14 m from the origin
    for far in (scaled(stage(), 6.0), moved(stage(), [20.0, 0.0, 0.0]), scaled(stage(), 1 / 32)):
        assert not Frame.of(far).is_world


@pytest.mark.parametrize("size", [1e-20, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e12])
@pytest.mark.parametrize("distance", [0.0, 1e-3, 1.0, 1e3, 1e9])
def test_the_origin_is_near_and_the_scale_a_power_of_two(size, distance):
    """The extent is 16 u and up to twice that, or what the triangles need: √3/375 extents, and up to twice that."""
    scene = moved(scaled(tilted(8.0), size), distance * size * np.array([1.0, 0.3, -1.0]))
    frame = Frame.of(scene)
    assert math.frexp(frame.scale)[0] == 0.5
    if frame.is_world:
        assert size == 1.0
        assert distance <= 1.0
        return
    low, high = frame.scene(scene).bounds
    extent = np.abs([low, high]).max()
    slack = 1e-6 * extent
    assert (low <= slack).all()
    assert (high >= -slack).all()
    assert (frame.scale == MOST and extent < 16) or 16 - slack < extent < 375


def test_what_leaves_is_what_entered():
    frame = Frame(np.array([1e5, -3e4, 7.0]), 2.0**7)
    inside = np.random.default_rng(1).uniform(-20, 20, (100, 3)).astype(np.float32)
    outside = frame.leave(inside)
    assert outside.dtype == np.float32
    # Half a unit of float32 at 1e5, in this frame's lengths.
    np.testing.assert_allclose(frame.enter(outside), inside, atol=2.0**-8 * 2.0**7)
    near = Frame(np.zeros(3), 2.0**7)
    np.testing.assert_array_equal(near.enter(near.leave(inside)), inside)


def test_places_have_entries_of_their_own_in_the_store():
    keys = {scene_key(place.scene(stage())) for place in (HERE, *COPIES.values())}
    assert len(keys) == 1 + len(COPIES)
