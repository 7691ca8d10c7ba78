"""What becomes of marched rays, in the results, in the terminal's line and on the page."""

import dataclasses
from pathlib import Path

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.html import write_report
from lightmeter.reports.ray_content import FATES, ray_content, ray_line
from lightmeter.reports.results import RayError, RayPart
from lightmeter.reports.results_json import from_json, to_json

from .synthetic_pairs import RADIANCE, between, make_pairs, make_results

NOTHING = RayPart(0, Measurement(0.0, how="no pixel"))
ERROR = RayError(
    "marcher",
    between(0.05, 0.001, RADIANCE),
    {
        "none": NOTHING,
        "wrong": NOTHING,
        "met": RayPart(1200, between(0.7, 0.02)),
        "left": RayPart(1, between(0.295, 0.02)),
        "hidden": RayPart(30, between(0.005, 0.01)),
        "open": NOTHING,
    },
)


def test_rays_come_back_as_they_were() -> None:
    results = dataclasses.replace(make_results(), rays=(ERROR,))
    assert from_json(to_json(results)).rays == (ERROR,)


def test_the_line_names_the_costliest_first_and_no_trifles() -> None:
    assert ray_line(ERROR) == ("rays of marcher", "other light 70 %, left the screen 30 %")
    calm = dataclasses.replace(ERROR, parts=dict.fromkeys(ERROR.parts, NOTHING))
    assert ray_line(calm)[1] == "no error that can be told from noise"


def test_a_row_has_a_cell_for_every_fate_that_a_pixel_had() -> None:
    content = ray_content((ERROR,))
    assert content is not None and ray_content(()) is None
    cells = dict(zip((fate.verdict for fate in FATES), content["rows"][0]["cells"], strict=True))
    assert cells["met"]["value"] == "70" and "1,200 pixels" in cells["met"]["remarks"]
    assert "1 pixel;" in cells["left"]["remarks"]
    assert cells["open"] is None and cells["none"] is None


def test_the_section_is_there_where_rays_are_marched(tmp_path: Path) -> None:
    evil = dataclasses.replace(ERROR, effect="<b>marcher")
    written = write_report(tmp_path, dataclasses.replace(make_results(32), rays=(evil,)), make_pairs(32))
    text = Path(written).read_text(encoding="utf-8")
    assert "What becomes of marched rays" in text and "<b>marcher" not in text
    without = write_report(tmp_path, make_results(32), make_pairs(32))
    assert "What becomes of marched rays" not in Path(without).read_text(encoding="utf-8")
