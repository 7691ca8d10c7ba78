"""What attribution and objects become in words, percentages and bars."""

import dataclasses
import io
import math

import pytest
from rich.console import Console

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.fix_first import fix_first
from lightmeter.reports.html import render_report
from lightmeter.reports.object_content import object_content
from lightmeter.reports.page_content import page_content
from lightmeter.reports.percentages import percent_of
from lightmeter.reports.results import Attribution, Effect, Frame, ObjectError, Player, Results, Timing, Together
from lightmeter.reports.signed_bars import Axis
from lightmeter.reports.terminal import comparison

from .synthetic_pairs import make_objects, make_results


def attributed(total: Measurement, approximated: bool = True, **removed: Measurement) -> tuple[Results, Attribution]:
    """Results of players who remove so much, each an effect of 20.9 ms."""
    players = tuple(Player(name, (name,), approximated, {"mse": one}, {"mse": one}) for name, one in removed.items())
    attribution = Attribution({"mse": total}, {"mse": Measurement(0.0)}, players, 2 ** len(players), True)
    effects = tuple(Effect(name, (name,), time_ms=Timing(20.9, 0.4, 40)) for name in removed if approximated)
    return Results("s", (1, 1), Frame({}), effects=effects, attribution=attribution), attribution


TOTAL = Measurement(0.5, 0.49, 0.51, "W")


@pytest.mark.parametrize(
    ("removed", "verdict", "sentence"),
    [
        (
            Measurement(0.31, 0.30, 0.32, "W"),
            "fix",
            "Making a exact would remove 62.0 ± 2.0 % of the frame's squared error; it takes 20.9 ms.",
        ),
        (
            Measurement(0.31, 0.30, 0.36, "W"),
            "fix",
            "Making a exact would remove 62.0 (60.0 … 72.0) % of the frame's squared error; it takes 20.9 ms.",
        ),
        (
            Measurement(0.4, -0.1, 0.9),
            "unsure",
            "What making a exact would remove cannot be told from noise: 80 ± 100 %.",
        ),
        (Measurement(0.4), "unsure", "What making a exact would remove is not known: 80.0 %."),
        (Measurement(math.nan, 0.1, 0.2), "unsure", "What making a exact would remove is not known: NaN %."),
        (
            Measurement(-0.05, -0.06, -0.03),
            "worse",
            "Making a exact alone would make the frame worse, by 10.0 (6.0 … 12.0) % of the frame's squared error: "
            "its error makes up for another's.",
        ),
        (
            Measurement(-1e-4, -2.4e-4, 0.0),
            "exact",
            "a is as good as exact: less than 0.05 % of the frame's squared error is its.",
        ),
        (
            Measurement(1e-4, 0.9e-4, 2.6e-4),
            "fix",
            "Making a exact would remove 0.020 (0.018 … 0.052) % of the frame's squared error; it takes 20.9 ms.",
        ),
    ],
)
def test_only_what_stands_out_of_noise_is_recommended(removed: Measurement, verdict: str, sentence: str) -> None:
    (advice,) = fix_first(*attributed(TOTAL, a=removed), "mse")
    assert (advice.verdict, advice.sentence) == (verdict, sentence)


def test_a_term_without_effect_has_no_time_and_says_so() -> None:
    (advice,) = fix_first(*attributed(TOTAL, False, indirect=Measurement(0.1, 0.09, 0.11)), "mse")
    assert advice.sentence.endswith(
        "20.0 ± 2.0 % of the frame's squared error; no effect that takes part approximates it."
    )


def test_advice_is_sorted_by_what_it_removes_and_noise_comes_after() -> None:
    sure, small = Measurement(0.2, 0.19, 0.21), Measurement(0.1, 0.09, 0.11)
    noise, worse = Measurement(0.9, -0.1, 1.9), Measurement(-0.1, -0.2, -0.05)
    advice = fix_first(*attributed(TOTAL, worse=worse, noise=noise, small=small, sure=sure), "mse")
    assert [item.name for item in advice] == ["sure", "small", "noise", "worse"]


