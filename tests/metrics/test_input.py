"""What cannot be compared, and names that do not exist."""

import subprocess
import sys

import numpy as np
import pytest

from lightmeter.metrics import METRICS, Comparison, InputError, find_metric, find_non_finite, measure, measure_all

IMAGE = np.random.default_rng(0).random((16, 18, 3)).astype(np.float32)
BATCHES = np.random.default_rng(1).random((4, 16, 18, 3)).astype(np.float32)


@pytest.mark.parametrize("name", METRICS)
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_non_finite_tested_image_fails_every_metric(name, value):
    broken = IMAGE.copy()
    broken[3, 5, 2] = value
    for reference in (BATCHES, BATCHES[0]):
        found = measure(name, broken, reference)
        assert np.isnan(found.value)
        assert (found.low, found.high) == (None, None)
        assert "1 non-finite pixel" in found.how
        assert "row 3, column 5" in found.how


@pytest.mark.parametrize("name", METRICS)
def test_non_finite_reference_is_an_error(name):
    broken = BATCHES.copy()
    broken[2, 7, 8, 0] = np.nan
    with pytest.raises(InputError, match=r"batch 2 of the reference is not finite.*row 7, column 8"):
        measure(name, IMAGE, broken)


@pytest.mark.parametrize("name", METRICS)
def test_metric_reads_the_mask_or_the_whole_image(name):
    broken = IMAGE.copy()
    broken[3, 5] = np.nan
    mask = np.ones((16, 18), bool)
    mask[3, 5] = False
    found = measure(name, broken, BATCHES, mask)
    # Filters of FLIP and SSIM read past the mask; the rest does not.
    assert np.isnan(found.value) == (name == "ssim" or name.startswith("flip"))


def test_non_finite_values_are_counted_and_located():
    image = np.zeros((5, 6, 3))
    image[1, 2, 0] = np.nan
    image[1, 2, 1] = np.inf
    image[4, 0] = -np.inf
    found = find_non_finite(image)
    assert (found.pixels, found.nan, found.positive, found.negative) == (2, 1, 1, 3)
    assert found.first == ((1, 2), (4, 0))
    assert str(found) == "2 non-finite pixels (1 NaN, 1 +inf, 3 -inf), first at row 1, column 2"
    assert find_non_finite(image, limit=1).first == ((1, 2),)
    mask = np.ones((5, 6), bool)
    mask[1, 2] = False
    assert find_non_finite(image, mask).pixels == 1
    assert not find_non_finite(np.zeros((3, 3)))
    assert find_non_finite(np.full((2, 2), np.nan)).pixels == 4


@pytest.mark.parametrize("name", METRICS)
def test_differing_sizes_are_named(name):
    with pytest.raises(InputError, match=r"differ in size: expected 18×16.*got 17×16") as caught:
        measure(name, IMAGE[:, 1:], BATCHES)
    assert isinstance(caught.value, ValueError)
    assert caught.value.expected.startswith("18×16")
    assert caught.value.remedy


@pytest.mark.parametrize(
    ("tested", "reference", "mask", "message"),
    [
        (IMAGE[..., :2], BATCHES, None, "the tested image is not colour images"),
        (IMAGE, BATCHES[..., 0], None, "the images differ|the reference is not colour images"),
        (IMAGE, [], None, "the reference is not colour images"),
        (IMAGE, BATCHES[:0], None, "the reference is not colour images"),
        (IMAGE, [BATCHES[0], BATCHES[1][1:]], None, "batches of the reference differ in size"),
        (np.stack([IMAGE] * 3), BATCHES, None, "differ in batches"),
        (IMAGE, BATCHES, np.ones((16, 18)), "mask does not fit"),
        (IMAGE, BATCHES, np.ones((18, 16), bool), "mask does not fit"),
        (IMAGE, BATCHES, np.zeros((16, 18), bool), "mask is empty"),
    ],
)
def test_shapes_are_checked(tested, reference, mask, message):
    with pytest.raises(InputError, match=message):
        Comparison(tested, reference, mask)


def test_list_of_batches_is_a_stack():
    for name in ("rmse", "mae", "flip"):
        assert measure(name, IMAGE, list(BATCHES)) == measure(name, IMAGE, BATCHES)


def test_unknown_names_say_the_nearest():
    with pytest.raises(InputError, match="Did you mean 'relmse'"):
        find_metric("rel_mse")
    with pytest.raises(InputError, match="Did you mean 'peak'"):
        measure("psnr", IMAGE, BATCHES, peek=1)
    with pytest.raises(InputError, match=r"unknown option of these metrics.*Did you mean 'bound'"):
        measure_all(["mae", "psnr"], Comparison(IMAGE, BATCHES), bounds=True)


def test_measure_all_is_each_by_itself():
    together = measure_all(METRICS, Comparison(IMAGE, BATCHES), bound=False, peak=3.0)
    assert list(together) == list(METRICS)
    for name, found in together.items():
        options = {k: v for k, v in {"bound": False, "peak": 3.0}.items() if k in METRICS[name].options}
        assert found == measure(name, IMAGE, BATCHES, **options)
        assert found.unit == METRICS[name].unit


def test_every_metric_is_described():
    for name, metric in METRICS.items():
        assert metric.name == name
        assert metric.summary.endswith(".")
        assert metric.citation
        assert metric.function.__doc__
    assert {n for n, m in METRICS.items() if not m.larger_is_worse} == {"psnr", "ssim"}
    assert {n for n, m in METRICS.items() if m.domain == "display"} == {
        *("flip", "flip_p95", "flip_p99", "flip_worst_tile", "ssim", "delta_e_2000")
    }


def test_import_is_light():
    code = (
        "import sys, lightmeter.metrics;"
        "print([m for m in ('colour', 'skimage', 'scipy.stats', 'mitsuba', 'moderngl') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.strip() == "[]"
