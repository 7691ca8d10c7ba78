"""What a shadow's mistakes become in words, in a row of the page, and in the browser."""

import dataclasses
from pathlib import Path

from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.shadow_error import KINDS, PLACES
from lightmeter.reports.html import write_report
from lightmeter.reports.shadow_content import MISTAKES, shadow_content, shadow_line

from .chromium_pipe import Page
from .report_page import needs_chromium, open_report
from .synthetic_pairs import make_pairs, make_results, make_shadows
from .test_attribution_words import printed


def test_every_mistake_has_words() -> None:
    assert [(m.kind, m.place) for m in MISTAKES] == [(kind, place) for kind in KINDS for place in PLACES]


def test_the_line_names_the_largest_first_and_leaves_out_the_least() -> None:
    sun, lamp = make_shadows()
    assert shadow_line(sun) == (
        "shadow of sun",
        "too dark in full light (acne?) 62 %, too dark at the edge 21 %, too light at a contact (peter-panning?) 17 %",
    )
    assert shadow_line(lamp) == ("shadow of lamp", "no error that can be told from noise")
    lines = printed(dataclasses.replace(make_results(), shadows=(sun, lamp)))
    assert any(line.startswith("shadow of sun: too dark in full light (acne?) 62 %,") for line in lines)
    evil = dataclasses.replace(sun, light="\x1b[31msun\n")
    assert shadow_line(evil)[0] == "shadow of �[31msun�"


def test_the_page_s_table() -> None:
    assert shadow_content(()) is None
    content = shadow_content(make_shadows())
    assert [group["columns"] for group in content["groups"]] == [4, 4]
    sun, lamp = content["rows"]
    values = [cell and cell["value"] for cell in sun["cells"]]
    assert values == [None, "17", "0.40", None, "21", None, None, "62"]
    assert sun["cells"][-1]["remarks"].startswith("60 to 64 %; 1,234 pixels are off by more than a tenth")
    assert "1 pixel is off" in sun["cells"][1]["remarks"]
    assert lamp["cells"] == [None] * 8
    tiny = dataclasses.replace(
        make_shadows()[0], parts={k: {p: dataclasses.replace(v, share=Measurement(1e-7)) for p, v in places.items()}
                                  for k, places in make_shadows()[0].parts.items()}
    )  # fmt: skip
    assert {cell["value"] for cell in shadow_content([tiny])["rows"][0]["cells"]} == {"0"}


@needs_chromium
def test_the_section_is_there_where_there_are_shadows(page: Page, tmp_path: Path) -> None:
    evil = "<b>sun</b>"
    shadows = (dataclasses.replace(make_shadows()[0], light=evil), make_shadows()[1])
    open_report(page, write_report(tmp_path, dataclasses.replace(make_results(32), shadows=shadows), make_pairs(32)))
    section = "document.querySelector('[aria-labelledby=shadows-title]')"
    assert page.evaluate(f"{section}.querySelector('tbody th').textContent") == evil
    assert page.evaluate(f"{section}.querySelectorAll('tbody tr').length") == 2
    assert "acne?" in page.evaluate(f"{section}.querySelector('thead').innerText")
    assert not page.problems
    open_report(page, write_report(tmp_path, make_results(32), make_pairs(32)))
    assert page.evaluate(f"{section} === null")