@pytest.mark.parametrize(
    ("low", "advised"),
    [(0.29, True), (0.105, False), (-0.1, False)],  # beyond both alone; within the larger's interval; within noise
)
def test_two_that_make_up_for_one_another_are_advised_together(low: float, advised: bool) -> None:
    alone = {"a": Measurement(-0.1, -0.2, -0.05), "b": Measurement(0.1, 0.09, 0.11)}
    results, attribution = attributed(TOTAL, **alone)
    both = Together(("a", "b"), {"mse": Measurement(0.3, low, 0.31, "W")})
    advice = fix_first(results, dataclasses.replace(attribution, together=(both,)), "mse")
    assert [item.name for item in advice] == [*(["a and b"] if advised else []), "b", "a"]
    if advised:
        assert advice[0].sentence == (
            "Making a and b exact together would remove 60.0 ± 2.0 % of the frame's squared error: "
            "their errors make up for one another."
        )


def test_a_frame_without_a_certain_error_has_no_percentages() -> None:
    part = Measurement(0.1, 0.05, 0.2, "W")
    assert percent_of(part, Measurement(0.5, -0.1, 1.1)) is None
    assert percent_of(part, Measurement(-0.01, -0.02, -0.005)) is None
    assert percent_of(part, Measurement(math.nan)) is None
    assert percent_of(part, Measurement(0.5, 0.1, 1.1)) == Measurement(20.0, 10.0, 40.0, "%")
    (advice,) = fix_first(*attributed(Measurement(0.5, -0.1, 1.1), a=part), "mse")
    assert "would remove 0.100 (0.050 … 0.200) W of the frame's squared error" in advice.sentence


def test_bars_start_at_0_on_one_axis() -> None:
    axis = Axis.spanning([Measurement(6, 4, 8), Measurement(-1, -2, 0.5), Measurement(math.nan), Measurement(1)])
    assert axis == Axis(-2, 8)
    assert axis.bar(Measurement(6, 4, 8)) == {
        "start": 20, "width": 60, "zero": 20, "sign": "positive", "low": 60, "high": 100
    }  # fmt: skip
    assert axis.bar(Measurement(-1, -2, math.inf)) == {
        "start": 10, "width": 10, "zero": 20, "sign": "negative", "low": 0, "high": 100
    }  # fmt: skip
    assert axis.bar(Measurement(1)) == {"start": 20, "width": 10, "zero": 20, "sign": "positive"}
    assert axis.bar(Measurement(math.nan)) is None
    assert Axis.spanning([Measurement(3, 2, 4)]) == Axis(0, 4)
    assert Axis.spanning([Measurement(0.0, 0.0, 0.0)]).bar(Measurement(0.0, 0.0, 0.0))


def test_shares_and_unexplained_add_up_to_the_whole() -> None:
    for panel in page_content(make_results(), {"shadow_map"})["attribution"]:
        cells = [row["cell"] for row in panel["rows"]] + [panel["unexplained"]["cell"]]
        assert {cell["unit"] for cell in cells} == {"%"}
        # Each is rounded to a tenth of a percent, or finer.
        shares = [float(cell["value"].replace("−", "-")) for cell in cells]
        assert sum(shares) == pytest.approx(100, abs=0.05 * len(cells))


def test_what_no_effect_approximates_has_no_time() -> None:
    panel = page_content(make_results(), set())["attribution"][0]
    rows = {row["name"]: row for row in panel["rows"]}
    assert rows["transmission"]["time"] is None
    assert not rows["transmission"]["approximated"]
    assert rows["shadow_map"]["time_bar"] == 100
    assert rows["cook_torrance"]["time_bar"] == pytest.approx(100 * 1.82 / 3.41, abs=0.01)
    assert panel["compensates"]
    assert "all 32 sets" in panel["effort"]
    assert "12.3 ms a set" in panel["effort"]


def test_sampled_sets_are_not_called_all() -> None:
    results = make_results()
    assert results.attribution
    sampled = dataclasses.replace(results.attribution, exhaustive=False, subsets=420)
    (panel, _) = page_content(dataclasses.replace(results, attribution=sampled), set())["attribution"]
    assert "for 420 sets" in panel["effort"]
    assert "random orders" in panel["effort"]


def test_effects_have_their_share_in_percent() -> None:
    content = page_content(make_results(), set())["effects"]
    shares = {row["name"]: row["share"] for row in content["rows"]}
    assert (shares["shadow_map"]["value"], shares["shadow_map"]["unit"]) == ("62.2", "%")
    assert shares["narkowicz"] is None


