"""The plot of engines: axes, places of names, what is drawn how; and the small pictures."""

import base64
import dataclasses
import io
import math
import re

import numpy as np
import pytest
from PIL import Image

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.display_curve import srgb_curve
from lightmeter.reports.engine_plot import engine_mark, engine_plot
from lightmeter.reports.engine_strip import engine_strip, reduced
from lightmeter.reports.heatmap import MASKED, colour_map
from lightmeter.reports.label_places import Box, label_places
from lightmeter.reports.log_axis import LogAxis
from lightmeter.reports.pictures import Pair, flip_error
from lightmeter.reports.results import Candidate, Timing

from .synthetic_pairs import make_candidates


def test_axis_is_logarithmic_and_says_where_its_ticks_are() -> None:
    axis = LogAxis(-1.0, 1.0, 100.0, 300.0)
    assert [axis.position(value) for value in (0.1, 1.0, 10.0, 0.0, -5.0, 1e9)] == [100, 200, 300, 100, 100, 300]
    assert [text for _, text in axis.ticks()] == ["0.1", "0.2", "0.5", "1", "2", "5", "10"]
    for place, text in axis.ticks():
        assert place == axis.position(float(text))


@pytest.mark.parametrize("values", [[3.0], [], [1e-9, 1e-8], [1e-300, 1e300], [0.02, 0.9], [math.nan, -1.0, math.inf]])
def test_any_values_get_an_axis_with_ticks(values: list[float]) -> None:
    axis = LogAxis.spanning(values, 0.0, 100.0)
    assert axis.high - axis.low >= 1 - 1e-12
    assert all(0 < axis.position(value) < 100 for value in values if 0 < value < math.inf)
    ticks = axis.ticks()
    assert 2 <= len(ticks) <= 8
    assert all(0 <= place <= 100 for place, _ in ticks)


def test_ticks_far_from_1_are_powers_of_ten() -> None:
    assert [text for _, text in LogAxis(-7.0, -5.5, 0, 1).ticks()] == ["10⁻⁷", "2·10⁻⁷", "5·10⁻⁷", "10⁻⁶", "2·10⁻⁶"]


def test_names_keep_off_each_other_and_inside() -> None:
    room = Box(0, 0, 400, 200)
    points = [(390.0, 100.0), (385.0, 102.0), (5.0, 5.0), (200.0, 100.0)]
    line = Box(200, 99, 400, 101)
    boxes = [place.box for place in label_places(points, [80.0] * 4, room, [line])]
    assert all(box.shared(room) == box.area() for box in boxes)
    assert all(a.shared(b) == 0 for index, a in enumerate(boxes) for b in boxes[:index])
    assert all(box.shared(line) == 0 for box in boxes)


def timed(candidate: Candidate, name: str, ms: float, error: float) -> Candidate:
    return dataclasses.replace(
        candidate, name=name, source="file", time_ms=Timing(ms, 0.1, 9), metrics={"rmse": Measurement(error)}
    )


def test_plot_draws_the_front_through_what_nothing_beats() -> None:
    one = make_candidates()[1]
    engines = [
        timed(one, "a", 1, 0.4),
        timed(one, "b", 10, 0.1),
        timed(one, "beaten", 20, 0.2),
        timed(one, "c", 99, 0.1),
    ]
    plot = engine_plot(engines, "rmse")
    assert plot
    at = {engine["name"]: (engine["x"], engine["y"]) for engine in plot["engines"]}
    corners = [tuple(map(float, pair.split())) for pair in re.split("[ML]", plot["front"])[1:]]
    room = plot["room"]
    (ax, ay), (bx, by) = at["a"], at["b"]
    assert corners == [(ax, room.top), (ax, room.top), (ax, ay), (bx, ay), (bx, by), (room.right, by)]
    assert ax < bx < at["beaten"][0]
    assert by > at["beaten"][1] > ay  # y runs downwards


def test_what_has_no_time_or_no_error_is_named_and_not_drawn() -> None:
    first, second, third = make_candidates()
    lost = dataclasses.replace(first, name="no time", source="file", time_ms=None)
    broken = dataclasses.replace(first, name="NaN", source="file", metrics={"rmse": Measurement(math.nan)})
    plot = engine_plot([first, second, third, lost, broken], "rmse")
    assert plot
    assert [engine["name"] for engine in plot["engines"]] == ["lightmeter (ours)", "our <engine> & co", "slow"]
    assert plot["absent"] == ["no time", "NaN"]
    assert engine_plot([first, lost, broken], "rmse") is None  # one point says nothing


