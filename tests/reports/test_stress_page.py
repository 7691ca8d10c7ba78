"""A stress run's page in a browser: the grid, its formats, and the input that a cell opens."""

import pytest

from lightmeter.realtime.stress.findings import Cell, Example, Stressed
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
    return StressResults(1, 0, {"gl_renderer": "<i>"}, [function])


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


def test_a_loss_is_the_inputs_own_where_no_more_is_attainable():
    cells = results().functions[0].cells["fp32"]
    assert [inherent(cells[r]) for r in ("ordinary", "grazing", "zero vector")] == [False, True, False]
    assert [shown(cells[r]) for r in ("ordinary", "grazing", "zero vector")] == ["0.3", "0.3", "NaN"]


def test_words():
    found = results()
    assert safe_domain(found.functions[0]).endswith("keeps 1 % down to α = 0.002, nowhere over all cosine")
    (line,) = fault_lines(found)
    assert "zero vector: NaN at 3 of 20 inputs" in line and line.endswith(command(found.functions[0].name, BROKEN))
