"""Percentage-closer soft shadows against the closed form of a penumbra."""

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.effects.pcss.rectangle import half_sides
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Material, PointLight, Shape

from .small_scenes import WHITE, camera, moved, renderer, scene_of

GLOW = Material("glow", emissive=(3, 3, 3))
FLOOR = Shape("floor", shapes.plane(9, 9), WHITE)
HEIGHT = 2.0
TURN = look_at((0.6, 0.0, 0.8), (0, 0, 0))[:3, :3]


def lamp(mesh, x=0.0, z=0.0, turn=None) -> Shape:
    """A lamp that hangs above the floor and faces it."""
    place = moved(x, HEIGHT, z)
    place[:3, :3] = (np.eye(3) if turn is None else turn) @ np.diag([1.0, -1.0, -1.0])
    return Shape("lamp", mesh, GLOW, place)


def visibility_of(device, *placed, view, size=(64, 64), **knobs):
    """The points, and the lamp's visibility there by PCSS."""
    scene = scene_of(*placed, view=view)
    seen = renderer(device, scene, size, Choice(use=("pcss",), settings={"pcss": knobs})).capture()
    return seen.points, seen.visibility[0][..., 0].astype(np.float64)


@pytest.mark.parametrize("height", [0.7, 1.0, 1.2])
@pytest.mark.parametrize("axis", [0, 2])
@pytest.mark.parametrize("turned", [False, True])
def test_a_penumbra_is_as_wide_as_geometry_says(device, height, axis, turned):
    """The edge of a half plane at height h, under a rectangle at height H.

    Seen from x on the floor, an edge at 0 hides what of the lamp is below x·(1 − H/h). So the visible share grows from
    0 to 1 over 2a·h/(H − h), Fernando's width, for a lamp of half side a whose sides lie along the edge; for a turned
    one as the share of its area beyond a line. The half plane is parallel to the lamp: each blocker has the nearness
    1 − h/H, and PCSS is exact but for its map and its samples.

    Tolerance: the edge lies half a texel off at most, 2·(H − h)/resolution wide (it is less than 27° off the axis, so
    1.2 times that along the ray), H/h times as much on the floor, where the share grows by (H − h)/(2a·h) a metre at
    most; and a half plane has up to 2.5 of the lattice's 64 points too many or too few (seen over all edges along the
    sides and all shifts; 5.5 where it is turned). A mean over shifts has no error; over the 64 pixels along the edge,
    whose shifts are spread evenly, half a point is left.
    """
    half, aside, resolution, samples = np.array([0.3, 0.1]), 0.2, 1024, 64
    place, size = ((-5, height, 0), (10, 20)) if axis == 0 else ((0, height, -5), (20, 10))
    sheet = Shape("sheet", shapes.plane(*size), WHITE, moved(*place))
    turn = TURN if turned else np.eye(3)
    x, z = (aside, 0.0) if axis == 0 else (0.0, aside)
    light = lamp(shapes.plane(0.6, 0.2), x, z, turn)
    below = camera((0.0, 0.9 * height, 0.0), (0.0, 0.0, 0.0), ymag=0.9)
    points, seen = visibility_of(
        device, FLOOR, sheet, light, view=below, resolution=resolution, samples=samples, search=0.3
    )
    assert (points.shape == 0).all()
    grid = (np.arange(400) + 0.5) / 200 - 1
    profile = np.sort(np.add.outer(*(turn[axis, [0, 2]] * half)[:, None] * grid).ravel()) + aside
    at = points.position[..., axis].astype(np.float64)
    expected = 1 - np.searchsorted(profile, at * (1 - HEIGHT / height)) / len(profile)
    steepest = (HEIGHT - height) / height * np.max(1 / (profile[40000:] - profile[:-40000])) / 4
    texel = 1.2 * (HEIGHT - height) / resolution * HEIGHT / height
    assert np.abs(seen - expected).max() <= texel * steepest + (5.5 if turned else 2.5) / samples
    along = 0 if np.ptp(at, axis=0).max() < 1e-5 else 1
    assert np.abs((seen - expected).mean(axis=along)).max() <= texel * steepest + 0.5 / samples
    assert (seen == 0).any() and (seen == 1).any()


def test_a_floor_does_not_shadow_itself_however_wide_the_filter(device):
    """A lamp of twice its own height: rays of the filter meet the floor far away, at all slopes."""
    speck = Shape("speck", shapes.rectangle(0.01, 0.01), WHITE, moved(0, -0.1, 0))
    scene = FLOOR, speck, lamp(shapes.plane(8, 8))
    for view in (camera((0, 1.9, 0), (0, 0, 0), ymag=1.5), camera((3, 1, 3), (0, 0, 0), ymag=1.5)):
        points, seen = visibility_of(device, *scene, view=view, resolution=256, search=0.2)
        assert (points.shape == 0).sum() > 2000
        assert (seen[points.shape == 0] == 1).all()


