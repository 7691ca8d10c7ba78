"""The frame graph, compiled without GL: order, choice, what is left out and why."""

import subprocess
import sys

import numpy as np
import pytest

from lightmeter.realtime.discovery import effect, effects
from lightmeter.realtime.effect import Effect, EffectError, Knob
from lightmeter.realtime.graph import Choice, Step, compile_plan
from lightmeter.scenes import library, shapes
from lightmeter.scenes.load import load
from lightmeter.scenes.model import AreaLight, DirectionalLight, Material, PointLight, Shape, SpotLight, Texture

from .small_scenes import WHITE, camera, facing, image, moved, scene_of

POINT = PointLight("point", (0, 2, 1), (1, 1, 1))
SUN = DirectionalLight("sun", (0, -1, 0), (1, 1, 1))
SPOT = SpotLight("spot", (0, 2, 0), (0, -1, 0), (1, 1, 1), 0.2, 0.4)
BALL = Shape("ball", shapes.sphere(0.5), WHITE)
LAMP = Shape("panel", shapes.rectangle(0.3, 0.3), Material("glow", emissive=(3, 3, 3)), moved(z=1.5))
BAKED = Material("baked", occlusion_texture=Texture(image([[128]])))


def plan_of(scene, choice=None, known=None):
    return compile_plan(scene, known or effects(), choice)


def why(plan, what: str) -> str:
    return next(out.why for out in plan.left_out if out.what == what)


@pytest.mark.parametrize("name", library.names())
def test_library_scenes_compile_in_order(name):
    """Whatever is read was written before; the display comes last; each light's visibility precedes its direct."""
    plan = plan_of(load(name))
    written = set()
    for step in plan.steps:
        for term in step.reads:
            key = (term, step.light) if term == "visibility" else term
            assert key in written or term == "radiance", step
        written |= {(term, step.light) if term == "visibility" else term for term in step.writes}
    terms = [step.writes[0] for step in plan.steps]
    assert terms[-2:] == ["tone", "encode"]
    lights = [step.light for step in plan.steps if step.light is not None]
    assert lights == sorted(lights)
    assert set(lights) == set(range(len(plan.scene.all_lights)))


@pytest.mark.parametrize("name", library.names())
def test_everything_is_taken_or_left_out_with_a_reason(name):
    plan = plan_of(load(name))
    left = {out.what for out in plan.left_out if not out.what.startswith("term ")}
    assert left | set(plan.effects) == set(effects())
    assert not left & set(plan.effects)
    assert all(out.why for out in plan.left_out)


def test_the_plane_takes_the_fewest_steps():
    plan = plan_of(load("plane"))
    assert plan.steps == (
        Step("cook_torrance", ("direct",), (), 0),
        Step("narkowicz", ("tone",), ("radiance",)),
        Step("srgb", ("encode",), ("tone",)),
    )
    assert why(plan, "shadow_map") == "one flat shape cannot stand in its own light"
    assert why(plan, "constant_ambient") == "the scene has no environment"
    assert why(plan, "gamma_22") == "srgb gives encode already"
    assert plan.not_approximated == ()


def test_lights_go_to_the_effects_for_their_kind():
    plan = plan_of(scene_of(BALL, LAMP, lights=(SUN, POINT, SPOT)))
    assert plan.lights_of("cook_torrance") == (0, 1, 2)
    assert plan.lights_of("area_as_point") == (3,)
    assert plan.lights_of("shadow_map") == (0, 1, 2, 3)
    assert isinstance(plan.scene.all_lights[3], AreaLight)


AREA_EFFECTS = ("area_as_point", "representative_point", "ltc_area_light", "many_sample_light")


@pytest.mark.parametrize("name", AREA_EFFECTS)
def test_an_effect_without_lights_of_its_kind_says_so(name):
    plan = plan_of(scene_of(BALL, lights=(SUN,)), Choice(use=(name,)))
    assert why(plan, name) == "the scene has no light of the kinds it handles"


@pytest.mark.parametrize("name", AREA_EFFECTS)
def test_emissive_surfaces_go_to_the_effect_that_is_asked_for(name):
    plan = plan_of(scene_of(BALL, LAMP, lights=(SUN,)), Choice(use=(name,)))
    assert plan.lights_of(name) == (1,) and plan.lights_of("cook_torrance") == (0,)
    for other in set(AREA_EFFECTS) - {name}:
        assert why(plan, other) == f"{', '.join(sorted(('cook_torrance', name)))} gives direct already"


