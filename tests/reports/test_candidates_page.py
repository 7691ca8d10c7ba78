"""Engines side by side, opened in a browser."""

import dataclasses
import re
from pathlib import Path

import pytest

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.html import render_report, write_report
from lightmeter.reports.results import Attribution, FailedCandidate, Finding, LayerError, Player, Results

from .chromium_pipe import Page
from .report_page import SHOWN, click, needs_chromium, open_report
from .synthetic_pairs import make_candidate_pairs, make_candidates, make_failed, make_results


def side_by_side() -> Results:
    return dataclasses.replace(make_results(96), candidates=make_candidates(), failed_candidates=make_failed())


def texts(page: Page, selector: str) -> list[str]:
    return page.evaluate(
        f"[...document.querySelectorAll({selector!r})].map(e => e.innerText.replace(/\\s+/g, ' ').trim())"
    )


@needs_chromium
def test_engines_stand_side_by_side(page: Page, tmp_path: Path) -> None:
    open_report(page, write_report(tmp_path, side_by_side(), make_candidate_pairs(48)))
    ours, theirs, slow = texts(page, ".engines > .scroll table:not(.layers) tbody tr")
    assert ours.startswith("lightmeter ours 0.0810 ± 0.0024 W/sr/m²")
    assert "9.87 ± 0.21 wall time around a finished frame 0" in ours
    assert theirs.startswith("our <engine> & co Engine 3.1 · llvmpipe 0.0360 ± 0.0011 W/sr/m²")
    assert theirs.endswith("reported by the engine 80 unsupported material glass 16 background")
    assert slow.endswith("2400 measured around the command 0")  # one run has no spread
    assert "over 4,000 of 9,216 pixels" in texts(page, ".engines .lead")[0]

    assert texts(page, ".finding h3") == ["Registration of our <engine> & co"]
    assert texts(page, ".finding li") == [
        "shift: shifted by 0.50 pixels right and 0.00 down not corrected",
        "exposure: brighter by a factor of 1.50 corrected as asked",
    ]
    assert texts(page, ".finding code") == ["--register shift,exposure"]
    assert texts(page, ".engines .alert strong") == ["✕ broken gave no frame"]
    assert texts(page, ".engines .alert pre") == ["it ended with exit code 1; its last output: no display"]

    direct, visibility, rest, unexplained = texts(page, ".layers tbody tr")
    assert direct.startswith("direct direct 0.02100 ± 0.00063 W/sr/m²")
    assert "84.6 ± 7.7 %" in direct
    assert "visibility.0 visibility" in visibility
    assert "%" not in visibility  # no player is called that
    assert rest.startswith("rest no layer 15.4 ± 7.7 %")
    assert unexplained.startswith("unexplained 0.0 ±")
    assert texts(page, ".engines .reasons") == ["our <engine> & co No indirect light."]


@needs_chromium
def test_plot_names_every_engine_and_marks_what_holds_start_up(page: Page, tmp_path: Path) -> None:
    open_report(page, write_report(tmp_path, side_by_side(), make_candidate_pairs(48)))
    for metric in ("rmse", "flip"):
        plot = f".engine-plot[data-metric={metric}]"
        names = page.evaluate(f"[...document.querySelectorAll('{plot} .label')].map(e => e.textContent)")
        assert names == ["lightmeter (ours)", "our <engine> & co", "slow"]
        hollow = page.evaluate(f"[...document.querySelectorAll('{plot} .shape')].map(e => getComputedStyle(e).fill)")
        panel = page.evaluate("getComputedStyle(document.querySelector('section')).backgroundColor")
        assert [fill == panel for fill in hollow] == [False, False, True]
    assert "Hollow: measured around the command" in texts(page, ".engines")[0]
    page.evaluate("document.querySelector('.engine-plot .shape').focus()")
    page.key("Shift")  # from now on what has the focus is shown to have it
    page.evaluate("document.activeElement.blur(); document.querySelector('.engine-plot .shape').focus()")
    page.until("document.querySelector('#tip').textContent.startsWith('lightmeter; RMSE 0.0810 ± 0.0024 W/sr/m²')")


@needs_chromium
def test_a_picture_opens_its_pair_at_the_flip_map(page: Page, tmp_path: Path) -> None:
    open_report(page, write_report(tmp_path, side_by_side(), make_candidate_pairs(48)))
    shown = "document.querySelector('[data-pane=error] [data-label]').textContent"
    assert page.evaluate(shown) == "RMS error"
    assert texts(page, ".strip .who") == [
        "lightmeter ours FLIP 0.0900",
        "our <engine> & co FLIP 0.0500",
        "slow FLIP 0.0300",
    ]
    sizes = page.evaluate("[...document.querySelectorAll('.strip button img')].map(e => [e.naturalWidth, e.width])")
    assert len(sizes) == 6
    assert all(size == sizes[0] for size in sizes)
    assert sizes[0][0] == 48

    click(page, ".strip button:nth-of-type(3) img")
    page.until(SHOWN.format("slow"))
    assert page.evaluate(shown) == "FLIP"
    assert page.evaluate("document.querySelector('.strip [aria-pressed=true]').dataset.pair") == "slow"
    assert page.evaluate("document.querySelector('tr.chosen').dataset.pair") == "slow"
    click(page, ".engines tr.ours button")
    page.until(SHOWN.format("frame"))
    click(page, ".layers tr:nth-child(2) button")
    page.until(SHOWN.format("our <engine> & co visibility.0"))


