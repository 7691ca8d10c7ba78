"""Reflections: the mirrored view, the march over the screen, the cubes, and what they cost where nothing mirrors."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.reflections.mirrors import flat_mirrors, mirroring_shapes, reflection
from lightmeter.scenes import shapes
from lightmeter.scenes.library import names
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Material, PointLight, Shape

from .small_scenes import camera, moved, renderer, scene_of
from .test_costs import counted

MIRROR = Material("mirror", (1.0, 0.8, 0.6), metallic=1.0, roughness=0.0)
CLAY = Material("clay", (0.7, 0.5, 0.3), specular=0.0)
GLOW = Material("glow", (0.0, 0.0, 0.0), specular=0.0, emissive=(2.0, 3.0, 4.0))
LAMP = PointLight("lamp", (1.0, 2.5, 2.0), (9.0, 9.0, 9.0))
VIEW = camera((0.0, 1.5, 4.0), (0.0, 0.2, 0.0), yfov=0.7)
FLOOR = Shape("floor", shapes.plane(6.0, 6.0), MIRROR)
BALL = Shape("ball", shapes.sphere(0.5, segments=32), CLAY, moved(-0.6, 0.6, 0.0))
BOX = Shape("box", shapes.box(0.7, 0.7, 0.7), CLAY, moved(0.7, 0.6, -0.3))
SIZE = (64, 64)
EFFECTS = (
    "planar_mirror",
    "static_cube_map",
    "local_cube_map",
    "dynamic_cube_map",
    "screen_space_reflections",
)


def chosen(name: str, **knobs) -> Choice:
    """An effect without ambient light, no shadows, one sample a pixel."""
    settings = {name: {"ambient": 0.0} | knobs}
    return Choice(use=(name,), without=("shadow_map", "supersampling"), settings=settings)


def indirect(device, scene, name: str, offset=(0.0, 0.0), **knobs):
    """(H, W, 3) of the term, and the points."""
    capture = renderer(device, scene, SIZE, chosen(name, **knobs)).capture(offset)
    return capture.frame["indirect"], capture.points


def mirrored(matrix: np.ndarray, shape: Shape) -> Shape:
    """The shape behind the mirror."""
    return replace(shape, matrix=matrix @ shape.matrix)


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.3, -0.4)])
@pytest.mark.parametrize("orthographic", [False, True])
def test_a_planar_mirror_shows_the_scene_behind_it(device, offset, orthographic):
    """Image and light mirrored by hand, and the mirror taken away, give the same picture through the hole it leaves.

    The mirror's metal scales it by Schlick's F(n·v). Positions are float32 and projected by another matrix: at a few
    edges of triangles the rasteriser falls on the other side.
    """
    view = camera((0.0, 1.5, 4.0), (0.0, 0.2, 0.0)) if orthographic else VIEW
    scene = scene_of(FLOOR, BALL, BOX, view=view, lights=(LAMP,))
    got, points = indirect(device, scene, "planar_mirror", offset)
    (mirror,) = flat_mirrors(scene)
    matrix = reflection(mirror.plane)
    x, y, z, _ = matrix @ np.append(LAMP.position, 1.0)
    virtual = replace(
        scene,
        shapes=(mirrored(matrix, BALL), mirrored(matrix, BOX)),
        lights=(replace(LAMP, position=(float(x), float(y), float(z))),),
    )
    behind = renderer(device, virtual, SIZE, Choice(without=("shadow_map", "supersampling"))).capture(offset)
    n_dot_v = np.sum(points.normal * points.view, axis=-1, keepdims=True)
    f0 = np.array(MIRROR.base_color)
    expected = behind.direct[0] * (f0 + (1 - f0) * (1 - n_dot_v) ** 5)
    on_mirror = points.shape == 0
    assert expected[on_mirror].max() > 0.05
    wrong = np.abs(got - expected).max(axis=-1) > 1e-4 * expected.max()
    assert wrong[on_mirror].mean() < 0.01
    assert got[~on_mirror & points.hit].max() == 0.0  # clay mirrors nothing, and there is no ambient light


def test_what_lies_behind_a_mirror_is_not_in_it(device):
    """The near plane of the mirrored view is the mirror: a ball beneath the floor would hide everything."""
    sunk = Shape("sunk", shapes.sphere(1.2, segments=32), CLAY, moved(0.0, -1.5, 1.0))
    alone, points = indirect(device, scene_of(FLOOR, BALL, view=VIEW, lights=(LAMP,)), "planar_mirror")
    both, _ = indirect(device, scene_of(FLOOR, BALL, sunk, view=VIEW, lights=(LAMP,)), "planar_mirror")
    assert alone[points.shape == 0].max() > 0
    assert np.abs(both - alone)[points.shape == 0].max() <= 1e-5


@pytest.mark.parametrize("name", EFFECTS)
def test_emission_and_environment_are_no_part_of_a_reflection(device, name):
    """They are `direct` of the lamp and `environment`: the mirror between a glowing ball and the sky shows neither."""
    glow = replace(BALL, material=GLOW)
    ball = Shape("metal", shapes.sphere(0.3, segments=32), MIRROR, moved(0.6, 0.4, 0.5))
    scene = scene_of(FLOOR, glow, ball, view=VIEW, radiance=(1.0, 1.0, 1.0))
    choice = replace(chosen(name), without=("shadow_map", "supersampling", "constant_ambient", "area_as_point"))
    drawn = renderer(device, scene, SIZE, choice)
    assert drawn.plan.effect_of("indirect") == name
    assert drawn.capture().frame["indirect"].max() == 0.0
    emission = drawn.capture().points.emission
    assert np.abs(drawn.render().radiance - emission).max() <= 1e-6 * emission.max()


@pytest.mark.parametrize("name", EFFECTS)
def test_the_frame_is_the_sum_of_its_terms(device, name):
    """The lit frame that an effect reads is the same in the frame and in the measurement, sky and glow or not."""
    ball = Shape("metal", shapes.sphere(0.3, segments=32), MIRROR, moved(0.6, 0.4, 0.5))
    lamp = Shape("lamp", shapes.rectangle(0.4, 0.4), GLOW, moved(0.5, 1.2, -0.5))
    scene = scene_of(FLOOR, BALL, ball, lamp, view=VIEW, lights=(LAMP,), radiance=(0.2, 0.3, 0.4))
    drawn = renderer(device, scene, SIZE, Choice(use=(name,), without=("supersampling",)))
    frame, capture = drawn.render().radiance, drawn.capture()
    total = capture.points.emission + capture.frame["environment"] + capture.frame["indirect"]
    for light, radiance in capture.direct.items():
        total = total + radiance * capture.visibility.get(light, 1.0)
    assert capture.frame["indirect"].max() > 0
    assert np.abs(total - frame).max() <= 1e-5 * frame.max()
    shaded = drawn.shade(capture.points).frame["indirect"]
    assert np.abs(shaded - capture.frame["indirect"]).max() <= 1e-5 * frame.max()


def test_given_points_say_where_in_the_pixel_they_lie(device):
    """A mirror's picture of points that are handed in is taken at their own offset."""
    drawn = renderer(device, scene_of(FLOOR, BALL, view=VIEW, lights=(LAMP,)), SIZE, chosen("planar_mirror"))
    first = drawn.capture((0.3, -0.2))
    drawn.capture((-0.4, 0.1))
    again = drawn.shade(first.points).frame["indirect"]
    differs = np.abs(again - first.frame["indirect"]).max(axis=-1) > 1e-4 * again.max()
    assert differs.mean() < 0.002


