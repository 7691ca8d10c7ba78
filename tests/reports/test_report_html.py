"""The report, opened in a browser."""

import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.embedded_data import pack_image, unpack_image
from lightmeter.reports.html import render_report, write_report
from lightmeter.reports.results import Attribution, Frame, ObjectError, PassTime, Player, Results

from .chromium_pipe import Page
from .report_page import SHOWN, click, needs_chromium, open_report
from .synthetic_pairs import make_pairs, make_results, narkowicz_curve


def place_of(page: Page, pane: str, x: float, y: float, size: int) -> tuple[float, float]:
    """Client position of the middle of pixel (x, y) of a fitted square picture."""
    box = page.evaluate(
        f"(b => [b.left, b.top, b.width, b.height])"
        f"(document.querySelector('[data-pane={pane}] canvas').getBoundingClientRect())"
    )
    scale = min(box[2], box[3]) / size
    left, top = box[0] + (box[2] - size * scale) / 2, box[1] + (box[3] - size * scale) / 2
    return left + (x + 0.5) * scale, top + (y + 0.5) * scale


def readout(page: Page, name: str) -> list[float]:
    texts = page.evaluate(f"[...document.querySelectorAll('[data-value={name}] span')].map(s => s.textContent)")
    return [float(text.replace("−", "-").replace("∞", "inf")) for text in texts]


def paint_settled(page: Page) -> None:
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def canvas_pixel(page: Page, pane: str, x: float, y: float) -> list[int]:
    """The colour drawn at client position (x, y)."""
    return page.evaluate(
        f"""(() => {{
            const canvas = document.querySelector('[data-pane={pane}] canvas'), box = canvas.getBoundingClientRect();
            const probe = new OffscreenCanvas(1, 1).getContext('2d', {{ willReadFrequently: true }});
            probe.drawImage(canvas, Math.floor({x} - box.left), Math.floor({y} - box.top), 1, 1, 0, 0, 1, 1);
            const data = probe.getImageData(0, 0, 1, 1).data;
            return [data[0], data[1], data[2]];
        }})()"""
    )


@needs_chromium
def test_viewer_shows_the_numbers_of_the_data(page: Page, tmp_path: Path) -> None:
    pairs = make_pairs(64)
    open_report(page, write_report(tmp_path, make_results(64), pairs, display_curve=narkowicz_curve()))
    for x, y in ((10, 20), (23, 25), (40, 50)):
        page.mouse("mouseMoved", *place_of(page, "truth", x, y, 64))
        page.until(f"document.querySelector('#place').textContent === 'x {x}, y {y}'")
        np.testing.assert_allclose(readout(page, "tested"), pairs[0].tested[y, x], rtol=2e-3)
        np.testing.assert_allclose(readout(page, "truth"), pairs[0].truth[y, x], rtol=2e-3)
        np.testing.assert_allclose(readout(page, "error"), pairs[0].errors[0].values[y, x], rtol=2e-3)
    # Off the cross, which leaves the pixel itself free: the colour is the frame's own curve.
    page.mouse("mouseMoved", *place_of(page, "truth", 50, 10, 64))
    paint_settled(page)
    for pane, image in (("tested", pairs[0].tested), ("truth", pairs[0].truth)):
        wanted = 255 * narkowicz_curve().apply(image[50, 20])
        got = canvas_pixel(page, pane, *place_of(page, pane, 20, 50, 64))
        np.testing.assert_allclose(got, wanted, atol=1.5)


@needs_chromium
def test_controls_change_the_picture(page: Page, tmp_path: Path) -> None:
    pairs = make_pairs(64)
    open_report(page, write_report(tmp_path, make_results(64), pairs))
    spot = place_of(page, "tested", 20, 50, 64)
    page.evaluate(
        "(e => {e.value = -2; e.dispatchEvent(new Event('input', {bubbles: true}))})"
        "(document.querySelector('#exposure'))"
    )
    paint_settled(page)
    linear = pairs[0].tested[50, 20] / 4
    wanted = 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    np.testing.assert_allclose(canvas_pixel(page, "tested", *spot), wanted, atol=1.5)
    assert page.evaluate("document.querySelector('#exposure-value').textContent") == "−2 stops"

    page.evaluate("document.querySelector('[role=radio][data-mode=flip]').click()")
    paint_settled(page)
    assert page.evaluate("document.querySelector('[data-pane=truth]').offsetParent === null")
    spot = place_of(page, "tested", 45, 52, 64)  # in the hard shadow, beside the soft one
    before = canvas_pixel(page, "tested", *spot)
    page.key("f")
    paint_settled(page)
    assert canvas_pixel(page, "tested", *spot) != before
    page.key("f", "keyUp")
    paint_settled(page)
    assert canvas_pixel(page, "tested", *spot) == before

    page.evaluate("document.querySelector('[role=radio][data-mode=wipe]').click()")
    paint_settled(page)
    assert canvas_pixel(page, "tested", *spot) != before  # right of the divider: truth


