"""Knobs and values that make no difference leave no rows."""

import json

from lightmeter.idle_knobs import needless
from lightmeter.knob_words import Visit
from lightmeter.realtime.renderer import Renderer


def star(**values: tuple) -> list[Visit]:
    """All knobs at 0, and from there one at a time."""
    zero = dict.fromkeys(values, 0)
    return [Visit(zero, ())] + [Visit({**zero, k: v}, (k,)) for k, listed in values.items() for v in listed]


def grid(a: tuple, b: tuple) -> list[Visit]:
    return [Visit({"a": x, "b": y}, ("a", "b")) for x in a for y in b]


def test_of_a_star_nothing_is_needed_that_does_not_differ_from_the_current_setting():
    visits = star(a=(1, 2), b=(1, 2), c=(1, 2, 3))
    # None of a's values differs; b's do, and not from one another; of c the second does not.
    pictures = ["here", "here", "here", "other", "other", "else", "here", "third"]
    assert needless(visits, pictures) == {"a": [1, 2], "c": [6]}


def test_a_value_alone_says_nothing_of_its_knob():
    assert needless(grid((0, 1), (5,)), ["same", "other"]) == {}


def test_of_a_grid_a_knob_is_idle_when_it_never_matters():
    visits = grid((0, 1), (0, 1))
    assert needless(visits, ["x", "x", "y", "y"]) == {"b": [1, 3]}
    assert needless(visits, ["x", "x", "y", "z"]) == {}  # b matters where a is 1
    assert needless(visits, ["x", "x", "x", "x"]) == {"a": [2, 3], "b": [1]}


def test_a_sweep_tells_in_a_line_what_changes_nothing(run, monkeypatch, tmp_path):
    """The tint of a conductor's edge is read by no shader but that of fresnel=conductor. It is timed once, not four
    times, and then leaves; the distribution of normals matters, and stays."""
    record, timed = Renderer.record, []

    def counted(self, *words):
        timed.append(words)
        return record(self, *words)

    monkeypatch.setattr(Renderer, "record", counted)
    knobs = ("--knob", "distribution=ggx,beckmann", "--knob", "edge_tint=0,1")
    words = ("--only", "cook_torrance", "--size", "16x16", "--spp", "8", "--curve", "0", "-o", "out")
    found = run("sweep", "torus", "cook_torrance", *knobs, *words)
    assert found.code == 0, found.err
    (swept,) = json.loads((tmp_path / "out" / "sweep.json").read_text())["effects"]
    assert [s["knobs"]["distribution"] for s in swept["settings"]] == ["ggx", "beckmann"]
    assert all(s["varied"] == ["distribution"] for s in swept["settings"])
    (idle,) = swept["idle"]
    assert (idle["knob"], idle["values"]) == ("edge_tint", [1.0])
    assert 0 < idle["least_ms"] <= idle["most_ms"]
    assert len(timed) == 4 + 3 * 2
    assert "No row for edge_tint (1): the same picture bit for bit, in " in found.out
    assert "edge_tint 0" not in found.out