@pytest.mark.parametrize("march", ["linear", "hierarchical"])
def test_a_march_over_the_screen_finds_what_the_mirror_shows(device, march):
    """Where the mirror shows the front of something seen, both agree to the pixel that the hit is rounded to.

    At a pixel of the screen the ball's shading varies by a few percent; edges and what is not seen may differ.
    """
    scene = scene_of(FLOOR, BALL, view=VIEW, lights=(LAMP,))
    shown, points = indirect(device, scene, "planar_mirror")
    knobs = {"march": march, "steps": 256, "thickness": 0.02, "fallback": "none"}
    found, _ = indirect(device, scene, "screen_space_reflections", **knobs)
    both = (points.shape == 0) & (shown.max(axis=-1) > 0) & (found.max(axis=-1) > 0)
    assert both.sum() > 0.6 * ((points.shape == 0) & (shown.max(axis=-1) > 0)).sum()
    apart = np.abs(found - shown).max(axis=-1)[both] / shown.max()
    assert np.median(apart) < 0.03
    few, _ = indirect(device, scene, "screen_space_reflections", **(knobs | {"steps": 2}))
    assert (few.max(axis=-1) > 0).sum() < 0.8 * (found.max(axis=-1) > 0).sum()


def test_thickness_and_fallback_do_what_they_say(device):
    """With no thickness only a step that ends just there meets anything; the others see the fallback."""
    scene = scene_of(FLOOR, BALL, BOX, view=VIEW, lights=(LAMP,))
    thick, points = indirect(device, scene, "screen_space_reflections", fallback="none", thickness=0.1)
    thin, _ = indirect(device, scene, "screen_space_reflections", fallback="none", thickness=0.0, refinements=0)
    mirror = points.shape == 0
    assert (thin[mirror].max(axis=-1) > 0).mean() < 0.6 * (thick[mirror].max(axis=-1) > 0).mean()
    cube, _ = indirect(device, scene, "screen_space_reflections", fallback="cube", thickness=0.0, refinements=0)
    local, _ = indirect(device, scene, "local_cube_map")
    unmet = mirror & (thin.max(axis=-1) == 0)  # or met where the frame is black
    assert np.isclose(cube[unmet], local[unmet], atol=1e-6).all(axis=-1).mean() > 0.9


