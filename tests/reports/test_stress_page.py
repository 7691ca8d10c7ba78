"""A stress run's page in a browser: the grid, its formats, and the input that a cell opens."""

import pytest

from lightmeter.realtime.stress.both_sides import Extreme
from lightmeter.realtime.stress.findings import Cell, Example, Stressed
from lightmeter.realtime.stress.laws import Laws
from lightmeter.reports.stress_laws import rows, violations
from lightmeter.reports.stress_page import write_stress
from lightmeter.reports.stress_results import StressResults, command, inherent, shown
from lightmeter.reports.stress_table import fault_lines, safe_domain

from .chromium_pipe import Page
from .report_page import click, needs_chromium

INPUT = {"n": [0.0, 0.0, 1.0], "alpha": [1e-6]}
LOST = Example(INPUT, [1.5], [1.0], 0.5, 0.5, 0.3, attainable=6.0)
ILL = Example(INPUT, [1.5], [1.0], 0.5, 0.5, 0.3, attainable=0.4)
BROKEN = Example(INPUT, [float("nan")], [1.0], float("inf"), float("inf"), 0.0)


def results() -> StressResults:
    faulty = Cell(lanes=20, counts={"NaN": 3, "inf": 0, "negative": 0}, worst=LOST, faults={"NaN": BROKEN})
    cells = {
        "fp32": {"ordinary": Cell(9, worst=LOST), "grazing": Cell(7, worst=ILL), "zero vector": faulty},
        "fp16": {"ordinary": Cell(9, worst=ILL)},
    }
    function = Stressed("shared/<b>d_ggx</b></script>", "brdf.glsl", cells, {"α": 2e-3, "cosine": None}, {})
    return StressResults(1, 0, {"gl_renderer": "<i>"}, [function], {function.name: broken(), "shared/sound": sound()})


def sound() -> Laws:
    least = Extreme({"n_dot_v": [0.5], "n_dot_l": [0.25]}, 1e-12, 0.03, 0.031)
    return Laws({"model": least, "device": least}, None)


def broken() -> Laws:
    furthest = Extreme({"n": [0.0, 0.0, 1.0]}, 0.4, 0.4, 0.41)
    return Laws(
        {"model": furthest, "device": furthest},
        Extreme({"rho": [1.0, 1.0, 1.0], "n_dot_v": [0.1]}, 1.3, 1.3, 1.2, 1e-3),
    )


@pytest.fixture(scope="module")
def page(page: Page, tmp_path_factory: pytest.TempPathFactory) -> Page:
    """With the run open."""
    page.open(write_stress(tmp_path_factory.mktemp("stress"), results()))
    page.until("document.querySelectorAll('#grid button').length === 3")
    return page


@needs_chromium
def test_a_cell_opens_its_worst_input_and_the_command(page: Page) -> None:
    assert page.evaluate("[...document.querySelectorAll('#grid button')].map(b => b.textContent)") == ["0.3"] * 2 + [
        "NaN"
    ]
    click(page, "#grid td:nth-child(4) button")
    text = page.evaluate("document.querySelector('#chosen').textContent")
    assert page.evaluate("document.querySelector('#chosen').getBoundingClientRect().height") > 50
    assert "zero vector" in text and "NaN: 3" in text and "20 inputs" in text
    assert page.evaluate("document.querySelector('#chosen code').textContent").endswith("--input n=0,0,1 alpha=1e-06")
    click(page, "#grid td:nth-child(3) button")
    assert "inputs' own rounding" in page.evaluate("document.querySelector('#chosen').textContent")
    page.evaluate("document.querySelector('input[value=fp16]').click()")
    page.until("document.querySelectorAll('#grid button').length === 1")
    page.evaluate("document.querySelector('input[value=fp32]').click()")
    assert page.problems == []
    assert [url for url in page.requests if not url.startswith(("file:", "data:", "about:"))] == []


@needs_chromium
def test_laws_stand_beside_the_grid(page: Page) -> None:
    table = "document.querySelector('#laws table')"
    assert page.evaluate(f"[...{table}.querySelectorAll('tbody tr:first-child .broken')].map(c => c.textContent)") == [
        "0.400",
        "0.410",
        "1.30000",
        "1.20000",
    ]
    assert page.evaluate(f"{table}.querySelectorAll('.violation').length") == 2
    assert page.evaluate(f"{table}.querySelector('code').checkVisibility()") is False
    click(page, "#laws summary")
    assert page.evaluate(f"{table}.querySelector('code').checkVisibility()") is True
    assert page.evaluate(f"{table}.querySelector('code').textContent").endswith("--law reciprocity --input n=0,0,1")
    assert page.problems == []


def test_laws_in_words():
    of_sound, of_broken = rows({"a": sound()})[0], rows({"b": broken()})[0]
    assert of_sound == ["a", "0", "~0.031", "", "", "", ""]
    assert of_broken[-1] == "rho=1 n_dot_v=0.1" and of_broken[3:5] == ["1.30000", "1e-03"]
    assert violations("a", sound()) == []  # the inputs' own rounding
    one_sided, gains = violations("b", broken())
    assert "by its definition: off by 0.400" in one_sided.what and "albedo 1.3 ± 1e-03" in gains.what


def test_a_loss_is_the_inputs_own_where_no_more_is_attainable():
    cells = results().functions[0].cells["fp32"]
    assert [inherent(cells[r]) for r in ("ordinary", "grazing", "zero vector")] == [False, True, False]
    assert [shown(cells[r]) for r in ("ordinary", "grazing", "zero vector")] == ["0.3", "0.3", "NaN"]


def test_words():
    found = results()
    assert safe_domain(found.functions[0]).endswith("keeps 1 % down to α = 0.002, nowhere over all cosine")
    (line,) = fault_lines(found)
    assert "zero vector: NaN at 3 of 20 inputs" in line and line.endswith(command(found.functions[0].name, BROKEN))