def test_visibility_is_pruned_where_no_effect_gives_direct():
    shading = tuple(e.name for e in effects().values() if "direct" in e.terms)
    plan = plan_of(scene_of(BALL, lights=(SUN,)), Choice(without=shading))
    assert all("visibility" not in step.writes for step in plan.steps)
    assert why(plan, "shadow_map") == "nothing in this frame reads visibility"
    assert plan.not_approximated == ("direct",)


def test_environment_visibility_is_pruned_where_nothing_reads_it():
    card, ball = facing(BAKED), BALL
    full = plan_of(scene_of(card, ball, lights=(SUN,), radiance=(1, 1, 1)))
    writes = [step.writes for step in full.steps]
    assert writes.index(("environment_visibility",)) < writes.index(("environment", "indirect"))
    pruned = plan_of(scene_of(card, ball, lights=(SUN,), radiance=(1, 1, 1)), Choice(without=("constant_ambient",)))
    assert "occlusion_map" not in pruned.effects
    assert why(pruned, "occlusion_map") == "nothing in this frame reads environment_visibility"
    dark = plan_of(scene_of(card, ball, lights=(SUN,)))
    assert why(dark, "occlusion_map") == "the scene has no environment"


def test_without_baked_occlusion_there_is_no_occlusion_map():
    plan = plan_of(scene_of(BALL, facing(WHITE), radiance=(1, 1, 1)))
    assert why(plan, "occlusion_map") == "no material has an occlusion texture"
    assert plan.not_approximated == ("environment_visibility",)


def test_channels_are_what_the_effects_read():
    plan = plan_of(load("plane"))
    assert plan.channels == frozenset(effect("cook_torrance").channels)
    bare = plan_of(scene_of(BALL, lights=(SUN,)), Choice(only=("shadow_map",)))
    assert bare.channels == frozenset()


def test_only_without_and_use():
    scene = scene_of(BALL, facing(WHITE), lights=(SUN,), radiance=(1, 1, 1))
    only = plan_of(scene, Choice(only=("cook_torrance", "srgb")))
    assert set(only.effects) == {"cook_torrance", "srgb"}
    assert why(only, "shadow_map") == "not among the effects asked for"
    assert "coverage" in only.not_approximated and "tone" in only.not_approximated
    without = plan_of(scene, Choice(without=("shadow_map",)))
    assert why(without, "shadow_map") == "left out as asked"
    use = plan_of(scene, Choice(use=("gamma_22",)))
    assert use.effect_of("encode") == "gamma_22"
    assert why(use, "srgb") == "gamma_22 gives encode already"
    assert use.effect_of("exposure") is None


def test_settings_are_read_and_checked():
    scene = load("plane")
    plan = plan_of(scene, Choice(settings={"supersampling": {"grid": "4"}, "narkowicz": {"prescale": 1}}))
    assert plan.effects["supersampling"][1] == {"grid": 4}
    assert plan.effects["narkowicz"][1] == {"prescale": 1.0}
    assert plan.effects["srgb"][1] == {"dither": "none"}


