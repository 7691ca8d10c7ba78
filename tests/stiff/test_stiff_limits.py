"""Limits on stiff scenes: what is not finite, what is refused wrongly, and what cannot be judged."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lightmeter import stiff_limits, stiff_scenes
from lightmeter.limit_scenes import find_scenes
from lightmeter.progress import silent
from lightmeter.scenes.stiff import CASES
from lightmeter.scenes.stiff.case import StiffCase, room
from lightmeter.scenes.stiff.lights import DARK
from lightmeter.stiff_limits import error_limits, judge_scenes
from lightmeter.stress_limits import StressEntry

FILE = Path("lightmeter.toml")


def judged(monkeypatch, metric: str, case: StiffCase):
    """The verdict on one case, of eight pixels a side."""
    plain = StiffCase("plain", room, size=(8, 8))
    monkeypatch.setattr(stiff_limits, "CASES", {"plain": plain, "odd": replace(case, size=(8, 8))})
    (verdict,) = judge_scenes([StressEntry(scene="odd", metric=metric, max=0)], FILE, silent)
    return verdict


def test_a_pixel_that_is_not_finite_fails(monkeypatch):
    made = stiff_scenes._render

    def broken(*arguments):
        sides = made(*arguments)
        frame = sides.frame.copy()
        frame[2, 3:5, 0] = np.inf
        return replace(sides, frame=frame)

    monkeypatch.setattr(stiff_scenes, "_render", broken)
    verdict = judged(monkeypatch, "faults", StiffCase("broken", room))
    assert verdict.status == "FAIL" and verdict.measurement.value == 2
    assert "2 non-finite pixels (2 +inf), first at row 2, column 3" in verdict.message
    assert judged(monkeypatch, "changed", StiffCase("broken", room, like="plain")).status == "FAIL"


def test_a_refusal_must_be_as_it_is_meant(monkeypatch):
    texel = CASES["nan-texel"].scene
    assert judged(monkeypatch, "faults", StiffCase("at fault", texel, refused="1 NaN")).status == "PASS"
    for case in (
        StiffCase("not at fault", room, refused="1 NaN"),
        StiffCase("another fault", texel, refused="1 +inf"),
        StiffCase("refused", texel),
    ):
        assert judged(monkeypatch, "faults", case).status == "FAIL", case.what


def test_without_light_no_change_can_be_judged(monkeypatch):
    dark = StiffCase("dark", lambda: room(lights=(), environment=DARK), size=(8, 8))
    monkeypatch.setattr(stiff_limits, "CASES", {"plain": dark, "odd": replace(dark, like="plain")})
    (verdict,) = judge_scenes([StressEntry(scene="odd", metric="changed", max=0)], FILE, silent)
    assert verdict.status == "UNDECIDED" and "black" in verdict.reason


def test_a_limit_on_an_error_is_one_on_the_frame_at_the_scenes_own_size():
    (limit,) = error_limits([StressEntry(scene="tall", metric="nrmse", max=0.5)])
    assert (limit.scene, limit.of, limit.metric, limit.high) == ("stiff/tall", "frame", "nrmse", 0.5)
    assert limit.conditions.size == (1, 16384)
    (lights,) = error_limits([StressEntry(scene="thousand-lights", metric="nrmse", max=0.5)])
    assert lights.conditions.settings == (("shadow_map", "resolution", 128),)
    assert len(error_limits([StressEntry(scene="*", metric="nrmse", max=1)])) == sum(
        not c.refused for c in CASES.values()
    )


def test_a_pattern_of_stiff_scenes_leaves_out_what_is_refused():
    found = find_scenes("stiff/*-texel", FILE, "here")
    assert found == ["stiff/one-texel"]
    assert find_scenes("stiff/small", FILE, "here") == ["stiff/small"]
    with pytest.raises(ValueError, match="no scene of the library"):
        find_scenes("stiff/smal", FILE, "here")