@needs_chromium
def test_zoom_keeps_the_point_under_the_pointer_in_every_pane(page: Page, tmp_path: Path) -> None:
    open_report(page, write_report(tmp_path, make_results(64), make_pairs(64)))
    spot = place_of(page, "tested", 40, 50, 64)
    for _ in range(5):
        page.mouse("mouseWheel", *spot, deltaX=0, deltaY=-120)
    page.mouse("mouseMoved", *spot)
    page.until("document.querySelector('#place').textContent === 'x 40, y 50'")
    other = place_of(page, "error", 40, 50, 64)
    page.mouse("mouseMoved", *other)
    paint_settled(page)
    assert page.evaluate("document.querySelector('#place').textContent") == "x 40, y 50"
    page.mouse("mousePressed", *other, button="left", clickCount=2)
    page.mouse("mouseReleased", *other, button="left", clickCount=2)
    page.until("document.querySelector('#zoom').textContent === '100 %'")


@needs_chromium
def test_a_row_opens_its_effect_and_the_keyboard_reads_pixels(page: Page, tmp_path: Path) -> None:
    pairs = {pair.name: pair for pair in make_pairs(64)}
    open_report(page, write_report(tmp_path, make_results(64), list(pairs.values())))
    page.evaluate("document.querySelector('tr[data-pair=shadow_map] button').click()")
    page.until(SHOWN.format("shadow_map"))
    assert page.evaluate("document.querySelector('#viewer-title').textContent") == "shadow_map"
    assert page.evaluate("document.querySelector('tr.chosen').dataset.pair") == "shadow_map"
    page.evaluate("document.querySelector('[data-pane=tested] canvas').focus()")
    page.key("ArrowRight")
    page.until("document.querySelector('#place').textContent.startsWith('x 33, y 32')")
    np.testing.assert_allclose(readout(page, "tested"), pairs["shadow_map"].tested[32, 33], rtol=2e-3)
    page.evaluate("document.querySelector('.card[data-pair=narkowicz]').click()")
    page.until(SHOWN.format("narkowicz"))
    assert page.evaluate("document.querySelector('#exposure').disabled")


PANELS = "[...document.querySelectorAll('.panel')].filter(p => p.checkVisibility()).map(p => p.dataset.metric)"


@needs_chromium
def test_the_error_is_shown_by_one_metric_or_the_other(page: Page, tmp_path: Path) -> None:
    open_report(page, write_report(tmp_path, make_results(32), make_pairs(32)))
    assert page.evaluate(PANELS) == ["mse"]
    click(page, "label[for=attribution-2]")
    page.until(f"{PANELS}.join() === 'flip'")
    page.evaluate("document.querySelector('#attribution-2').focus()")
    page.key("ArrowLeft")
    page.until(f"{PANELS}.join() === 'mse'")
    assert page.evaluate("document.querySelector('.panel .advice li').textContent").startswith(
        "Making shadow_map exact would remove 58.9 ± 3.1 %"
    )


@needs_chromium
def test_the_numbers_need_no_script(page: Page, tmp_path: Path) -> None:
    path = write_report(tmp_path, make_results(32), make_pairs(32))
    page.send("Emulation.setScriptExecutionDisabled", value=True)
    try:
        page.open(path)
        assert page.evaluate("document.querySelector('#caption').textContent") == ""
        assert page.evaluate(PANELS) == ["mse"]
        click(page, "label[for=attribution-2]")
        page.until(f"{PANELS}.join() === 'flip'")
    finally:
        page.send("Emulation.setScriptExecutionDisabled", value=False)