def test_a_local_cube_map_is_exact_where_its_box_is(device):
    """A closed room of clay about the middle: the box is the room, and each texel lies on its wall.

    The mirror is small and low, the capture's middle elsewhere: without the box the reflection is another place's.
    """
    room = Shape("room", _turned_inside_out(shapes.box(4.0, 3.0, 4.0)), CLAY, moved(0.0, 1.5, 0.0))
    low = Shape("mirror", shapes.plane(1.5, 1.5), MIRROR, moved(0.5, 0.02, 0.3))
    lamp = replace(LAMP, position=(0.5, 2.0, 1.0))
    scene = scene_of(room, low, view=camera((0.0, 1.5, 1.9), (0.4, 0.0, 0.2), yfov=1.2), lights=(lamp,))
    shown, points = indirect(device, scene, "planar_mirror")
    boxed, _ = indirect(device, scene, "local_cube_map", size=256)
    far, _ = indirect(device, scene, "static_cube_map", size=256)
    mirror = points.shape == 1
    assert mirror.sum() > 100
    error = [np.sqrt(np.mean((image - shown)[mirror] ** 2)) / shown[mirror].mean() for image in (boxed, far)]
    assert error[0] < 0.02 < 0.1 < error[1]


def _turned_inside_out(mesh):
    """The mesh with its backs as fronts."""
    return replace(mesh, triangles=mesh.triangles[:, ::-1], normals=None if mesh.normals is None else -mesh.normals)


def test_a_cube_about_an_object_leaves_the_object_out(device):
    """A metal ball in a clay room sees the room, not its own inside; and it is not among the flat mirrors."""
    room = Shape("room", _turned_inside_out(shapes.box(4.0, 3.0, 4.0)), CLAY, moved(0.0, 1.5, 0.0))
    ball = Shape("ball", shapes.sphere(0.4, segments=32), MIRROR, moved(0.3, 1.0, 0.0))
    lamp = replace(LAMP, position=(0.5, 2.0, 1.0))
    scene = scene_of(room, ball, view=camera((0.0, 1.5, 1.9), (0.3, 1.0, 0.0), yfov=0.8), lights=(lamp,))
    assert mirroring_shapes(scene) == (1,) and flat_mirrors(scene) == ()
    shown, points = indirect(device, scene, "dynamic_cube_map")
    assert (shown[points.shape == 1].max(axis=-1) > 0).mean() > 0.9
    assert shown[points.shape == 0].max() == 0.0


@pytest.mark.parametrize("name", EFFECTS)
def test_reflections_cost_nothing_where_nothing_mirrors(name):
    matt = scene_of(Shape("floor", shapes.plane(6.0, 6.0), CLAY), BALL, view=VIEW, lights=(LAMP,))
    assert counted(matt, Choice(use=(name,)))[1:] == counted(matt)[1:]


def test_no_scene_takes_a_reflection_unasked():
    for scene in names():
        assert not set(EFFECTS) & set(compile_plan(load(scene), effects()).effects)


def test_a_frame_keeps_what_it_has_lit_only_for_who_reads_it():
    """One texture for the lit frame, and one for what was there before where something emits: nobody else pays."""
    scene = scene_of(FLOOR, BALL, view=VIEW, lights=(LAMP,))
    without = Choice(without=("shadow_map", "constant_ambient"))
    knobs = {"ambient": 0.0, "fallback": "none"}
    march = Choice(
        use=("screen_space_reflections",),
        without=without.without,
        settings={"screen_space_reflections": knobs},
    )
    plain, reads = counted(scene, without), counted(scene, march)
    # The effect's program; one full-screen pass; the lit frame.
    assert (reads[1]["shaders"], reads[1]["textures"], reads[2]) == (
        plain[1]["shaders"] + 1,
        plain[1]["textures"] + 1,
        plain[2] + 1,
    )
    pyramid = replace(march, settings={"screen_space_reflections": knobs | {"march": "hierarchical"}})
    levels = 5  # of 16 pixels: 16, 8, 4, 2, 1; each is drawn, then all beside each other
    found = counted(scene, pyramid)
    assert found[1]["textures"] == reads[1]["textures"] + levels + 1
    assert found[2] == reads[2] + levels + 1


def test_a_mirror_seen_from_behind_is_not_drawn():
    """A floor below the camera mirrors, one above shows its back."""
    assert len(flat_mirrors(scene_of(FLOOR, BALL, view=VIEW))) == 1
    high = replace(FLOOR, matrix=moved(y=3.0))
    assert flat_mirrors(scene_of(high, BALL, view=VIEW)) == ()
    plan = compile_plan(scene_of(high, BALL, view=VIEW, lights=(LAMP,)), effects(), Choice(use=("planar_mirror",)))
    assert "planar_mirror" not in plan.effects and "towards the camera" in plan.why_absent("planar_mirror")