@needs_chromium
@pytest.mark.parametrize("width", [1400, 400])
def test_other_peoples_words_neither_widen_the_page_nor_become_markup(page: Page, tmp_path: Path, width: int) -> None:
    evil = "</script></text></svg><script>window.broken = 1</script><img src=x onerror='window.broken = 1'>" + 200 * "x"
    first, theirs, slow = make_candidates()
    player = Player(evil, (evil,), True, {"mse": Measurement(1.0, 0.9, 1.1, evil, evil)}, {})
    hostile = dataclasses.replace(
        theirs,
        name=evil,
        time_how=evil,
        masked={f"{evil}{index}": 1 for index in range(6)},
        findings=(Finding(evil, evil), Finding("flip", evil, {evil: 1.0}, True)),
        layers=(LayerError(evil, evil, {"rmse": Measurement(1.0, unit="u", how=evil)}, 1),),
        attribution=Attribution({"mse": Measurement(1.0)}, {}, (player,), 2, True),
        engine=evil,
        device=evil,
        notes=(evil,),
    )
    results = dataclasses.replace(
        make_results(32), candidates=(first, hostile, slow), failed_candidates=(FailedCandidate(evil, evil),)
    )
    pairs = make_candidate_pairs(32)
    pairs[1] = dataclasses.replace(pairs[1], name=evil, title=evil)
    size = {"height": 1000, "deviceScaleFactor": 1, "mobile": False}
    page.send("Emulation.setDeviceMetricsOverride", width=width, **size)
    try:
        open_report(page, write_report(tmp_path, results, pairs))
        assert page.evaluate("document.documentElement.scrollWidth") == width
        for box in (".engines pre", *([".engines > .scroll"] if width > 1000 else [])):  # nothing to be scrolled to
            assert page.evaluate(f"(e => e.scrollWidth - e.clientWidth)(document.querySelector('{box}'))") == 0
        click(page, ".strip button:nth-of-type(2)")
        page.until("document.querySelector('#viewer-title').textContent.startsWith('</script>')")
        assert page.evaluate("document.documentElement.scrollWidth") == width
    finally:
        page.send("Emulation.setDeviceMetricsOverride", width=1500, **size)
    assert page.evaluate("window.broken") is None
    assert page.evaluate("document.querySelectorAll('img:not(.card img, .strip img)').length") == 0
    name = page.evaluate("document.querySelectorAll('.engines tbody bdi')[1].textContent")
    assert name.startswith("</script></text")
    assert "…" in name
    assert len(name) == 32
    assert page.evaluate("document.querySelectorAll('.engines tbody bdi')[1].dataset.tip") == evil
    labels = page.evaluate("[...document.querySelectorAll('.engine-plot .label')].map(e => e.textContent.length)")
    assert max(labels) <= 26


@needs_chromium
def test_every_engine_control_has_a_name(page: Page, tmp_path: Path) -> None:
    open_report(page, write_report(tmp_path, side_by_side(), make_candidate_pairs(32)))
    for node in page.send("Accessibility.getFullAXTree")["nodes"]:
        if node.get("role", {}).get("value") in {"button", "image", "img"} and not node.get("ignored"):
            assert node.get("name", {}).get("value"), node


def test_page_of_engines_asks_for_nothing_outside_itself() -> None:
    page = render_report(side_by_side(), make_candidate_pairs(16))
    assert not re.search(r'(?:src|href)="(?!data:)', page)
    assert "http://" not in page
    assert "https://" not in page


def test_without_engines_there_is_nothing_of_them() -> None:
    page = render_report(make_results(16), make_candidate_pairs(16))
    assert "Engines side by side" not in page
    assert ".engine-plot" not in page


def test_engines_without_pictures_are_a_table_alone() -> None:
    page = render_report(side_by_side(), [])
    assert "Engines side by side" in page
    assert "Pictures and FLIP maps" not in page
    assert 'class="link"' not in page[page.index('class="engines"') : page.index("Where the error comes from")]


def test_failures_are_told_where_no_engine_gave_a_frame() -> None:
    page = render_report(dataclasses.replace(make_results(16), failed_candidates=make_failed()), [])
    assert "gave no frame" in page
    assert "no display" in page
    assert "against the same truth" not in page
