"""The page of stiff scenes: its pictures, its words, and that it asks nobody for anything."""

import base64
import io
import json
import re
from collections.abc import Iterator

import numpy as np
import pytest

from lightmeter.reports.engine_strip import NOT_FINITE
from lightmeter.reports.heatmap import colour_map
from lightmeter.reports.stiff_page import SIDE, render_stiff, write_stiff
from lightmeter.reports.stiff_results import SAME, Finding, StiffPictures, StiffResults, doubt, state
from lightmeter.reports.stiff_table import stiff_table

from .chromium_pipe import Page, find_chromium, open_chromium

needs_chromium = pytest.mark.skipif(find_chromium() is None, reason="no chromium on this machine")

WELL = Finding("well", "nothing", (4, 4), 0.1, 0.09, 0.12, 0.01, commands=("lightmeter stress --scenes well",))
LARGE = Finding("large", "larger", (4, 4), 0.1, 0.09, 0.12, 0.3, like="well", scale=2.0, frame_changed=0.0)
OTHER = Finding(
    "<b>other</b>", "as <i>well</i>", (4, 4), like="well", scale=2.0, frame_changed=2 * SAME, truth_changed=0.0,
    blame=(("gtao", 0.02), ("cook_torrance", SAME / 2)), lengths=("gtao.radius = 0.5 m",), doubt="far", words="far",
)  # fmt: skip
BROKEN = Finding("broken", "NaN", (4, 4), words="frame: 1 non-finite pixel", finite=False, faults=1)
REFUSED = Finding("texel", "NaN texel", (4, 4), words="got 1 NaN", refused=True)
WIDE = Finding("wide", "a strip", (1000, 1), black=True, words="the reference is black")


def pictures() -> dict[str, StiffPictures]:
    grey = np.full((4, 4, 3), 0.5)
    error = np.zeros((4, 4))
    error[0] = 0.0, 1.0, 7.0, np.nan
    bad = grey.copy()
    bad[1, 2, 0] = np.nan
    square = {f.name: StiffPictures(grey, grey, error) for f in (WELL, LARGE, OTHER)}
    strip = np.full((1, 1000, 3), 0.25)
    return square | {BROKEN.name: StiffPictures(bad, grey, None), WIDE.name: StiffPictures(strip, strip, None)}


def results(*found: Finding) -> StiffResults:
    return StiffResults(1, 0, 8, 8, {"gl_renderer": "<i>"}, found or (WELL, LARGE, OTHER, BROKEN, REFUSED, WIDE))


def drawn(page: str) -> dict[str, np.ndarray]:
    """Every picture of the page, by its description."""
    from PIL import Image

    found = re.findall(r'<img src="data:image/png;base64,([^"]+)" alt="([^"]+)"', page)
    return {alt: np.asarray(Image.open(io.BytesIO(base64.b64decode(data)))) for data, alt in found}


def test_pictures_are_as_they_are_and_the_error_in_one_scale():
    images, magma = drawn(render_stiff(results(), pictures())), colour_map("magma")
    assert (images["well: real-time"] == 128).all()
    first, full, more, bad = images["well: error"][0]
    assert tuple(first) == tuple(magma.rgb[0])
    assert tuple(full) == tuple(more) == tuple(magma.rgb[-1])
    assert tuple(bad) == magma.nonfinite
    assert tuple(images["broken: real-time"][1, 2]) == NOT_FINITE
    assert images["wide: truth"].shape[1] <= SIDE
    assert "broken: error" not in images and "texel: truth" not in images


def test_what_each_side_said():
    assert [state(f) for f in (WELL, BROKEN, REFUSED)] == ["finite", "not finite", "refused"]
    assert [doubt(f) for f in (WELL, LARGE, OTHER, WIDE)] == ["", "not converged", "not trusted", "black"]
    page = render_stiff(results(OTHER, REFUSED), pictures())
    assert "<b>other" not in page and "&lt;b&gt;other" in page
    assert "gtao 2.00 %" in page and "cook_torrance" not in page
    assert "gtao.radius = 0.5 m" in page and "got 1 NaN" in page
    assert "scale-invariant</li>" not in page and "not as well</li>" in page
    assert "scale-invariant</li>" in render_stiff(results(LARGE), pictures())
    assert "10.0 (9.0 … 12.0) %" in render_stiff(results(WELL), pictures())


def test_the_table_says_the_same():
    from rich.console import Console

    out = Console(file=io.StringIO(), width=200)
    out.print(stiff_table([OTHER, BROKEN, REFUSED]))
    text = out.file.getvalue()
    assert "changed: gtao 2 %; in metres: gtao.radius = 0.5 m" in text
    assert "NO" in text and "refused" in text


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """A browser with the page open."""
    folder = tmp_path_factory.mktemp("stiff")
    target = write_stiff(folder, results(), pictures())
    assert [s["name"] for s in json.loads((folder / "stiff.json").read_text())["scenes"]][:2] == ["well", "large"]
    with open_chromium(tmp_path_factory.mktemp("profile")) as page:
        page.open(target)
        yield page


@needs_chromium
def test_it_opens_without_network(page: Page):
    shown = "[...document.images].map(i => i.complete && i.naturalWidth > 0 && i.getBoundingClientRect().height > 9)"
    assert page.evaluate(shown) == [True] * len(drawn(render_stiff(results(), pictures())))
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert page.evaluate("[...document.querySelectorAll('.index a')].every(a => document.querySelector(a.hash))")
    assert page.problems == []
    assert [url for url in page.requests if not url.startswith(("file:", "data:", "about:"))] == []
