"""Words on the command line that are wrong, for every command: one message, exit code 2, the nearest right word."""

import subprocess
import sys
from importlib.metadata import version

import pytest

COMPARE = ("compare", "plane", "--size", "16x16", "--spp", "8")

WRONG = [
    (("comapre", "plane"), "'compare'"),
    (("--bogus",), "'--bogus'"),
    (("compare",), "SCENE"),
    (("compare", "plane", "cornell-box"), "'cornell-box'"),
    (("compare", "plane", "--siez", "16x16"), "'--size'"),
    (("compare", "plane", "--size"), "--size"),
    (("compare", "cornel-box"), "'cornell-box'"),
    (("compare", "nowhere.toml"), "nowhere.toml"),
    (("compare", "nowhere.glb"), "nowhere.glb"),
    (("compare", "plane", "--camera", "left"), "glTF"),
    *(
        (("compare", "plane", "--size", size), "WxH")
        for size in ("16", "0x16", "16x0", "16x16x16", "axb", "99999x2", "")
    ),
    *((("compare", "plane", "--spp", spp), "--spp") for spp in ("0", "7", "-8", "many", "1e9", "99999999999")),
    *(
        (("compare", "plane", "--seconds", seconds), "--seconds")
        for seconds in ("0", "-1", "nan", "inf", "soon", "1e9")
    ),
    (("compare", "plane", "--size", "-16x16"), "--size"),
    (("compare", "plane", "--spp", "8", "--seconds", "1"), "one of them"),
    *((("compare", "plane", "--seed", seed), "--seed") for seed in ("-1", "4294967296", "x")),
    *((("compare", "plane", "--set", word), "EFFECT.KNOB=VALUE") for word in ("x", "x=1", "shadow_map.=1", ".a=1", "")),
    (("compare", "plane", "--set", "a.b=1", "--set", "c.d=1", "--set", "a.b=2"), "a.b is set to 1 and to 2"),
    ((*COMPARE, "--set", "shadow_mp.resolution=64"), "'shadow_map'"),
    ((*COMPARE, "--set", "shadow_map.resoltion=64"), "'resolution'"),
    ((*COMPARE, "--set", "shadow_map.resolution=-1"), "[16, 8192]"),
    ((*COMPARE, "--set", "shadow_map.resolution=nan"), "whole number"),
    ((*COMPARE, "--set", "shadow_map.resolution=many"), "whole number"),
    ((*COMPARE, "--set", "shadow_map.filter=smooth"), "one of"),
    ((*COMPARE, "--only", "cook_torance"), "'cook_torrance'"),
    ((*COMPARE, "--without", "cook_torance"), "'cook_torrance'"),
    ((*COMPARE, "--use", "sgrb"), "'srgb'"),
    ((*COMPARE, "--only="), "expected names"),
    ((*COMPARE, "--reference", "nowhere"), "nowhere"),
    (("reference", "plnae"), "'plane'"),
    (("reference", "plane", "--size", "x"), "WxH"),
    (("reference", "plane", "--spp", "3"), "--spp"),
    (("reference", "plane", "--only", "srgb"), "'--only'"),
    (("export", "plnae"), "'plane'"),
    (("export", "plane", "--size", "x"), "WxH"),
    (("export", "plane", "--camera", "left"), "glTF"),
    (("export", "plane", "--spp", "8"), "'--spp'"),
    (("effects", "shadow_mp"), "'shadow_map'"),
    (("sweep", "plnae", "shadow_map"), "'plane'"),
    (("sweep", "posts"), "--all"),
    (("sweep", "posts", "shadow_map", "--all"), "--all"),
    (("sweep", "posts", "--all", "--knob", "resolution"), "--knob"),
    (("sweep", "posts", "shadow_mp"), "'shadow_map'"),
    (("sweep", "posts", "shadow_map", "--knob", "resoltion"), "'resolution'"),
    (("sweep", "posts", "shadow_map", "--knob", "resolution=8"), "[16, 8192]"),
    (("sweep", "posts", "shadow_map", "--knob", "resolution=64,"), "whole number"),
    (("sweep", "posts", "shadow_map", "--knob", "filter=smooth"), "hard, pcf3"),
    (("sweep", "posts", "shadow_map", "--knob", "bias=0", "--knob", "bias=1"), "bias=v1,v2"),
    (("sweep", "posts", "shadow_map", "--curve", "-1"), "--curve"),
    (("sweep", "posts", "lambert", "--use", "lambert"), "no knobs at all"),
    (("sweep", "plane", "shadow_map"), "one flat shape"),
    (("sweep", "plane", "gamma_22"), "--use gamma_22"),
    (("sweep", "plane", "srgb", "--only", "cook_torrance"), "not among the effects asked for"),
    (("sweep", "plane", "--all", "--only", "lambert"), "knob to sweep"),
    (("compare", "plane", "--set", "shadow_map.res=3"), "did you mean 'resolution'?"),
    (("compare", "plane", "--use", "quartz"), "there are: area_as_point"),
    (("--verson",), "'--version'"),
    (("scenes", "plane"), "'plane'"),
    (("store", "purge"), "prune"),
    (("store", "prune"), "--older-than"),
    (("store", "--older-than", "3d"), "prune"),
    *((("store", "prune", "--older-than", text), "30d") for text in ("3", "d", "3 moons", "1e3d")),
    *((("store", "prune", "--larger-than", text), "5GB") for text in ("big", "5XB", "GB")),
    (("store", "prune", "--larger-than", "-1GB"), "--larger-than"),
    (("store", "prune", "--key", "zzz"), "zzz"),
    (("diff", "a.png"), "B"),
    (("diff", "a.png", "b.png"), "a.png"),
    (("diff", "a.png", "b.png", "--transfer", "log"), "srgb or linear"),
    (("diff", "a.png", "b.png", "--exposure", "bright"), "--exposure"),
    (("diff", "a.png", "b.png", "--exposure", "1e9"), "--exposure"),
    (("diff", "a.png", "b.png", "--metric", "flp"), "'flip'"),
    (("gate",), "lightmeter.toml"),
    (("gate", "--config", "nowhere.toml"), "nowhere.toml"),
    (("schema", "plane"), "'plane'"),
    (("doctor", "--jsn"), "'--json'"),
]