def test_an_error_below_the_noise_is_drawn_at_the_edge_and_said_to_be() -> None:
    one = make_candidates()[1]
    exact = dataclasses.replace(timed(one, "exact", 5, -1e-4), metrics={"rmse": Measurement(-1e-4, -3e-4, 1e-4)})
    plot = engine_plot([timed(one, "a", 1, 0.4), exact], "rmse")
    assert plot
    mark = plot["engines"][1]
    assert mark["name"] == "exact ↓"
    assert mark["y"] == plot["room"].bottom
    assert "no error beyond the reference's noise" in mark["tip"]
    assert plot["at_the_edge"]


def test_whiskers_are_the_intervals() -> None:
    first, second, third = make_candidates()
    plot = engine_plot([first, second, third], "rmse")
    assert plot
    low, high = plot["engines"][0]["whisker_y"]
    scale = (plot["engines"][1]["y"] - plot["engines"][0]["y"]) / math.log(0.081 / 0.036)  # units per factor of e
    assert low - high == pytest.approx(scale * math.log(1.03 / 0.97), abs=0.03)
    assert plot["engines"][2]["whisker_x"] is None  # a single run


def test_marks_differ_in_colour_or_shape_and_start_up_is_hollow() -> None:
    ours, _, slow = make_candidates()
    marks = [engine_mark(place, ours) for place in range(25)]
    assert len({(mark["colour"], mark["shape"]) for mark in marks}) == 25
    assert len({mark["shape"] for mark in marks[:5]}) == 5  # told apart without colour
    assert not marks[0]["hollow"]
    assert engine_mark(2, slow)["hollow"]


def pixels(uri: str) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(uri.partition(",")[2]))))


def test_small_pictures_have_one_scale_and_show_what_is_masked_or_broken() -> None:
    ours = make_candidates()[0]
    dim, bright = (np.full((4, 6, 3), level, np.float32) for level in (0.01, 0.5))
    bright[0, 0] = math.nan
    mask = np.ones((4, 6), bool)
    mask[3] = False
    flip = np.full((4, 6), 0.25, np.float32)
    pairs = [
        Pair("frame", "", (), dim, dim, (flip_error(flip),)),
        Pair("other", "", (), bright, dim, (flip_error(2 * flip),), mask=mask),
    ]
    strip = engine_strip([ours, timed(ours, "other", 1, 1), timed(ours, "without", 1, 1)], pairs, None)
    assert strip
    first, second = strip["engines"]
    expected = [np.round(255 * srgb_curve().apply(np.array(level))) for level in (0.01, 0.5)]
    np.testing.assert_array_equal(pixels(first["picture"])[:3], np.full((3, 6, 3), expected[0]))  # not brightened
    np.testing.assert_array_equal(pixels(strip["truth"]), np.full((4, 6, 3), expected[0]))
    shown = pixels(second["picture"])
    assert tuple(shown[0, 0]) == (255, 0, 255)
    np.testing.assert_array_equal(shown[1], np.full((6, 3), expected[1]))
    np.testing.assert_array_equal(shown[3], np.full((6, 3), MASKED[0]))
    magma = colour_map("magma").rgb
    np.testing.assert_array_equal(pixels(first["map"])[0, 0], magma[64])
    np.testing.assert_array_equal(pixels(second["map"])[0, 0], magma[128])
    for one in (first, second):  # all over the same pixels
        assert tuple(pixels(one["map"])[3, 0]) == tuple(pixels(one["picture"])[3, 0]) == MASKED
    assert strip["masked"]
    assert [engine["pair"] for engine in strip["engines"]] == ["frame", "other"]


def test_large_pictures_are_averaged_and_lose_no_bad_pixel() -> None:
    image = np.arange(35.0).reshape(5, 7, 1)
    mask = np.ones((5, 7), bool)
    mask[0, 1] = mask[4, 6] = False
    small = reduced(image, mask, side=4)
    assert small.shape == (3, 4, 1)
    assert small[0, 0, 0] == pytest.approx((0 + 7 + 8) / 3)
    assert small[1, 1, 0] == pytest.approx((16 + 17 + 23 + 24) / 4)
    assert small[2, 0, 0] == pytest.approx((28 + 29) / 2)
    assert small[2, 3, 0] == 0
    image[2, 2] = math.nan
    image[0, 1] = math.nan  # masked
    small = reduced(image, mask, side=4)
    assert np.isnan(small[1, 1, 0])
    assert np.isfinite(small[0, 0, 0])
