"""Engines side by side in words and in the terminal."""

import dataclasses
import io

import pytest
from rich.console import Console

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.candidate_words import masked_words, pixel_words, remedies, time_as_measured
from lightmeter.reports.candidates_content import candidates_content
from lightmeter.reports.results import Attribution, FailedCandidate, Finding, LayerError, Player, Results, Timing
from lightmeter.reports.shown_names import printable_lines, short_name, text_width
from lightmeter.reports.terminal import comparison

from .synthetic_pairs import make_candidates, make_failed, make_results


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("three.js", "three.js"),
        ("0123456789", "0123456789"),
        ("engine 3.1 with shadows", "engin…dows"),
        ("引擎渲染器", "引擎渲染器"),
        ("引擎渲染器测试", "引擎…测试"),
        ("a\x1b[2Jb\u202e", "a�[2Jb�"),
    ],
)
def test_long_names_are_cut_in_their_middle(name: str, shown: str) -> None:
    assert short_name(name, 10) == shown
    assert text_width(shown) <= 10


def test_messages_keep_their_lines_and_lose_what_steers() -> None:
    assert printable_lines("\n a\tb \r\n\x1b]0;owned\x07\n\n") == "a   b\n�]0;owned�"


def test_the_remedy_names_all_that_can_be_corrected() -> None:
    shift, exposure, background = (
        Finding("shift", ""),
        Finding("exposure", "", corrected=True),
        Finding("background", ""),
    )
    register = ("to correct it before anything is measured", "--register shift,exposure")
    leave_out = ("to leave out the background", "--no-background")
    assert remedies([shift, exposure, background]) == [register, leave_out]
    assert remedies([exposure, background]) == [leave_out]
    assert remedies([exposure]) == []


def test_masks_are_told_the_largest_first() -> None:
    candidate = dataclasses.replace(make_candidates()[0], masked={"a": 3, "b": 4000, "c": 0})
    assert masked_words(candidate) == ["4,000 b", "3 a"]


def test_pixels_are_all_or_those_that_every_engine_supports() -> None:
    candidates = make_candidates()
    assert pixel_words(candidates, (40, 100)) == "over all 4,000 pixels"
    assert pixel_words(candidates, (40, 101)) == "over 4,000 of 4,040 pixels, those that every engine supports"


def test_a_single_run_has_no_spread() -> None:
    assert time_as_measured(Timing(20.0, 0.0, 1)) == Measurement(20.0, unit="ms")
    assert time_as_measured(Timing(20.0, 0.5, 2)) == Measurement(20.0, 19.5, 20.5, "ms")


def test_a_share_is_given_to_one_layer_only() -> None:
    """A player called as a term is the layer of that term, unless there are several: then it is none of them."""
    candidate = make_candidates()[1]
    part = {"mse": Measurement(0.5)}
    players = tuple(Player(name, (name,), True, part, {}) for name in ("direct", "visibility", "visibility.1"))
    layers = tuple(
        LayerError(name, term, {}, 1)
        for name, term in (("sun", "direct"), ("visibility.0", "visibility"), ("visibility.1", "visibility"))
    )
    candidate = dataclasses.replace(
        candidate, layers=layers, attribution=Attribution({"mse": Measurement(2.0)}, {}, players, 8, True)
    )
    content = candidates_content(Results("s", (1, 1), make_results().frame, candidates=(candidate,)), set())
    assert content
    (table,) = content["layers"]
    assert [bool(row["share"]) for row in table["rows"]] == [True, False, True]
    assert [(row["name"], row["remark"]) for row in table["rest"]] == [("visibility", "its layers together")]
    assert table["rows"][0]["share"]["cell"]["value"] == "25.0"


def test_layers_without_shares_have_no_column_of_them() -> None:
    candidate = dataclasses.replace(make_candidates()[1], attribution=None)
    content = candidates_content(Results("s", (1, 1), make_results().frame, candidates=(candidate,)), set())
    assert content
    assert content["layers"][0]["shared"] == ""
    assert content["layers"][0]["rest"] == []


def test_no_engines_no_section() -> None:
    assert candidates_content(make_results(), set()) is None


def printed(results: Results, width: int = 120) -> list[str]:
    console = Console(file=io.StringIO(), width=width, color_system=None)
    console.print(comparison(results))
    return console.file.getvalue().splitlines()


def test_terminal_lists_engines_findings_and_failures() -> None:
    lines = printed(dataclasses.replace(make_results(), candidates=make_candidates(), failed_candidates=make_failed()))
    assert max(map(len, lines)) <= 120
    rows = [line.split() for line in lines]
    assert ["lightmeter", "(ours)", "0.0810", "±", "0.0024", "0.0900", "0.9100", "−0.0405", "9.87", "±", "0.21"] in rows
    assert ["slow", "0.02000", "±", "0.00060", "0.0300", "0.9700", "−0.01000", "2400"] in rows
    for line in (
        "RMSE in W/sr/m²; over 4,000 of 9,216 pixels, those that every engine supports",
        "time of slow: measured around the command",
        "registration of our <engine> & co: shift: shifted by 0.50 pixels right and 0.00 down; not corrected",
        "registration of our <engine> & co: exposure: brighter by a factor of 1.50; corrected as asked",
        "  to correct it before anything is measured: --register shift,exposure",
        "masked for our <engine> & co: 80 unsupported material glass, 16 background",
        "layer of our <engine> & co: visibility.0 (visibility): RMSE 0.01100 ± 0.00033 W/sr/m², FLIP 0.0200 ± 0.0010",
        "note of our <engine> & co: No indirect light.",
        "✕ broken gave no frame: it ended with exit code 1; its last output: no display",
    ):
        assert line in [line.rstrip() for line in lines]


def test_a_narrow_terminal_breaks_no_number_of_an_engine() -> None:
    results = Results("s", (1, 1), make_results().frame, candidates=make_candidates())
    words = " ".join(printed(results, width=80)).split()
    for number in ("0.0024", "0.00060", "−0.01000", "22.40", "0.90"):
        assert number in words


def test_an_engine_cannot_steer_the_terminal() -> None:
    evil = "\x1b[2J[red]\n"
    candidate = dataclasses.replace(
        make_candidates()[1], name=evil, notes=(evil,), findings=(Finding(evil, evil),), masked={evil: 1}, time_how=evil
    )
    results = Results(
        "s", (1, 1), make_results().frame, candidates=(candidate,), failed_candidates=(FailedCandidate(evil, evil),)
    )
    text = "\n".join(printed(results))
    assert "\x1b" not in text
    assert "note of �[2J[red]�: �[2J[red]�" in text


def test_terminal_says_nothing_of_engines_where_there_are_none() -> None:
    assert not any("engine" in line for line in printed(make_results()))
