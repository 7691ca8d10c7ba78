"""What a frame costs: passes, shaders, textures and draws counted against the plan, and how time is taken."""

import time

import numpy as np
import pytest

from lightmeter.realtime.device import Device
from lightmeter.realtime.graph import Choice
from lightmeter.realtime.shaders import source
from lightmeter.realtime.timing import Clock, Recording, Time, summarise
from lightmeter.scenes import shapes
from lightmeter.scenes.load import load
from lightmeter.scenes.model import DirectionalLight, Material, Shape, Texture

from .small_scenes import LAMP, WHITE, camera, facing, image, moved, renderer, scene_of

FACES = 3
"""Of the lamp's cube: 1 m before the scene's box it sees 1.3 m of it to the left and 1.7 m below, but only 0.7 m to the
right and 0.3 m above, less than 45° from straight ahead; nothing is behind it."""
SUN = DirectionalLight("sun", (-0.3, -0.5, -0.8), (1, 1, 1))


def counted(scene, choice=None, frames=1):
    """What a renderer made, and what `frames` frames then issued, on a device of its own."""
    device = Device()
    maker = renderer(device, scene, (16, 16), choice)
    made = dict(device.counts)
    maker.draw()
    first = device.counts["draws"]
    for _ in range(frames - 1):
        maker.draw()
    assert device.counts["draws"] == first * frames
    assert maker.render().radiance.shape == (16, 16, 3)
    return made, dict(device.counts), first


def test_the_plane_costs_the_least(device):
    """One flat diffuse shape, one light that nothing blocks.

    shaders: the G-buffer, the lighting, tone, encode. textures: position, normal with roughness (base colour, metallic,
    specular and occlusion are constants), depth, radiance, and one each for tone and encode. draws: the shape, and a
    full-screen triangle for each of lighting, tone and encode.
    """
    _, all_made, draws = counted(load("plane"), frames=3)
    assert all_made["shaders"] == 4
    assert all_made["textures"] == 2 + 1 + 1 + 2
    assert draws == 1 + 3


def test_without_lights_and_display_only_the_surface_is_drawn():
    """No step reads a channel: the position alone is left, and nothing is drawn over the whole screen."""
    _, made, draws = counted(scene_of(facing(WHITE)), Choice(only=("supersampling",)))
    assert (made["shaders"], made["textures"], draws) == (1, 1 + 1 + 1, 1)


def test_every_part_of_a_scene_adds_what_it_needs_and_no_more():
    """From the plane: an environment adds a background and its effect; a second shape adds shadows; and so on."""
    ball = Shape("ball", shapes.sphere(0.4, segments=16), WHITE, moved(z=0.6))
    plain = counted(scene_of(facing(WHITE), lights=(LAMP,)))
    # Another shape: a shadow map (depth program and texture, those faces that see something) and the comparison
    # (program, buffer); a draw in the G-buffer; and light from one to the other (program and draw of the ambient term).
    two = counted(scene_of(facing(WHITE), ball, lights=(LAMP,)))
    assert two[1]["shaders"] == plain[1]["shaders"] + 2 + 1
    assert two[1]["textures"] == plain[1]["textures"] + 2
    assert two[2] == plain[2] + 1 + FACES + 1 + 1
    # A second light of the same kind has the same programs and textures: one map more to draw, and two passes.
    again = counted(scene_of(facing(WHITE), ball, lights=(LAMP, LAMP)))
    assert again[1]["shaders"] == two[1]["shaders"] and again[1]["textures"] == two[1]["textures"]
    assert again[2] == two[2] + FACES + 2
    # A directional one has a map of its own (one view) and a comparison of its own.
    sun = counted(scene_of(facing(WHITE), ball, lights=(LAMP, SUN)))
    assert sun[1]["shaders"] == two[1]["shaders"] + 1 and sun[1]["textures"] == two[1]["textures"] + 1
    assert sun[2] == two[2] + 1 + 2
    # An environment: the background behind everything, in the same ambient pass.
    sky = counted(scene_of(facing(WHITE), ball, lights=(LAMP,), radiance=(1, 1, 1)))
    assert sky[1]["shaders"] == two[1]["shaders"] + 1 and sky[1]["textures"] == two[1]["textures"]
    assert sky[2] == two[2] + 1


TECHNIQUES = {  # for one light: (shaders, textures, draws of the map) beyond the comparison's own shader, buffer, draw
    "shadow_map": (LAMP, (1, 1, FACES)),
    "variance_shadow_map": (LAMP, (2, 3, FACES + 2)),  # casters and the mean; the map, its depth and one between
    "exponential_shadow_map": (LAMP, (2, 3, FACES + 2)),
    "moment_shadow_map": (LAMP, (2, 3, FACES + 2)),
    "cascaded_shadow_map": (SUN, (1, 1, 4)),
}