def test_a_wall_beside_the_point_shadows_only_as_published(device):
    """What stands beside a point, farther up, is nearer to the lamp: a blocker as published. It hides nothing."""
    wall = Shape("wall", shapes.box(0.02, 2.0, 4.0), WHITE, moved(1.0, 1.0, 0.0))
    scene = FLOOR, wall, lamp(shapes.plane(0.8, 0.8), 0.3)
    view = camera((0.6, 1.9, 0.0), (0.6, 0.0, 0.0), ymag=0.38)
    for blockers, darkened in (("nearer", True), ("between", False)):
        points, seen = visibility_of(device, *scene, view=view, blockers=blockers)
        assert (points.shape == 0).all()
        assert (seen < 1).any() == darkened


def test_a_bulb_casts_a_penumbra_on_all_sides(device):
    """An emissive sphere of radius r at height H, a disk at h below it: the umbra's radius is (R·H − r·h)/(H − h)."""
    radius, height, disk = 0.3, 1.0, 0.5
    bulb = Shape("bulb", shapes.sphere(radius, segments=48, rings=24), GLOW, moved(0.0, HEIGHT, 0.0))
    cover = Shape("cover", shapes.disk(disk, segments=64), WHITE, moved(0.0, height, 0.0))
    view = camera((0, 0.9, 0), (0, 0, 0), ymag=2.2)
    points, seen = visibility_of(device, FLOOR, cover, bulb, view=view, resolution=512, samples=64)
    away = np.linalg.norm(points.position[..., [0, 2]], axis=-1)
    # The square that stands for the bulb has half sides of 0.87 r and corners at 1.22 r.
    umbra, lit = ((disk * HEIGHT - s * 1.25 * radius * height) / (HEIGHT - height) for s in (1, -1))
    edge = disk * HEIGHT / (HEIGHT - height)
    assert (seen[away < umbra - 0.02] == 0).all() and (seen[away > lit + 0.02] == 1).all()
    ring = np.abs(away - edge) < 0.05
    assert 0.4 < seen[ring].mean() < 0.6
    spread = [seen[ring & (np.abs(points.position[..., a]) > 0.9 * away)].mean() for a in (0, 2)]
    assert abs(spread[0] - spread[1]) < 0.05


TILT = look_at((0.3, 0.5, 0.8), (0, 0, 0))[:3, :3]


@pytest.mark.parametrize(
    ("mesh", "expected"),
    [
        (shapes.rectangle(0.6, 0.2), (0.3, 0.1)),
        (shapes.rectangle(0.4, 0.4, segments=7), (0.2, 0.2)),
        (shapes.disk(0.5, segments=256), (0.5 * 0.75**0.5,) * 2),
    ],
)
def test_the_rectangle_of_a_flat_emitter(mesh, expected):
    """A rectangle's own sides, also a square's, whose moments have no direction; a disk's second moments (R²/4)."""
    place = np.eye(4)
    place[:3, :3] = TILT
    shape = Shape("lamp", mesh, GLOW, place)
    scene = scene_of(FLOOR, shape)
    u, v, size = half_sides(scene, scene.area_lights[0])
    assert sorted(np.linalg.norm([u, v], axis=1)) == pytest.approx(sorted(expected), rel=1e-4) and size == 0
    assert u @ v == pytest.approx(0, abs=1e-6)
    assert np.abs(np.stack([u, v]) @ TILT @ mesh.normals[0]).max() < 1e-6
    if mesh.normals[0, 2]:  # along the sides
        assert np.abs(np.stack([u, v]) @ TILT[:, :2]).min() < 1e-6


def test_the_square_of_a_bulb():
    """A sphere is seen as a disk of its radius, whose second moments a square of half side √¾·R has."""
    bulb = Shape("bulb", shapes.sphere(0.3, segments=96, rings=48), GLOW)
    scene = scene_of(FLOOR, bulb)
    u, v, size = half_sides(scene, scene.area_lights[0])
    assert size == pytest.approx(0.75**0.5 * 0.3, rel=5e-3) and not u.any() and not v.any()


def test_other_lights_keep_their_hard_shadows():
    scene = scene_of(FLOOR, lamp(shapes.plane(1, 1)), lights=(PointLight("p", (0, 1, 0), (1, 1, 1)),))
    plan = compile_plan(scene, effects(), Choice(use=("pcss",)))
    assert plan.lights_of("pcss") == (1,) and plan.lights_of("shadow_map") == (0,)
    alone = compile_plan(scene_of(FLOOR, FLOOR, lights=scene.lights), effects(), Choice(use=("pcss",)))
    assert alone.why_absent("pcss") == "the scene has no light of the kinds it handles"
