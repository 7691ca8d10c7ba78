"""`lightmeter sweep` as a user runs it, on small pictures."""

import csv
import io
import json
import math
from dataclasses import replace

import numpy as np
import pytest

from lightmeter import sweeping
from lightmeter.failures import UsageError
from lightmeter.knob_words import declared, visits
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.mse import rmse
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effect, effects
from lightmeter.realtime.effect import EffectError
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.sweep_figures import GROUP_COLOURS, GROUP_SYMBOLS
from lightmeter.scenes.load import load
from lightmeter.sides import coverage_sides, effect_sides
from lightmeter.truth import Truth

BRIEF = ("--spp", "16", "--curve", "0", "-o", "out")
"""With a curve of one point, 1 spp."""


@pytest.mark.parametrize("name", list(effects()))
def test_the_values_that_a_knob_declares_for_a_sweep_are_values_it_takes(name):
    for knob in effect(name).knobs:
        assert [knob.read(value, name) for value in knob.sweep] == list(knob.sweep)
        assert len(set(knob.sweep)) == len(knob.sweep)


def test_no_two_knobs_of_an_effect_look_alike():
    """Colours come again, symbols do not."""
    assert len(set(GROUP_SYMBOLS)) >= max(len(declared(e)) for e in effects().values()) > len(GROUP_COLOURS)


def test_a_star_goes_out_from_the_current_setting():
    """Each knob by itself, the others as they are; what would be measured twice is measured once."""
    shadow = effect("shadow_map")
    current = shadow.settings({"resolution": 64})
    found = visits(shadow, current)
    assert found[0].knobs == current and found[0].varied == ()
    assert all(sum(v.knobs[k] != current[k] for k in current) == 1 for v in found[1:])
    others = [set(knob.sweep) - {current[knob.name]} for knob in shadow.knobs]
    assert len(found) == 1 + sum(map(len, others))
    assert len({tuple(v.knobs.items()) for v in found}) == len(found)


def test_several_knobs_give_their_grid():
    shadow = effect("shadow_map")
    found = visits(shadow, shadow.settings({}), ["filter", "resolution=32,64,32", "bias=0.25"])
    assert [(v.knobs["filter"], v.knobs["resolution"], v.knobs["bias"]) for v in found] == [
        (kind, side, 0.25) for kind in shadow.knob("filter").sweep for side in (32, 64)
    ]
    assert all(v.varied == ("filter", "resolution", "bias") for v in found)


def test_several_knobs_can_be_varied_one_at_a_time():
    shadow = effect("shadow_map")
    current = shadow.settings({})
    found = visits(shadow, current, ["filter=hard", "resolution=32,64"], grid=False)
    assert [visit.varied for visit in found] == [(), ("filter",), ("resolution",), ("resolution",)]
    assert [visit.knobs["resolution"] for visit in found] == [current["resolution"]] * 2 + [32, 64]


def test_a_grid_has_an_end(refused):
    """Repeated values count once: 256 settings are allowed, and no more."""
    shadow = effect("shadow_map")
    sixteen = ",".join(map(str, range(16, 32)))
    tenths = ",".join(f"{n / 10}" for n in [*range(16), *range(16)])
    words = [f"resolution={sixteen}", f"bias={tenths}"]
    assert len(visits(shadow, shadow.settings({}), words)) == 256
    with pytest.raises(UsageError, match=r"16 × 16 × 2 = 512 settings; expected at most 256: .*--one-at-a-time"):
        visits(shadow, shadow.settings({}), [*words, "filter=hard,pcf3"])
    many = [word for knob in effect("cook_torrance").knobs if knob.sweep for word in ("--knob", knob.name)]
    assert "3 × 6 × 4 × 5 × 3 = 1080 settings" in refused("sweep", "torus", "cook_torrance", *many)


def test_a_knob_without_declared_values_needs_them():
    bare = replace(effect("shadow_map"), knobs=(replace(effect("shadow_map").knobs[0], sweep=()),))
    with pytest.raises(UsageError, match="--knob resolution=v1,v2"):
        visits(bare, bare.settings({}), ["resolution"])
    with pytest.raises(UsageError, match="it has resolution"):
        visits(bare, bare.settings({}))
    with pytest.raises(EffectError, match="resolution"):
        visits(bare, bare.settings({}), ["resolutio=3"])


