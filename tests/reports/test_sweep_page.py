"""A sweep's page in a browser, and its JSON and CSV."""

import csv
import io
import json
import math
from dataclasses import replace
from pathlib import Path

import pytest

from lightmeter.reports.results_json import to_json
from lightmeter.reports.sweep_figures import figure, groups
from lightmeter.reports.sweep_page import render_sweep, write_sweep
from lightmeter.reports.sweep_results import best, to_csv
from lightmeter.reports.sweep_table import conclusions, remarks

from .chromium_pipe import Page
from .report_page import needs_chromium
from .synthetic_sweep import make_sweep


@pytest.fixture(scope="module")
def page(page: Page, tmp_path_factory: pytest.TempPathFactory) -> Page:
    """With the sweep open."""
    page.open(write_sweep(tmp_path_factory.mktemp("sweep"), make_sweep()))
    page.until("document.body.dataset.shown === 'effect rmse'")
    return page


def choose(page: Page, view: str, metric: str) -> None:
    for value in (view, metric):
        page.evaluate(f"document.querySelector('input[value={value}]').click()")
    page.until(f"document.body.dataset.shown === '{view} {metric}'")


def trace(page: Page, name: str, plot: int = 0):
    """A drawn trace, by its name in the legend."""
    return page.evaluate(
        f"(d => d && {{x: d.x, y: d.y, hover: d.hovertext}})"
        f"(document.querySelectorAll('.plot')[{plot}].data.find(d => d.name === '{name}'))"
    )


@needs_chromium
def test_pointing_at_a_point_shows_its_setting(page: Page) -> None:
    choose(page, "effect", "rmse")
    box = page.evaluate("(b => [b.left, b.top])(document.querySelector('.plot .nsewdrag').getBoundingClientRect())")
    place = page.evaluate(
        "(l => [l.xaxis.l2p(Math.log10(1.5)), l.yaxis.l2p(Math.log10(0.2))])"
        "(document.querySelector('.plot')._fullLayout)"
    )
    for step in (3, 0):  # a browser tells of a pointer that moves
        page.mouse("mouseMoved", box[0] + place[0] + step, box[1] + place[1])
    page.until("!!document.querySelector('.plot .hovertext')")
    text = page.evaluate("document.querySelector('.plot .hovertext').textContent")
    assert "resolution 128, filter pcf3" in text
    assert "0.2" in text and "1.50 ± 0.15 ms" in text
    assert "on the Pareto front" in text and "the path tracer is as good after 16.0 ms" in text


@needs_chromium
def test_view_and_metric_can_be_chosen(page: Page) -> None:
    """The frame's error is 0.01 more and its time 2 ms more; FLIP has values of its own."""
    choose(page, "frame", "rmse")
    drawn = trace(page, "filter hard")
    assert drawn["x"] == [3.0, 4.5] and drawn["y"] == [0.31, 0.26]
    choose(page, "frame", "flip")
    assert trace(page, "filter hard")["y"] == [0.2, 0.2]
    assert "FLIP" in page.evaluate("document.querySelector('.plot .ytitle').textContent")
    shown = page.evaluate("[...document.querySelectorAll('[data-view]:not([hidden])')].map(e => ({...e.dataset}))")
    assert {(e["view"], e["metric"]) for e in shown} == {("frame", "flip")} and len(shown) == 2


@needs_chromium
def test_the_plot_s_buttons_cover_neither_plot_nor_legend(page: Page) -> None:
    choose(page, "effect", "rmse")
    edge = "Math.min(...[...document.querySelectorAll('.plot .modebar')].map(b => b.getBoundingClientRect().left))"
    ends = "Math.max(...[...document.querySelectorAll('.plot .nsewdrag, .plot .legend')]"
    assert page.evaluate(edge) >= page.evaluate(ends + ".map(b => b.getBoundingClientRect().right))")


@needs_chromium
def test_code_values_have_no_path_tracer_beside_them(page: Page) -> None:
    choose(page, "effect", "rmse")
    assert trace(page, "path tracer", 0) and not trace(page, "path tracer", 1)


@needs_chromium
def test_what_changes_no_light_has_no_plot_of_the_frame(page: Page) -> None:
    hidden = "[...document.querySelectorAll('.plot')].map(place => place.hidden)"
    choose(page, "effect", "rmse")
    assert page.evaluate(hidden) == [False, False]
    choose(page, "frame", "flip")
    assert page.evaluate(hidden) == [False, True]
    assert "narkowicz changes code values, and no light of the frame." in page.evaluate("document.body.innerText")


@needs_chromium
def test_it_is_readable_in_the_dark(page: Page) -> None:
    """Ink and paper follow the reader's choice, while the page is open."""
    colour = "getComputedStyle(document.querySelector('.plot .xtitle')).fill"
    found = {}
    for scheme in ("light", "dark"):
        page.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        wanted = page.evaluate("getComputedStyle(document.documentElement).getPropertyValue('--ink').trim()")
        page.until(f"document.querySelector('.plot').layout.font.color === '{wanted}'")
        found[scheme] = page.evaluate(colour)
    assert found["light"] != found["dark"]


def test_a_name_cannot_become_markup(tmp_path: Path) -> None:
    text = write_sweep(tmp_path, make_sweep()).read_text(encoding="utf-8")
    assert "<posts>" not in text and "&lt;posts&gt; &amp; co" in text


def test_an_interrupted_sweep_says_so(tmp_path: Path) -> None:
    assert "Interrupted" in write_sweep(tmp_path, make_sweep(complete=False)).read_text(encoding="utf-8")