@pytest.mark.parametrize(
    ("words", "named"), WRONG, ids=lambda value: " ".join(value) if isinstance(value, tuple) else ""
)
def test_a_wrong_word_is_named_with_what_is_right(refused, words, named):
    assert named in refused(*words)


@pytest.mark.parametrize("command", ["compare", "reference", "diff"])
def test_an_output_folder_that_cannot_be_is_found_before_the_work(refused, tmp_path, command):
    from .small_images import noise, png

    (tmp_path / "file").write_text("")
    what = ["plane"]
    if command == "diff":
        what = [png(tmp_path / f"{name}.png", noise()) for name in "ab"]
    for folder in ("file", "file/below"):
        assert folder in refused(command, *what, "-o", folder)


def test_a_store_that_cannot_be_written_is_one_message(run, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("LIGHTMETER_STORE", str(tmp_path / "file"))
    found = run("reference", "plane", "--size", "8x8", "--spp", "8", "-o", "out")
    assert found.code == 0, "a store saves work; that there is none is no reason to do none"
    assert "file" in found.err
    assert found.err.count("\n") == 1
    assert (tmp_path / "out" / "manifest.json").exists()


def test_the_version_is_that_of_the_package(run):
    found = run("--version")
    assert (found.code, found.out) == (0, f"lightmeter {version('lightmeter')}\n")


def test_without_a_command_the_help_is_on_stderr(run):
    found = run()
    assert found.code == 2
    assert found.out == ""
    assert "compare" in found.err


@pytest.mark.parametrize(
    "command",
    [
        "compare",
        "reference",
        "export",
        "sweep",
        "gate",
        "stress",
        "diff",
        "scenes",
        "effects",
        "store",
        "schema",
        "doctor",
    ],
)
def test_every_command_explains_itself(run, command):
    found = run(command, "--help")
    assert found.code == 0
    assert "--json" in found.out
    assert found.err == ""


def test_the_installed_program_says_the_same():
    """As a user runs it: a process of its own, and the words of an error."""
    command = [sys.executable, "-m", "lightmeter", "compare", "plnae"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1
    assert "did you mean 'plane'?" in done.stderr.lower()


def test_a_reader_that_goes_away_is_no_error():
    """`lightmeter schema | head -1`: nothing on stderr."""
    command = f"'{sys.executable}' -m lightmeter schema | head -c 1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
    assert done.stderr == ""