def test_a_sweep_of_shadow_maps(run, tmp_path):
    """Error falls with the resolution, and every file says the same."""
    knobs = ("--knob", "resolution=32,512", "--knob", "filter=hard")
    words = ("--size", "48x48", "--spp", "16", "--curve", "5", "-o", "out", "--json")
    found = run("sweep", "posts", "shadow_map", *knobs, *words)
    assert found.code == 0, found.err
    document = found.json
    assert document == json.loads((tmp_path / "out" / "sweep.json").read_text())
    assert document["complete"] and document["schema"] == 1 and document["device"]["cpu"]
    (shadow,) = document["effects"]
    coarse, fine = shadow["settings"]
    assert (coarse["knobs"]["resolution"], fine["knobs"]["resolution"]) == (32, 512)
    assert coarse["knobs"]["filter"] == "hard" and coarse["knobs"]["bias"] == 0.5
    assert coarse["effect"]["metrics"]["rmse"]["value"] > 2 * fine["effect"]["metrics"]["rmse"]["value"] > 0
    assert fine["effect"]["front"] == {"rmse": True, "flip": True}
    for setting in (coarse, fine):
        own, frame = setting["effect"]["time_ms"], setting["frame"]["time_ms"]
        assert own["frames"] == frame["frames"] >= 20
        assert 0 < own["median"] < 2 * frame["median"]
    curve = document["path_tracer"]
    assert [point["spp"] for point in curve] == [2**i for i in range(len(curve))] and len(curve) >= 3
    # The variance falls as 1/n: from 1 to 4 spp by four, and by two at the very least.
    assert curve[2]["metrics"]["rmse"]["value"] < curve[0]["metrics"]["rmse"]["value"] / math.sqrt(2)
    rows = list(csv.DictReader(io.StringIO((tmp_path / "out" / "sweep.csv").read_text())))
    assert [float(row["effect_rmse"]) for row in rows[:2]] == [
        s["effect"]["metrics"]["rmse"]["value"] for s in (coarse, fine)
    ]
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"sweep.html", "sweep.json", "sweep.csv"}


def test_supersampling_costs_what_the_frame_costs(run):
    """It has no passes of its own; and four samples see the control's outline better than one."""
    words = ("--without", "shadow_map", "--size", "32x32", "--spp", "64", "--curve", "0", "--json")
    found = run("sweep", "control", "supersampling", "--knob", "grid=1,2", *words)
    assert found.code == 0, found.err
    (swept,) = found.json["effects"]
    assert swept["own_time"] == "the whole frame"
    one, two = swept["settings"]
    assert one["effect"]["metrics"]["rmse"]["low"] > two["effect"]["metrics"]["rmse"]["high"]
    assert two["effect"]["time_ms"] == two["frame"]["time_ms"]
    assert [s[view]["as_good"] for view in ("effect", "frame") for s in (one, two)] == [False, True, False, True]


def test_passes_of_other_effects_are_not_timed_where_one_is_wanted():
    choice = Choice(settings={"supersampling": {"grid": 2}, "shadow_map": {"resolution": 32}})
    renderer = Renderer(Device(), compile_plan(load("posts"), effects(), choice), (16, 16))
    everyone, own = renderer.record(2, 0), renderer.record(2, 0, only="shadow_map")
    names = [entry[:2] for entry in everyone.passes if entry[1] == "shadow_map"]
    assert 0 < len(names) < len(everyone.passes)
    assert [entry[:2] for entry in own.passes] == names
    assert all(len(times) == 2 for *_, times in own.passes) and len(own.frame) == 2
    # What further samples cost is the whole less all passes, and is not known from some of them.
    assert (everyone.sampling, own.sampling) == ("supersampling", "")


def test_supersampling_is_judged_at_all_its_samples():
    """The control's error is its outline's: 8 × 8 samples, more than `effect_sides` looks at, err less than 4 × 4.

    Where `effect_sides` looks at all, the two agree: the light is punctual, and nothing is left to chance.
    """
    truth = Truth(load("control"), (32, 32), Budget(256))

    def renderer(grid: int) -> Renderer:
        choice = Choice(without=("shadow_map",), settings={"supersampling": {"grid": grid}})
        return Renderer(Device(), compile_plan(truth.scene, effects(), choice), truth.size)

    def error(sides):
        return rmse(Comparison(sides.tested, sides.truth)).value

    four, eight = (coverage_sides(renderer(grid), truth, silent) for grid in (4, 8))
    assert error(eight) < 0.75 * error(four)
    some = effect_sides(renderer(4), truth, silent, only=("supersampling",))["supersampling"]
    assert np.allclose(four.tested[0], some.tested[0], rtol=1e-6, atol=0)


def test_what_an_effect_bakes_is_shown_apart(run, tmp_path):
    words = ("--environment", "studio", "--use", "spherical_harmonics", "--size", "16x16", *BRIEF)
    found = run("sweep", "plane", "spherical_harmonics", "--knob", "order=2,3", *words)
    assert found.code == 0, found.err
    (swept,) = json.loads((tmp_path / "out" / "sweep.json").read_text())["effects"]
    assert all(setting["bake_ms"] > 0 for setting in swept["settings"])
    assert "baked, ms" in found.out


