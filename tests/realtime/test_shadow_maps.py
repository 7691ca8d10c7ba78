"""Shadow maps against geometry: where edges fall, no acne, no seams, holes where alpha has them."""

import numpy as np
import pytest

from lightmeter.realtime.effect import EffectError
from lightmeter.realtime.graph import Choice
from lightmeter.realtime.shadows import comparing
from lightmeter.realtime.shadows.views import CUBE_FACES, shadow_views
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import DirectionalLight, Material, Mesh, PointLight, Shape, SpotLight, Texture

from .small_scenes import WHITE, camera, facing, image, moved, renderer, scene_of

POSITION = (0.9, 2.5, 0.6)
DOWN = np.array((-0.32, -0.9, -0.2)) / np.linalg.norm((-0.32, -0.9, -0.2))
LIGHTS = {
    "directional": DirectionalLight("sun", tuple(DOWN), (1, 1, 1)),
    "spot": SpotLight("spot", POSITION, tuple(DOWN), (1, 1, 1), 0.5, 0.9),
    "wide spot": SpotLight("wide", POSITION, tuple(DOWN), (1, 1, 1), 0.5, 1.4),
    "point": PointLight("point", POSITION, (1, 1, 1)),
    "point over a corner of its cube": PointLight("low", (1.1, 1.1, 0.9), (1, 1, 1)),
}
FLOOR = Shape("floor", shapes.plane(5, 5), WHITE)
ABOVE = camera((0.0, 6.0, 0.0), (0.0, 0.0, 0.0), ymag=2.0)
BOX_LOW, BOX_HIGH = np.array((-0.45, 0.4, -0.35)), np.array((0.25, 0.8, 0.45))
BOX = Shape("box", shapes.box(*(BOX_HIGH - BOX_LOW)), WHITE, moved(*((BOX_LOW + BOX_HIGH) / 2)))


def visibility_of(device, scene, size=(64, 64), **knobs):
    """The points, and the first light's visibility there."""
    seen = renderer(device, scene, size, Choice(settings={"shadow_map": knobs})).capture()
    return seen.points, seen.visibility[0]


def towards(light, position):
    """Unit directions to the light and distances to it (infinite for a directional one)."""
    if isinstance(light, DirectionalLight):
        direction = -np.array(light.direction)
        return np.broadcast_to(direction, position.shape), np.full(position.shape[:-1], np.inf)
    offset = np.array(light.position) - position
    distance = np.linalg.norm(offset, axis=-1)
    return offset / distance[..., None], distance


def blocked(light, position):
    """Whether the box lies between points and the light, by slabs, float64."""
    direction, distance = towards(light, position)
    safe = np.where(np.abs(direction) < 1e-12, 1e-12, direction)
    first, second = (BOX_LOW - position) / safe, (BOX_HIGH - position) / safe
    enter, leave = np.minimum(first, second).max(axis=-1), np.maximum(first, second).min(axis=-1)
    return (enter < leave) & (leave > 0) & (enter < distance)


EDGES = [(name, *case) for name in LIGHTS for case in (("hard", 1.0, 128), ("hard", 1.0, 512), ("pcf3", 2.5, 128))]
EDGES += [("spot", "pcf3", 2.5, 512), ("directional", "pcf9", 6.5, 512), ("point", "pcf5", 3.7, 512)]
EDGES += [("directional", "poisson", 3.0, 512), ("point over a corner of its cube", "poisson", 3.0, 512)]