@needs_chromium
def test_a_share_opens_the_map_of_where_it_lies(page: Page, tmp_path: Path) -> None:
    pairs = {pair.name: pair for pair in make_pairs(64)}
    open_report(page, write_report(tmp_path, make_results(64), list(pairs.values())))
    shown = "document.querySelector('[data-pane=error] [data-label]').textContent"
    click(page, ".panel[data-metric=mse] tr[data-pair=shadow_map] button")
    page.until(SHOWN.format("shadow_map"))
    assert page.evaluate(shown) == "Share of the frame's squared error"
    assert page.evaluate("document.querySelector('#range-unit').textContent") == "(W/sr/m²)²"
    share = pairs["shadow_map"].errors[2]
    assert share.name == "share_mse"
    page.evaluate("document.querySelector('[data-pane=error] canvas').focus()")
    for _ in range(2):
        page.key("ArrowRight")
    page.until("document.querySelector('#place').textContent.startsWith('x 34, y 32')")
    np.testing.assert_allclose(readout(page, "error"), share.values[32, 34], rtol=2e-3)

    # The colour bar is symmetric, so that 0 is in its middle; pixels at 0 have the diverging map's middle colour.
    ends = page.evaluate("[...document.querySelectorAll('#ticks span')].map(s => [s.textContent, s.style.left])")
    positions = {text: float(left.rstrip("%")) for text, left in ends}
    assert positions["0"] == pytest.approx(50)
    assert all(text.startswith("−") == (left < 50) for text, left in positions.items() if text != "0")

    click(page, "label[for=attribution-2]")
    click(page, ".panel[data-metric=flip] tr[data-pair=constant_ambient] button")
    page.until(SHOWN.format("constant_ambient"))
    assert page.evaluate(shown) == "Share of the frame's FLIP"
    click(page, ".card[data-pair=frame]")  # which has no such map: its first one
    page.until(SHOWN.format("frame"))
    assert page.evaluate(shown) == "RMS error"


@needs_chromium
@pytest.mark.parametrize("width", [1400, 400])
def test_page_is_no_wider_than_the_window(page: Page, tmp_path: Path, width: int) -> None:
    size = {"height": 1000, "deviceScaleFactor": 1, "mobile": False}
    page.send("Emulation.setDeviceMetricsOverride", width=width, **size)
    try:
        open_report(page, write_report(tmp_path, make_results(32), make_pairs(32)))
        assert page.evaluate("document.documentElement.scrollWidth") == width
    finally:
        page.send("Emulation.setDeviceMetricsOverride", width=1500, **size)


@needs_chromium
def test_long_knobs_stay_on_their_lines_and_bars_have_room(page: Page, tmp_path: Path) -> None:
    """Beside many wide columns a cell of knobs would be a letter wide, and a bar beside a long name nothing."""
    knobs = {"resolution": 1024, "normal_offset": 0.5, "distribution": "schlick_remapped", "slope_bias": 1.25}
    results = make_results(32)
    effects = tuple(dataclasses.replace(effect, knobs=knobs) for effect in results.effects)
    names = "cascaded_shadow_map · south-western ceiling lamp · map", "shadow_map · light"
    passes = tuple(PassTime(name, "shadow_map", 3.0, 1.0) for name in names)
    results = dataclasses.replace(results, effects=effects, passes=passes)
    size = {"height": 1000, "deviceScaleFactor": 1, "mobile": False}
    page.send("Emulation.setDeviceMetricsOverride", width=1280, **size)
    try:
        open_report(page, write_report(tmp_path, results, make_pairs(32)))
        lines = page.evaluate(
            "[...document.querySelectorAll('.knobs code')]"
            ".map(code => code.offsetHeight / parseFloat(getComputedStyle(code).lineHeight))"
        )
        assert len(lines) == len(knobs) * len(effects)
        assert max(lines) < 1.5
        bars = page.evaluate("[...document.querySelectorAll('.passes svg')].map(bar => bar.clientWidth)")
        assert min(bars) > 60
    finally:
        page.send("Emulation.setDeviceMetricsOverride", width=1500, **size)