@pytest.mark.parametrize(("kept_from", "times"), [(0.0, 1), (math.inf, 1 + 3)])
def test_what_takes_long_to_bake_is_baked_once(run, tmp_path, monkeypatch, kept_from, times):
    """Else in every round."""
    from lightmeter.realtime.effects.spherical_harmonics.passes import Passes

    bake, baked = Passes.bake, []

    def counted(self):
        baked.append(self)
        return bake(self)

    monkeypatch.setattr(Passes, "bake", counted)
    monkeypatch.setattr(sweeping, "KEPT_BAKING", kept_from)
    words = ("--environment", "studio", "--use", "spherical_harmonics", "--size", "16x16", *BRIEF)
    found = run("sweep", "plane", "spherical_harmonics", "--knob", "order=3", *words)
    assert found.code == 0, found.err
    assert len(baked) == times
    (setting,) = json.loads((tmp_path / "out" / "sweep.json").read_text())["effects"][0]["settings"]
    assert setting["bake_ms"] > 0


def test_all_effects_are_swept_beside_one_curve(run, tmp_path):
    chosen = ("--only", "lambert,constant_ambient,narkowicz")
    found = run("sweep", "posts", "--all", "--size", "16x16", *chosen, *BRIEF, "--no-store")
    assert found.code == 0, found.err
    document = json.loads((tmp_path / "out" / "sweep.json").read_text())
    ambient, tone = document["effects"]
    assert (ambient["effect"], tone["effect"]) == ("constant_ambient", "narkowicz")
    assert "constant_ambient: effect alone" in found.out and "narkowicz: effect alone" in found.out
    # The error of a tone curve is one of code values, which no path tracer's radiance is held against.
    assert ambient["comparable"] and all("rmse" in s["effect"]["path_tracer"] for s in ambient["settings"])
    assert not tone["comparable"] and all(s["effect"]["path_tracer"] == {} for s in tone["settings"])
    # Nor does it change the frame's light: that is the same for all settings, and tells nothing of them.
    assert "constant_ambient: whole frame" in found.out and "narkowicz: whole frame" not in found.out
    assert len({s["frame"]["metrics"]["rmse"]["value"] for s in tone["settings"]}) == 1
    assert all(s["frame"]["front"] == {} for s in tone["settings"])


def test_where_no_error_is_one_of_radiance_no_path_is_traced_for_a_curve(run):
    found = run("sweep", "plane", "narkowicz", "--knob", "prescale=0.4,0.5", "--size", "16x16", *BRIEF, "--json")
    assert found.code == 0, found.err
    assert found.json["complete"] and found.json["path_tracer"] == []
    assert not any("path tracer" in note for note in found.json["notes"])
    assert all(setting["bake_ms"] is None for setting in found.json["effects"][0]["settings"])


def test_what_was_measured_before_an_interrupt_is_written(run, tmp_path, monkeypatch):
    measure, calls = sweeping.Sweeping._measure, []

    def interrupted(self, name, visit):
        calls.append(visit)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return measure(self, name, visit)

    monkeypatch.setattr(sweeping.Sweeping, "_measure", interrupted)
    found = run("sweep", "plane", "narkowicz", "--size", "16x16", *BRIEF)
    assert found.code == 130 and "interrupted" in found.err
    document = json.loads((tmp_path / "out" / "sweep.json").read_text())
    assert not document["complete"] and len(document["effects"][0]["settings"]) == 2
    assert document["path_tracer"] == []
    assert (tmp_path / "out" / "sweep.html").exists()


def test_an_interrupt_before_anything_is_measured_leaves_nothing(run, tmp_path, monkeypatch):
    def interrupted(self, name, visit):
        raise KeyboardInterrupt

    monkeypatch.setattr(sweeping.Sweeping, "_measure", interrupted)
    assert run("sweep", "plane", "narkowicz", "--size", "16x16", *BRIEF).code == 130
    assert list((tmp_path / "out").iterdir()) == []


def test_a_sweep_asks_for_no_oracle_that_its_effect_does_not_need(monkeypatch):
    """Shadow maps are held against shadow rays: nothing is traced through the scene for its indirect light."""
    truth = Truth(load("posts"), (16, 16), Budget(8))
    asked, oracle = [], Truth._oracle

    def counted(self, term, points, **options):
        asked.append((term, options.get("light")))
        return oracle(self, term, points, **options)

    monkeypatch.setattr(Truth, "_oracle", counted)
    renderer = Renderer(Device(), compile_plan(truth.scene, effects()), (16, 16))
    alone = effect_sides(renderer, truth, silent, only=("shadow_map",))
    # Punctual lights are exact, so that one batch of each serves for all.
    assert sorted(asked) == [("visibility", light) for light in range(3)]
    everything = effect_sides(renderer, truth, silent)
    assert alone.keys() == {"shadow_map"}
    for mine, theirs in zip(alone["shadow_map"].truth, everything["shadow_map"].truth, strict=True):
        assert np.array_equal(mine, theirs)