@pytest.mark.parametrize(("name", "filtering", "reach", "resolution"), EDGES)
def test_edges_are_where_geometry_says(device, name, filtering, reach, resolution):
    """A point whose surroundings are all lit, or all dark, has that visibility exactly.

    Its surroundings: as far as `reach` texels lie apart on the floor. A texel of the map is the light's `texel` wide
    across the light (times the distance), 1/cos θ times longer on the floor, and up to 1/cos 55° more at the edge of a
    cube's face. A hard map rounds to a texel's centre (half a texel's diagonal: 0.71); a square filter looks a texel or
    more further along both axes (2.12, 3.54, …, 6.36), the disk two texels further (2.71); the bias of up to one and a
    half texels moves a point towards the light along its own ray, which leaves it in place on the map.
    """
    light = LIGHTS[name]
    scene = scene_of(FLOOR, BOX, view=ABOVE, lights=(light,))
    points, visibility = visibility_of(device, scene, resolution=resolution, filter=filtering)
    floor = points.shape == 0
    position = points.position[floor].astype(np.float64)
    direction, distance = towards(light, position)
    views = shadow_views(scene, light, resolution, comparing.reach({"filter": filtering, "radius": 2.0}) + 1)
    texel = views.texels[0] * np.where(np.isfinite(distance), distance, 1) / direction[:, 1] * reach
    ring = [(np.cos(a) * r, 0, np.sin(a) * r) for a in np.arange(16) / 16 * 2 * np.pi for r in (0.5, 1.0)]
    around = [blocked(light, position + texel[:, None] * np.array(step)) for step in ring]
    dark, lit = np.all(around, axis=0), ~np.any(around, axis=0)
    if isinstance(light, SpotLight):
        lit &= -direction @ np.array(light.direction) > np.cos(light.outer)
    assert dark.sum() > 20 and lit.sum() > 400
    got = visibility[floor]
    assert (got[dark] == 0).all()
    assert (got[lit] == 1).all()


@pytest.mark.parametrize("name", LIGHTS)
@pytest.mark.parametrize("filtering", ["hard", "pcf3"])
def test_nothing_shadows_itself(device, name, filtering):
    """Default biases, from coarse to fine maps, on a tilted plane and on a ball.

    The normal that slopes are measured with is interpolated: a ball of 192 segments keeps it within a degree of the
    triangle's. Nearly grazing light (n·l < 0.1, a tenth of what arrives) is left out.
    """
    light = LIGHTS[name]
    tilted = np.eye(4)
    tilted[:3, :3] = look_at((0.9, 1.0, 0.5), (0, 0, 0))[:3, :3]
    plane = Shape("tilted", shapes.rectangle(3, 3), WHITE, tilted)
    ball = Shape("ball", shapes.sphere(0.8, segments=192), WHITE)
    for shape in (plane, ball):
        for resolution in (64, 512, 2048):
            # One flat shape alone has no visibility at all; a small one below brings it back.
            speck = Shape("speck", shapes.rectangle(0.01, 0.01), WHITE, moved(0, -1.5, 0))
            scene = scene_of(shape, speck, view=ABOVE, lights=(light,))
            points, visibility = visibility_of(device, scene, resolution=resolution, filter=filtering)
            seen = points.shape == 0
            direction, _ = towards(light, points.position.astype(np.float64))
            lit = seen & (np.sum(direction * points.normal, axis=-1) > 0.1)
            if isinstance(light, SpotLight):
                lit &= -direction @ np.array(light.direction) > np.cos(light.outer)
            assert lit.sum() > 150
            assert (visibility[lit] < 1).mean() <= 0.002, (shape.name, resolution)


def test_a_cube_has_no_seams(device):
    """A floor that five faces see from close by, and a room around the light: all lit."""
    near = PointLight("near", (0.05, 0.7, 0.1), (1, 1, 1))
    inside = Material("walls", (1, 1, 1), double_sided=True)
    room = Shape("room", shapes.box(3, 3, 3), inside)
    speck = Shape("speck", shapes.rectangle(0.01, 0.01), WHITE, moved(0, -1.4, 0))
    for shape, view in (
        (FLOOR, camera((0, 6, 0), (0, 0, 0), ymag=2.4)),
        (room, camera((0.1, 0.2, -0.3), (1, 0.4, 1), yfov=2.2)),
    ):
        for filtering in ("hard", "pcf3"):
            scene = scene_of(shape, speck, view=view, lights=(near,))
            points, visibility = visibility_of(device, scene, (96, 96), resolution=128, filter=filtering)
            direction, _ = towards(near, points.position.astype(np.float64))
            lit = (points.shape == 0) & (np.sum(direction * points.normal, axis=-1) > 0.1)
            # In a corner of the room the filter's neighbours are on the other wall, which does stand in the way.
            lit &= np.sort(np.abs(points.position), axis=-1)[..., 1] < (1.4 if shape is room else np.inf)
            assert lit.sum() > 3000
            assert (visibility[lit] == 1).all()


