"""`--json` prints exactly one JSON document on stdout, for every command."""

import json

import pytest

from lightmeter.cli import COMMANDS

from .small_images import noise, png

SMALL = ("--size", "16x16", "--spp", "8", "-o", "out")

WORDS = {
    "compare": ("plane", *SMALL),
    "reference": ("plane", *SMALL),
    "export": ("plane", "-o", "out"),
    "sweep": ("plane", "narkowicz", "--knob", "prescale=0.6", "--curve", "0", *SMALL),
    "gate": (),
    "stress": ("--function", "shared/f_schlick", "-o", "out"),
    "diff": ("a.png", "a.png", "-o", "out"),
    "scenes": (),
    "effects": (),
    "store": (),
    "schema": (),
    "doctor": (),
}


def test_every_command_is_here():
    assert set(WORDS) == set(COMMANDS)


@pytest.mark.parametrize("command", WORDS)
def test_one_document(run, tmp_path, command):
    png(tmp_path / "a.png", noise())
    limit = '[[limit]]\nscene = "plane"\nmetric = "flip"\nmax = 1\nsize = "16x16"\nspp = 8\n'
    (tmp_path / "lightmeter.toml").write_text(limit)
    found = run(command, *WORDS[command], "--json")
    assert found.code in (0, 1) if command == "doctor" else found.code == 0
    document = json.loads(found.out, parse_constant=lambda name: pytest.fail(f"{name} is not JSON"))
    assert document


def test_an_effect_is_described_with_its_knobs(run):
    (described,) = run("effects", "shadow_map", "--json").json
    assert described.keys() == {"name", "terms", "summary", "citation", "knobs", "bytes_per_pixel"}
    assert all(knob.keys() == {"name", "default", "unit", "range", "help"} for knob in described["knobs"])


def test_lists_name_what_there_is(run):
    assert {"cornell-box", "plane"} <= {scene["name"] for scene in run("scenes", "--json").json}
    assert "cornell-box" in run("scenes").out
    assert "shadow_map" in run("effects").out
    assert "resolution" in run("effects", "shadow_map").out
