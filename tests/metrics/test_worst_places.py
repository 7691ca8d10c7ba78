"""Percentiles and the worst tile: a small wrong place does not drown, and is found."""

import numpy as np
import pytest

from lightmeter.metrics import Comparison, measure
from lightmeter.metrics.flip import ldr_flip
from lightmeter.metrics.worst_tile import Tiles

RNG = np.random.default_rng


def with_highlight(size=64):
    """A right image but for 8 × 8 pixels that are 0.4 too bright: a sixty-fourth of 64 × 64."""
    truth = RNG(0).random((size, size, 3)) * 0.2 + 0.2
    tested = truth.copy()
    tested[36:44, 4:12] += 0.4
    return tested, truth


def test_a_small_highlight_does_not_drown():
    tested, truth = with_highlight()
    assert measure("rmse", tested, truth).value == pytest.approx(0.4 / 8)  # a sixty-fourth of 0.16
    assert measure("rms_p99", tested, truth).value == pytest.approx(0.4)  # 1.6 % of the pixels
    assert measure("rms_p95", tested, truth).value == 0
    worst = measure("rms_worst_tile", tested, truth)
    assert worst.value == pytest.approx(0.4 / 2)  # a quarter of its tile
    assert "rows 32 to 47, columns 0 to 15" in worst.how
    error = ldr_flip(tested, truth)
    assert measure("flip_p95", tested, truth).value == pytest.approx(np.percentile(error, 95))
    assert measure("flip_p99", tested, truth).value == pytest.approx(np.percentile(error, 99))
    seen = measure("flip_worst_tile", tested, truth)
    assert seen.value == pytest.approx(error[32:48, :16].mean(dtype=float))
    assert seen.value > 5 * measure("flip", tested, truth).value
    assert "rows 32 to 47, columns 0 to 15" in seen.how


def test_worst_tile_is_a_u_statistic():
    tested, batches = RNG(1).random((32, 32, 3)), RNG(2).random((8, 32, 32, 3))
    corner = np.zeros((32, 32), bool)
    corner[16:, :16] = True
    # Three tiles without error: all of the batches' images there are the tested one.
    batches[:, ~corner] = tested[~corner]
    assert measure("rms_worst_tile", tested, batches).value == pytest.approx(
        measure("rmse", tested, batches, corner).value, rel=1e-9
    )


def test_worst_tile_of_a_perfect_image_is_0_within_its_bound():
    truth = RNG(3).random((32, 32, 3))
    found = measure("rms_worst_tile", truth, truth + RNG(4).normal(size=(8, 32, 32, 3)))
    # The naive one of any tile is about the noise of the mean, 1/√8 = 0.35.
    assert found.value < 0.15
    assert found.low == 0


def test_masked_pixels_do_not_count():
    tested, truth = with_highlight()
    tested[50:, 50:] = np.nan
    mask = np.ones((64, 64), bool)
    mask[50:, 50:] = False
    assert measure("rms_worst_tile", tested, truth, mask).value == pytest.approx(0.4 / 2)
    mask[36:44, 4:12] = False
    for name in ("rms_worst_tile", "rms_p99"):
        assert measure(name, tested, truth, mask).value == 0


def test_slivers_of_a_mask_are_no_tile():
    mask = np.zeros((32, 32), bool)
    mask[:16, :16] = True
    mask[16:18, :16] = True  # an eighth of the tile below
    images = np.zeros((32, 32, 3))
    assert Tiles.of(Comparison(images, images, mask)).counts.tolist() == [[256, 0], [0, 0]]
    mask[:16] = False
    assert Tiles.of(Comparison(images, images, mask)).counts.tolist() == [[0, 0], [32, 0]]


def test_tiles_divide_the_image_evenly():
    images = np.zeros((50, 7, 3))
    tiles = Tiles.of(Comparison(images, images))
    assert tiles.rows.tolist() == [0, 16, 33]  # three of 16 or 17 rows rather than a sliver of two
    assert tiles.counts.tolist() == [[112], [119], [119]]