@needs_chromium
def test_pixels_that_are_not_finite_are_seen(page: Page, tmp_path: Path) -> None:
    open_report(page, write_report(tmp_path, make_results(64, True), make_pairs(64, True)))
    assert "2 pixels are not finite in the frame" in page.evaluate("document.querySelector('[role=alert]').textContent")
    assert page.evaluate("document.querySelector('[data-pane=tested] [data-bad]').textContent") == "✕ 2 not finite"
    assert page.evaluate("document.querySelectorAll('.tile.failed').length") == 3
    spot = place_of(page, "tested", 64 // 3, 16, 64)
    assert canvas_pixel(page, "tested", *spot) == [255, 0, 255]
    page.mouse("mouseMoved", *spot)
    page.until("document.querySelector('#place').textContent === 'x 21, y 16'")
    assert np.isnan(readout(page, "tested")).all()


@needs_chromium
def test_names_cannot_become_markup(page: Page, tmp_path: Path) -> None:
    evil = "</script><script>window.broken = 1</script><img src=x onerror='window.broken = 1'>"
    results = make_results(32, scene=evil)
    player = Player(evil, (evil,), True, *2 * [{"mse": Measurement(1.0, 0.9, 1.1, evil, evil)}])
    parts = Attribution({"mse": Measurement(1.0)}, {}, (player,), 2, True)
    objects = (ObjectError(evil, evil, 1, {"rmse": Measurement(1.0, unit=evil, how=evil)}, Measurement(1.0)),)
    results = dataclasses.replace(results, attribution=parts, objects=objects)
    pairs = make_pairs(32)
    object.__setattr__(pairs[0], "title", evil)
    object.__setattr__(pairs[0], "caption", evil)
    open_report(page, write_report(tmp_path, results, pairs))
    assert page.evaluate("window.broken") is None
    assert page.evaluate("document.querySelector('h1').textContent") == evil
    assert page.evaluate("document.querySelector('#viewer-title').textContent") == evil
    assert page.evaluate("document.querySelector('.shares tbody th').innerText").startswith(evil)
    assert page.evaluate("document.querySelector('.objects tbody th').textContent") == evil
    assert page.evaluate("document.querySelectorAll('img:not(.card img)').length") == 0


@needs_chromium
def test_an_old_browser_unpacks_by_itself(page: Page, tmp_path: Path) -> None:
    path = write_report(tmp_path, make_results(64), make_pairs(64))
    script = page.send("Page.addScriptToEvaluateOnNewDocument", source="delete window.DecompressionStream")
    try:
        pairs = make_pairs(64)
        open_report(page, path)
        assert page.evaluate("typeof DecompressionStream") == "undefined"
        page.mouse("mouseMoved", *place_of(page, "truth", 12, 34, 64))
        page.until("document.querySelector('#place').textContent === 'x 12, y 34'")
        np.testing.assert_allclose(readout(page, "truth"), pairs[0].truth[34, 12], rtol=2e-3)
    finally:
        page.send("Page.removeScriptToEvaluateOnNewDocument", identifier=script["identifier"])


@needs_chromium
def test_damaged_data_is_said_in_the_viewer(page: Page, tmp_path: Path) -> None:
    path = write_report(tmp_path, make_results(32), make_pairs(32)[:1])
    text = re.sub(r'(id="blob-0">)[^<]+', r"\1eJwDAAAAAAE=", path.read_text(encoding="utf-8"))
    path.write_text(text, encoding="utf-8")
    page.open(path)
    page.until("document.querySelector('#message.failed') !== null")
    assert "cannot be shown" in page.evaluate("document.querySelector('#message').textContent")


@needs_chromium
def test_a_bare_difference_has_no_empty_sections(page: Page, tmp_path: Path) -> None:
    """What `diff` writes: one pair, a few metrics."""
    pair = make_pairs(48)[0]
    results = Results(
        "a.exr against b.exr", (48, 48), Frame({"rmse": Measurement(0.1), "psnr": Measurement(31, unit="dB")})
    )
    open_report(page, write_report(tmp_path, results, [pair]))
    headings = page.evaluate("[...document.querySelectorAll('h2')].map(h => h.textContent)")
    assert headings == ["Whole frame", "All metrics"]
    assert page.evaluate("document.querySelectorAll('.card').length") == 0


@needs_chromium
def test_every_control_has_a_name(page: Page, tmp_path: Path) -> None:
    open_report(page, write_report(tmp_path, make_results(32), make_pairs(32)))
    tree = page.send("Accessibility.getFullAXTree")["nodes"]
    roles = {"button", "slider", "combobox", "spinbutton", "radio", "image", "img"}
    for node in tree:
        role = node.get("role", {}).get("value")
        if role in roles and not node.get("ignored"):
            assert node.get("name", {}).get("value"), node


def test_page_without_pictures_needs_no_viewer() -> None:
    page = render_report(make_results(8), [])
    assert 'id="viewer"' not in page
    assert "Effect by effect" in page


def test_page_asks_for_nothing_outside_itself() -> None:
    page = render_report(make_results(16), make_pairs(16))
    assert not re.search(r'(?:src|href)="(?!data:)', page)
    assert "http://" not in page
    assert "https://" not in page
    assert "default-src 'none'" in page


def test_two_pairs_of_one_name_are_refused() -> None:
    pair = make_pairs(8)[0]
    with pytest.raises(ValueError, match="different names"):
        render_report(make_results(8), [pair, pair])


def test_packed_picture_keeps_half_precision_at_any_scale() -> None:
    random = np.random.default_rng(3)
    for scale in (1e-9, 1.0, 1e7):
        image = (random.random((7, 5, 3)) * scale).astype(np.float32)
        np.testing.assert_allclose(unpack_image(pack_image(image)), image, rtol=2**-11, atol=scale * 1e-9)
    image[0, 0] = [np.nan, np.inf, -np.inf]
    np.testing.assert_array_equal(unpack_image(pack_image(image))[0, 0], image[0, 0])