@pytest.mark.parametrize("name", TECHNIQUES)
def test_a_shadow_technique_costs_its_map_and_a_comparison(name):
    """And nothing where one flat shape cannot stand in its own light, or where no light is of its kind."""
    light, (shaders, textures, draws) = TECHNIQUES[name]
    ball = Shape("ball", shapes.sphere(0.4, segments=16), WHITE, moved(z=0.6))
    lit = scene_of(facing(WHITE), ball, lights=(light,))
    none = counted(lit, Choice(without=("shadow_map",)))
    used = counted(lit, Choice(use=(name,)), frames=2)
    assert used[1]["shaders"] - none[1]["shaders"] == shaders + 1
    assert used[1]["textures"] - none[1]["textures"] == textures + 1
    assert used[2] - none[2] == draws + 1
    flat = scene_of(facing(WHITE), lights=(light,))
    assert counted(flat, Choice(use=(name,))) == counted(flat, Choice(without=("shadow_map",)))
    dark = scene_of(facing(WHITE), ball, radiance=(1, 1, 1))
    assert counted(dark, Choice(use=(name,))) == counted(dark, Choice(without=("shadow_map",)))


def test_soft_shadows_cost_nothing_without_an_emissive_surface():
    ball = Shape("ball", shapes.sphere(0.4, segments=16), WHITE, moved(z=0.6))
    lit = scene_of(facing(WHITE), ball, lights=(LAMP,))
    assert counted(lit, Choice(use=("pcss",))) == counted(lit)
    glow = Shape("glow", shapes.rectangle(0.2, 0.2), Material("glow", emissive=(3, 3, 3)), moved(x=0.5, z=2.0))
    with_lamp = scene_of(facing(WHITE), ball, glow)
    assert counted(with_lamp, Choice(use=("pcss",))) == counted(with_lamp)  # in number; its shader costs more
    assert counted(lit, Choice(use=("cascaded_shadow_map",))) == counted(lit)


def test_textures_are_uploaded_once_and_only_those_that_are_read():
    texture = Texture(image([[200]]))
    material = Material("a", base_color_texture=texture)
    other = Material("b", (0.5, 0.5, 0.5), base_color_texture=texture)
    one = counted(scene_of(facing(material), lights=(LAMP,)))
    two = counted(
        scene_of(facing(material), facing(other, 1, 1, moved(z=0.3)), lights=(LAMP,)),
        Choice(without=("shadow_map", "constant_ambient")),
    )
    assert one[1]["textures"] == two[1]["textures"]
    # Without an effect that reads the base colour, its texture is not looked up.
    none = counted(scene_of(facing(material)), Choice(only=("supersampling",)))
    assert none[1]["textures"] == 3


def test_area_lights_cost_what_their_effect_reads_and_nothing_where_there_are_none():
    """As a point: a program and a draw. With tables or points of its own: as many textures more, uploaded once."""
    lamp = Shape("lamp", shapes.rectangle(0.3, 0.3), Material("glow", emissive=(3, 3, 3)), moved(z=1.5))
    without = Choice(without=("shadow_map", "constant_ambient"))
    one = counted(scene_of(facing(WHITE), lamp), without)
    two = counted(scene_of(facing(WHITE), lamp, lamp), without)
    for name, tables, for_each in (
        ("representative_point", 0, 0),
        ("ltc_area_light", 2, 0),
        ("many_sample_light", 0, 1),
    ):
        choice = Choice(use=(name,), without=("shadow_map", "constant_ambient"))
        for lamps, plain in ((1, one), (2, two)):
            found = counted(scene_of(facing(WHITE), *[lamp] * lamps), choice)
            assert found[1]["textures"] == plain[1]["textures"] + tables + lamps * for_each
            assert (found[1]["shaders"], found[2]) == (plain[1]["shaders"], plain[2])
        assert counted(load("plane"), choice)[1:] == counted(load("plane"), without)[1:]


def test_supersampling_draws_the_scene_once_per_sample():
    one = counted(load("plane"))
    four = counted(load("plane"), Choice(settings={"supersampling": {"grid": 2}}))
    assert four[1]["shaders"] == one[1]["shaders"] + 1
    assert four[1]["textures"] == one[1]["textures"] + 1
    assert four[2] == 4 * (one[2] - 2 + 1) + 2