def test_what_is_left_out_is_not_replaced_unasked():
    """Leaving out a term's default leaves the term out; what the scene does not need leaves its place to the next."""
    known = {e.name: e for e in (Effect("a", ("encode",), "", ""), Effect("b", ("encode",), "", "", rank=1))}
    scene = scene_of(BALL)
    assert plan_of(scene, None, known).effect_of("encode") == "a"
    out = plan_of(scene, Choice(without=("a",)), known)
    assert out.effect_of("encode") is None and "encode" in out.not_approximated
    assert why(out, "a") == "left out as asked"
    assert why(out, "b") == "takes the place of a where it is asked for: --use b"
    assert plan_of(scene, Choice(without=("a",), use=("b",)), known).effect_of("encode") == "b"
    assert plan_of(scene, Choice(only=("b",)), known).effect_of("encode") == "b"
    needless = known | {"a": Effect("a", ("encode",), "", "", unneeded=lambda _scene: "no need")}
    assert plan_of(scene, None, needless).effect_of("encode") == "b"


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        (Choice(only=("shadow_maps",)), "did you mean 'shadow_map'"),
        (Choice(without=("narkovicz",)), "did you mean 'narkowicz'"),
        (Choice(use=("zzz",)), "there are: area_as_point"),
        (Choice(settings={"shadowmap": {}}), "did you mean 'shadow_map'"),
        (Choice(settings={"shadow_map": {"resolutoin": 3}}), "did you mean 'resolution'"),
        (Choice(settings={"lambert": {"gamma": 3}}), "it has no knobs"),
        (Choice(settings={"shadow_map": {"resolution": "many"}}), "expected a whole number, got 'many'"),
        (Choice(settings={"shadow_map": {"resolution": 2.5}}), "expected a whole number, got 2.5"),
        (Choice(settings={"shadow_map": {"resolution": 1}}), "within [16, 8192], got 1"),
        (
            Choice(settings={"shadow_map": {"filter": "soft"}}),
            "expected one of hard, pcf3, pcf5, pcf7, pcf9, poisson, got 'soft'",
        ),
        (Choice(settings={"shadow_map": {"bias": "nan"}}), "within [0, 100], got 'nan'"),
        (Choice(settings={"shadow_map": {"bias": float("inf")}}), "within [0, 100]"),
        (Choice(settings={"narkowicz": {"prescale": True}}), "expected a number, got True"),
    ],
)
def test_what_does_not_exist_is_named_with_the_nearest(choice, message):
    with pytest.raises(EffectError) as error:
        plan_of(load("plane"), choice)
    assert message in str(error.value)


def test_a_truth_value_is_read_from_words():
    knob = Knob("on", True, "A switch.")
    assert knob.read("no", "x") is False
    assert knob.read("True", "x") is True
    assert knob.range == "true | false"
    with pytest.raises(EffectError, match="expected true or false"):
        knob.read("maybe", "x")


def test_an_effect_for_an_unknown_term_is_refused():
    with pytest.raises(EffectError, match="did you mean 'visibility'"):
        Effect("x", ("visibilty",), "", "")


def test_an_effect_for_several_terms_is_drawn_once_for_both():
    known = {
        e.name: e
        for e in (Effect("both", ("environment", "indirect"), "", ""), Effect("sky", ("environment",), "", "", rank=1))
    }
    scene = scene_of(BALL, facing(WHITE), radiance=(1, 1, 1))
    plan = plan_of(scene, None, known)
    assert plan.steps == (Step("both", ("environment", "indirect"), ()),)
    assert why(plan, "sky") == "both gives environment already"
    split = plan_of(scene, Choice(use=("sky",)), known)
    assert split.steps == (Step("sky", ("environment",), ()), Step("both", ("indirect",), ()))


def test_an_effect_may_give_both_terms_of_a_light():
    known = {"ltc": Effect("ltc", ("direct", "visibility"), "", "")}
    plan = plan_of(scene_of(BALL, lights=(SUN,)), None, known)
    assert plan.steps == (Step("ltc", ("visibility",), (), 0), Step("ltc", ("direct",), ("visibility",), 0))


def test_an_empty_scene_and_one_without_lights_compile():
    empty = plan_of(scene_of())
    assert [step.writes[0] for step in empty.steps] == ["tone", "encode"]
    assert why(empty, "cook_torrance") == "the scene has no lights"
    lit = plan_of(scene_of(lights=(SUN,)))
    assert why(lit, "shadow_map") == "the scene has no shapes"


def test_max_depth_two_has_no_indirect_light():
    plan = plan_of(scene_of(BALL, facing(WHITE), radiance=(1, 1, 1), max_depth=2))
    assert Step("constant_ambient", ("environment",), ()) in plan.steps
    assert why(plan, "term indirect") == "max_depth is 2: direct light only"


def test_compiling_needs_no_gl():
    code = (
        "import sys, lightmeter.realtime.graph as g, lightmeter.realtime.discovery as d\n"
        "from lightmeter.scenes.load import load\n"
        "g.compile_plan(load('posts'), d.effects())\n"
        "assert not {'moderngl', 'mitsuba', 'drjit'} & set(sys.modules), sys.modules.keys()\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_sub_pixel_offsets_of_supersampling_are_centred():
    offsets = effect("supersampling").offsets({"grid": 3})
    assert offsets.shape == (9, 2)
    assert np.allclose(offsets.mean(axis=0), 0)
    assert np.allclose(np.unique(offsets), [-1 / 3, 0, 1 / 3])
    assert camera().ymag == 1.0