def test_each_face_of_the_cube_sees_its_own_axis():
    """A point straight along each axis lands in the middle of that face; texels on a border repeat the neighbour's."""
    scene = scene_of(FLOOR, BOX, lights=(LIGHTS["point"],))
    views = shadow_views(scene, LIGHTS["point"], 64, 2)
    for matrix, (look, up) in zip(views.matrices, CUBE_FACES, strict=True):
        ahead = matrix @ np.append(np.array(POSITION) + look, 1.0)
        assert np.allclose(ahead[:2], 0) and ahead[3] == pytest.approx(1)
        corner = matrix @ np.append(np.array(POSITION) + look + np.array(up), 1.0)
        assert corner[1] / corner[3] == pytest.approx(1 - 4 / 64)


@pytest.mark.parametrize(("outer", "faces"), [(74, 1), (76, 6), (90, 6)])
def test_a_spot_wider_than_75_degrees_takes_a_cube(outer, faces):
    spot = SpotLight("s", (0, 2, 0), (0, -1, 0), (1, 1, 1), 0.1, np.radians(outer))
    assert len(shadow_views(scene_of(FLOOR, lights=(spot,)), spot, 64, 1).matrices) == faces


def test_an_emitter_does_not_shadow_its_own_light(device):
    glow = Material("glow", emissive=(3, 3, 3))
    down = look_at((0, 1, 0), (0, 0, 0))
    panel = np.eye(4)
    panel[:3, :3] = -down[:3, :3] @ np.diag([1, -1, 1])  # its front, +Z, faces −Y
    panel[:3, 3] = 0, 1.5, 0
    scene = scene_of(FLOOR, Shape("panel", shapes.rectangle(1, 1), glow, panel), view=camera((3, 1, 3), yfov=0.6))
    points, visibility = visibility_of(device, scene, filter="hard")
    floor = points.shape == 0
    assert floor.sum() > 500
    assert (visibility[floor] == 1).all()
    bulb = scene_of(FLOOR, Shape("bulb", shapes.sphere(0.2), glow, moved(0, 1.5, 0)), view=scene.camera)
    points, visibility = visibility_of(device, bulb, filter="hard")
    assert (visibility[points.shape == 0] == 1).all()
    shaded = scene_of(*scene.shapes, BOX, view=scene.camera)
    points, visibility = visibility_of(device, shaded, filter="hard")
    assert (visibility[points.shape == 0] == 0).any()


def leaf(material: Material, colors=None) -> Shape:
    """A square metre that lies half a metre above the floor."""
    sheet = shapes.plane(1, 1)
    mesh = Mesh(sheet.positions, sheet.triangles, sheet.normals, sheet.texcoords, colors=colors)
    return Shape("leaf", mesh, material, moved(0, 0.5, 0))