def test_at_most_twenty_objects_are_listed_and_the_rest_is_summed_up() -> None:
    content = object_content(tuple(reversed(make_objects(30))))
    assert content
    assert [row["name"] for row in content["rows"][:2]] == ["floor", "ball"]
    assert len(content["rows"]) == 20
    # 30 objects: floor, ball, 18 of the 27 pebbles; 9 pebbles of 40 pixels and the background remain.
    assert content["others"] == {"count": "10", "pixels": f"{9 * 40 + 1800:,}", "share": "1.0 %"}
    assert [column["name"] for column in content["columns"]] == ["rmse", "bias", "flip"]


def test_an_object_that_is_not_a_number_is_not_hidden() -> None:
    broken = ObjectError("lamp", "", 3, {"rmse": Measurement(math.nan)}, Measurement(math.nan))
    content = object_content((*make_objects(30), broken))
    assert content
    assert content["rows"][0]["name"] == "lamp"
    assert content["rows"][0]["cells"][0]["failed"]
    assert content["rows"][1]["name"] == "floor"


def test_a_frame_without_error_has_no_shares_and_no_worst_object() -> None:
    """A frame that is right to the last bit has no error to share out: that is no failure."""
    objects = tuple(dataclasses.replace(one, share=Measurement(math.nan)) for one in make_objects(30))
    content = object_content(objects)
    assert content
    assert [row["share"] for row in content["rows"]] == [None] * 20
    assert [row["bar"] for row in content["rows"]] == [None] * 20
    assert content["others"]["share"] == "–"
    assert not any("largest error" in line for line in printed(dataclasses.replace(make_results(), objects=objects)))


def test_nothing_attributed_gives_no_section() -> None:
    content = page_content(Results("s", (1, 1), Frame({})), set())
    assert content["attribution"] == []
    assert content["objects"] is None


def test_percentiles_stand_beside_the_mean() -> None:
    content = page_content(make_results(), set())
    tiles = {tile["label"]: tile for tile in content["tiles"]}
    assert tiles["FLIP"]["tail"].replace("\N{NO-BREAK SPACE}", " ") == "p95 0.2140 · p99 0.433 · worst tile 0.377"
    assert tiles["nRMSE"]["tail"] == ""
    assert content["effects"]["rows"][-1]["rmse"]["tail"].startswith("p95")


def printed(results: Results) -> list[str]:
    console = Console(file=io.StringIO(), width=120, color_system=None)
    console.print(comparison(results))
    return console.file.getvalue().replace("\N{NO-BREAK SPACE}", " ").splitlines()


def test_terminal_says_shares_what_to_fix_and_which_object() -> None:
    lines = printed(make_results())
    assert max(map(len, lines)) <= 120
    assert any("shadow_map" in line and "62.2 ± 2.9" in line for line in lines)
    assert any(line.split() == ["unexplained", "5.2", "±", "2.4"] for line in lines)
    assert (
        "fix first (squared error removed): shadow_map 58.9 ± 3.1 %, constant_ambient 19.2 ± 1.7 %, "
        "environment_visibility 12.4 ±" in "\n".join(lines)
    )
    assert "largest error: floor (concrete) holds 71.0 ± 2.0 % of the squared error, on 4,120 pixels" in lines
    assert any("FLIP p95 0.2140 · p99 0.433 · worst tile 0.377" in line for line in lines)


def test_terminal_recommends_nothing_that_is_noise() -> None:
    results, _ = attributed(TOTAL, a=Measurement(0.4, -0.1, 0.9), b=Measurement(-0.1, -0.2, -0.05))
    assert "fix first (squared error removed): nothing stands out of the noise" in printed(results)


def test_a_frame_that_is_not_a_number_is_said_to_be_one() -> None:
    results, _ = attributed(Measurement(math.nan), a=Measurement(math.nan))
    page = render_report(results, [])
    assert page.count("✕ NaN") == 2  # the share and the whole
    assert "Nothing can be recommended" in page
    assert not any("fix first" in line for line in printed(results))


def test_terminal_has_no_share_column_without_attribution() -> None:
    lines = printed(dataclasses.replace(make_results(), attribution=None, objects=()))
    assert not any(word in line for line in lines for word in ("% of MSE", "fix first", "largest error"))


def test_an_object_cannot_steer_the_terminal() -> None:
    evil = ObjectError("\x1b[2J\x1b]0;owned\x07[red]", "a\nb", 1, {}, Measurement(1.0))
    (line,) = [line for line in printed(Results("s", (1, 1), Frame({}), objects=(evil,))) if "largest error" in line]
    assert "�[2J�]0;owned�[red] (a�b) holds 100" in line