def test_json_and_csv_say_the_same() -> None:
    document = json.loads(to_json(make_sweep()))
    rows = list(csv.DictReader(io.StringIO(to_csv(make_sweep()))))
    settings = [(e["effect"], s) for e in document["effects"] for s in e["settings"]]
    assert len(rows) == len(settings) + len(document["path_tracer"])
    for row, (effect, setting) in zip(rows, settings, strict=False):
        assert row["what"] == effect and row["current"] == str(int(setting["current"]))
        assert all(row[name] == str(value) for name, value in setting["knobs"].items())
        same(row["bake_ms"], setting["bake_ms"])
        for view in ("effect", "frame"):
            standing = setting[view]
            same(row[f"{view}_ms"], standing["time_ms"]["median"])
            for name, measured in standing["metrics"].items():
                for column, value in (("", measured["value"]), ("_low", measured["low"]), ("_high", measured["high"])):
                    same(row[f"{view}_{name}{column}"], value)
                on_front = standing["front"].get(name)
                assert row[f"{view}_{name}_front"] == ("" if on_front is None else str(int(on_front)))
                crossed = standing["path_tracer"].get(name)
                same(row[f"{view}_{name}_path_tracer_ms"], crossed and crossed["ms"])
                assert row[f"{view}_{name}_path_tracer_relation"] == (crossed["relation"] if crossed else "")
    for row, point in zip(rows[len(settings) :], document["path_tracer"], strict=True):
        assert row["what"] == "path tracer" and row["spp"] == str(point["spp"])
        same(row["frame_ms"], point["time_ms"]["median"])
        same(row["frame_rmse"], point["metrics"]["rmse"]["value"])


def same(cell: str, value) -> None:
    """A cell holds a number of the JSON, in full precision; empty is null."""
    if value is None:
        assert cell == ""
    elif value == "NaN":
        assert math.isnan(float(cell))
    else:
        assert float(cell) == value


def test_a_grid_has_a_line_per_value_of_its_shortest_knob() -> None:
    settings = make_sweep().effects[0].settings
    assert {name: len(members) for name, members in groups(settings).items()} == {"filter hard": 2, "filter pcf3": 3}


def test_settings_that_are_as_good_as_far_as_is_known_are_told_with_the_best() -> None:
    shadow = make_sweep().effects[0]

    def sentence(*good: str) -> str:
        settings = [replace(s, effect=replace(s.effect, as_good=s.label in good)) for s in shadow.settings]
        return conclusions(replace(shadow, settings=tuple(settings)), "effect")[0]

    least, faster = "resolution 256, filter pcf3", "resolution 128, filter pcf3"
    assert "cannot be told" not in sentence(least)
    assert sentence(least, faster).endswith(f" 1 more cannot be told from it, the fastest of them {faster} in 1.50 ms.")


def test_the_front_s_settings_are_named_in_the_plot() -> None:
    sweep = make_sweep()
    shadow = sweep.effects[0]
    names = next(d for d in figure(shadow, sweep.path_tracer, "effect", "rmse")["data"] if d["name"] == "names")
    on_front = [s for s in shadow.settings if s.effect.front["rmse"]]
    assert len(on_front) == 3
    assert names["text"] == [s.label for s in on_front]
    assert names["x"] == [s.effect.time_ms.median for s in on_front]


def test_what_is_baked_has_a_column_where_there_is_anything() -> None:
    shadow, tone = make_sweep().effects
    alone = [render_sweep(replace(make_sweep(), effects=(effect,))) for effect in (shadow, tone)]
    assert "Baked once" not in alone[0]
    assert "Baked once" in alone[1] and '<td class="right">60.0</td>' in alone[1]


def test_what_the_current_setting_is_can_be_read() -> None:
    """Of a star; a grid names all values of each of its settings."""
    shadow, tone = make_sweep().effects
    assert "Current setting: scale 0.6." in remarks(tone)
    assert not any("Current" in sentence for sentence in remarks(shadow))
    assert "Current setting: scale 0.6." in render_sweep(make_sweep())


def test_a_line_is_drawn_through_numbers_and_not_through_choices() -> None:
    shadow = make_sweep().effects[0]

    def mode(settings, name: str) -> str:
        drawn = figure(replace(shadow, settings=tuple(settings)), (), "effect", "rmse")["data"]
        return next(d["mode"] for d in drawn if d["name"] == name)

    assert mode(shadow.settings, "filter hard") == "lines+markers"  # over the resolution
    current = replace(shadow.settings[1], varied=())
    assert mode([current, replace(shadow.settings[0], varied=("filter",))], "filter") == "markers"
    assert mode([current, replace(shadow.settings[3], varied=("resolution",))], "resolution") == "lines+markers"
    switched = [replace(current, knobs={"on": on}, varied=("on",) * on) for on in (False, True)]
    assert mode(switched, "on") == "markers"


def test_the_best_is_the_least_error_and_what_failed_is_not_drawn() -> None:
    sweep = make_sweep()
    shadow = sweep.effects[0]
    found = best(shadow, "effect", "rmse")
    assert found is not None and found.knobs == {"resolution": 256, "filter": "pcf3"}
    drawn = figure(shadow, sweep.path_tracer, "effect", "rmse")["data"]
    pcf3 = next(d for d in drawn if d["name"] == "filter pcf3")
    assert pcf3["x"] == [1.5, 3.0]  # not the 0.5 ms of the one that is NaN
    # An error of 0 has no place on a logarithmic axis: half the least above it, with a symbol of its own.
    assert pcf3["y"][1] == 0.1 / 2 and pcf3["marker"]["symbol"][1] == "triangle-down-open"