def heavy_pass(device):
    """A draw whose fragments take long, whatever the device."""
    text = (
        "out vec4 c; void main() { float x = gl_FragCoord.x; for (int i = 0; i < 200; ++i) x = sin(x); c = vec4(x); }"
    )
    program = device.program(source(text))
    target, vertices = device.framebuffer([device.target((512, 512))]), device.fullscreen(program)
    target.use()
    device.gl.enable_only(device.gl.NOTHING)
    return lambda: device.draw(vertices, 3)


def test_the_software_rasteriser_s_rule_is_needed_and_applied(device):
    """A timer query ends when a pass is recorded, and the work follows at glFinish; the clock sees the work.

    All three are of the same pass in the same run: wall time around draw and glFinish as measured here, the query
    inside it, and what the clock says. The clock's median must be most of the wall time's, the query's a small part.
    """
    if not device.software:
        pytest.skip("the rasteriser is hardware")
    draw, clock = heavy_pass(device), Clock(device)
    wall, queried, clocked = [], [], []
    draw()
    for _ in range(9):
        device.finish()
        query = device.gl.query(time=True)
        start = time.perf_counter()
        with query:
            draw()
        device.finish()
        wall.append(time.perf_counter() - start)
        queried.append(query.elapsed * 1e-9)
        clocked.append(clock.measure(draw) * 1e-3)
    assert np.median(queried) < 0.2 * np.median(wall)
    assert np.median(clocked) > 0.5 * np.median(wall)
    assert clock.method == "wall time around glFinish"


class Hardware:
    """A device whose timer query says that `claimed` nanoseconds passed."""

    software = False

    def __init__(self, claimed: float) -> None:
        self.elapsed = claimed
        self.gl = self

    def query(self, time: bool):
        return self

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None

    def finish(self) -> None:
        """Nothing is ever under way."""


@pytest.mark.parametrize(("claimed", "doubted"), [(1e5, False), (1e8, True)])
def test_a_timer_query_that_exceeds_wall_time_is_doubted(claimed, doubted):
    """A pass of 2 ms; a query of 0.1 ms may be right (the driver was slow), one of 100 ms cannot be."""
    clock = Clock(Hardware(claimed))
    assert clock.measure(lambda: time.sleep(0.002)) == claimed * 1e-6
    times = summarise([Recording([1.0], [], "", clock.method, clock.disagreement)])
    assert times.method == "timer query"
    assert bool(times.doubt) == doubted


def test_runs_of_frames_are_summarised_as_one():
    """Two lights of one name are two passes; what further samples cost is the frame less one sample's passes."""
    runs = [
        Recording([10.0, 12.0], [("s · sun", "s", [1.0, 1.0]), ("s · sun", "s", [2.0, 2.0])], "msaa", "m", 0.2),
        Recording([11.0], [("s · sun", "s", [4.0]), ("s · sun", "s", [3.0])], "msaa", "m", 0.5),
    ]
    times = summarise(runs)
    assert times.frame == Time(11.0, 1.0, 3)
    assert times.of("s") == Time(1.0 + 2.0, 0.0, 3)
    assert times.of("msaa") == Time(11.0 - 3.0, 0.0, 3)
    assert times.disagreement == 0.5


def test_passes_are_timed_by_name_and_add_up_to_about_the_frame(device):
    times = renderer(device, load("posts"), (128, 128)).measure(frames=7, warm_up=1)
    names = [name for name, _, _ in times.passes]
    assert names[0] == "gbuffer" and len(set(names)) == len(names)
    assert sum(name.startswith("shadow_map") for name in names) == 2 * 3
    together = times.of("shadow_map")
    assert together is not None and together.frames == 7 and together.median > 0
    assert times.of("ssao") is None
    assert 0.3 < sum(t.median for _, _, t in times.passes) / times.frame.median < 3


def test_further_samples_are_the_coverage_effect_s_time(device):
    maker = renderer(device, load("plane"), (64, 64), Choice(settings={"supersampling": {"grid": 4}}))
    times = maker.measure(frames=5, warm_up=1)
    further = times.of("supersampling")
    assert further is not None and further.median > 0.5 * times.frame.median


def test_a_time_is_a_median_and_its_deviation():
    assert Time.of([1.0, 2.0, 3.0, 10.0, 2.5]) == Time(2.5, 0.5, 5)


def test_a_camera_of_any_kind_draws_the_same_passes():
    """So that the counts above hold for both lenses."""
    flat = counted(scene_of(facing(WHITE), lights=(LAMP,)))
    deep = counted(scene_of(facing(WHITE), lights=(LAMP,), view=camera(yfov=0.8)))
    assert flat[1] == deep[1]