@pytest.mark.parametrize("name", ["directional", "point"])
def test_a_masked_leaf_casts_a_shadow_with_holes(device, name):
    """Two of four quarters are cut out; each quarter's shadow is where the light through it meets the floor."""
    texels = image([[[255, 255, 255, 255], [255, 255, 255, 0]], [[255, 255, 255, 0], [255, 255, 255, 255]]])
    texture = Texture(texels, min_filter="nearest", mag_filter="nearest")
    cut = Material("leaf", base_color_texture=texture, alpha_mode="mask", double_sided=True)
    light = LIGHTS[name]
    scene = scene_of(FLOOR, leaf(cut), view=ABOVE, lights=(light,))
    points, visibility = visibility_of(device, scene, (96, 96), filter="hard", resolution=1024)
    floor = points.shape == 0
    position = points.position[floor].astype(np.float64)
    direction, _ = towards(light, position)
    through = position + direction * ((0.5 - position[:, 1]) / direction[:, 1])[:, None]
    u, v = through[:, 0] + 0.5, through[:, 2] + 0.5
    inside = (u > 0) & (u < 1) & (v > 0) & (v < 1)
    dark = inside & ((u < 0.5) == (v < 0.5))
    sure = np.min([np.abs(u), np.abs(u - 0.5), np.abs(u - 1), np.abs(v), np.abs(v - 0.5), np.abs(v - 1)], axis=0) > 0.02
    assert (sure & dark).sum() > 50 and (sure & inside & ~dark).sum() > 20
    assert np.array_equal(visibility[floor][sure][:, 0] == 0, dark[sure])


@pytest.mark.parametrize(("alpha", "shadow"), [(0.49, False), (0.51, True)])
def test_alpha_of_factor_and_vertices_decides_without_a_texture(device, alpha, shadow):
    factor = leaf(Material("factor", alpha=alpha, alpha_mode="mask"))
    painted = leaf(Material("painted", alpha_mode="mask"), np.tile(np.float32([1, 1, 1, alpha]), (4, 1)))
    both = leaf(Material("both", alpha=0.8, alpha_mode="mask"), np.tile(np.float32([1, 1, 1, alpha / 0.8]), (4, 1)))
    for shape in (factor, painted, both):
        scene = scene_of(FLOOR, shape, view=ABOVE, lights=(LIGHTS["directional"],))
        points, visibility = visibility_of(device, scene, filter="hard", resolution=256)
        assert (visibility[points.shape == 0] == 0).any() == shadow, shape.material.name


def test_what_is_farther_than_the_light_casts_nothing(device):
    """A card behind the light, and a floor that the light's cone does not reach."""
    behind = facing(WHITE, 4, 4, moved(0, 0, 3.0))
    light = PointLight("between", (0, 0, 2), (1, 1, 1))
    scene = scene_of(facing(WHITE), behind, view=camera((0, 0, 2.5)), lights=(light,))
    points, visibility = visibility_of(device, scene, filter="hard")
    assert (points.shape == 0).all()
    assert (visibility == 1).all()


GRAZING = {
    "directional": DirectionalLight("sun", (-0.6, -0.002, -0.8), (1, 1, 1)),
    "point": PointLight("point", (2.7, 0.03, 0.3), (1, 1, 1)),
    "spot": SpotLight("spot", (-2.8, 0.05, 0.3), (1.0, 0.0, 0.0), (1, 1, 1), 0.5, 0.9),
}


@pytest.mark.parametrize("filtering", ["hard", "pcf3", "poisson"])
@pytest.mark.parametrize("name", GRAZING)
def test_a_plane_that_light_grazes_does_not_shadow_itself(device, name, filtering):
    """The slope bias is exact on a plane, whatever its slope; n·l is 0.002 under the sun, from 0.006 elsewhere."""
    speck = Shape("speck", shapes.rectangle(0.01, 0.01), WHITE, moved(0, -0.5, 0))
    scene = scene_of(FLOOR, speck, view=ABOVE, lights=(GRAZING[name],))
    points, visibility = visibility_of(device, scene, resolution=512, filter=filtering)
    assert (visibility[points.shape == 0] == 1).all()


SPHERE = Shape("ball", shapes.sphere(0.8, segments=192), WHITE)


def acne(device, faces="both", **knobs) -> float:
    """The share of a lit ball's points that are not lit, without biases but those given."""
    scene = scene_of(SPHERE, view=ABOVE, lights=(LIGHTS["directional"],))
    none = {"resolution": 512, "filter": "hard", "bias": 0.0, "slope_bias": 0.0}
    points, visibility = visibility_of(device, scene, faces=faces, **(none | knobs))
    lit = points.hit & (points.normal @ -DOWN > 0.1)
    return float((visibility[lit] < 1).mean())


def test_every_remedy_of_acne_helps_by_itself(device):
    """Where there is plenty without one. Of a body's back faces none stands before its lit front.

    A point that lies k·sin θ texels off a plane lies k·sin θ/cos θ before it, along the light. A texel's corner is √½
    of a texel away, and the plane's depth changes by √½·tan θ up to there: k = √½ is enough.
    """
    assert acne(device) > 0.1
    assert acne(device, faces="front") > 0.1
    assert acne(device, slope_bias=1.0, bias=0.5) < 0.002
    assert acne(device, normal_offset=0.75, bias=0.1) < 0.002
    assert acne(device, faces="back") == 0


@pytest.mark.parametrize(("faces", "down", "double_sided", "shadow"), [
    ("both", True, False, True),
    ("front", True, False, False),
    ("back", True, False, True),
    ("front", False, False, True),
    ("back", False, False, False),
    ("front", True, True, True),
    ("back", False, True, True),
])  # fmt: skip
@pytest.mark.parametrize("mode", ["opaque", "mask"])
def test_a_sheet_casts_with_the_faces_that_are_drawn(device, faces, down, double_sided, shadow, mode):
    material = Material("sheet", alpha_mode=mode, double_sided=double_sided)
    place = moved(0, 0.5, 0) @ (np.diag([1.0, -1.0, -1.0, 1.0]) if down else np.eye(4))
    scene = scene_of(FLOOR, Shape("sheet", shapes.plane(1, 1), material, place), view=ABOVE, lights=(LIGHTS["spot"],))
    points, visibility = visibility_of(device, scene, faces=faces, filter="hard", resolution=128)
    inside = LIGHTS["spot"]
    cone = towards(inside, points.position.astype(np.float64))[0] @ -np.array(inside.direction) > np.cos(inside.outer)
    assert (visibility[(points.shape == 0) & cone] == 0).any() == shadow


def test_an_emitter_does_not_shadow_its_own_light_whichever_faces_are_drawn(device):
    bulb = Shape("bulb", shapes.sphere(0.2), Material("glow", emissive=(3, 3, 3)), moved(0, 1.5, 0))
    scene = scene_of(FLOOR, bulb, SPHERE, view=camera((3, 1, 3), yfov=0.6))
    for faces in ("front", "back"):
        points, visibility = visibility_of(device, scene, filter="hard", faces=faces)
        floor = visibility[points.shape == 0]
        assert (floor == 0).any() and (floor == 1).any()


@pytest.mark.parametrize(
    ("knobs", "message"),
    [
        ({"resolution": 16, "filter": "pcf9"}, "take a resolution of 20 or more"),
        ({"resolution": 64, "normal_offset": 20.0}, "reaches 21 texels"),
        ({"resolution": 8192}, "largest texture; take a resolution of"),
    ],
)
def test_a_map_too_small_or_too_large_is_refused_with_what_would_do(device, knobs, message):
    if device.gl.info["GL_MAX_TEXTURE_SIZE"] >= 3 * 8192 and "largest" in message:
        pytest.skip("this device has larger textures than the knob asks for")
    scene = scene_of(FLOOR, BOX, view=ABOVE, lights=(LIGHTS["point"],))
    with pytest.raises(EffectError, match=message):
        visibility_of(device, scene, **knobs)


def test_the_disk_is_even_and_within_its_radius():
    """No two of 16 points nearer than 0.2; 16 disks of radius 0.25 would have the area of the whole."""
    points = comparing.disk(16)
    assert points.shape == (16, 2) and np.linalg.norm(points, axis=1).max() <= 1
    apart = np.linalg.norm(points[:, None] - points, axis=2)[~np.eye(16, dtype=bool)]
    assert apart.min() > 0.2
    assert np.abs(points.mean(axis=0)).max() < 0.15
