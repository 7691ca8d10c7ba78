"""Every metric over every kind of image: a defined answer, or an `InputError`, and never a warning of NumPy's."""

import math
import warnings

import numpy as np
import pytest

from lightmeter.metrics import METRICS, InputError, measure

SIZE = 12  # SSIM's window fits; FLIP's does not matter
NOISE = np.random.default_rng(0).uniform(0.1, 1, (SIZE, SIZE, 3)).astype(np.float32)
LARGEST = np.finfo(np.float32).max
SPIKE = NOISE.copy()
SPIKE[3, 5] = 1e30

KINDS = {
    "black": np.zeros_like(NOISE),
    "constant": np.full_like(NOISE, 0.5),
    "noise": NOISE,
    "negative": -NOISE,
    "huge": np.float32(1e30) * NOISE,
    "largest": np.full_like(NOISE, LARGEST),
    "hugely negative": np.full_like(NOISE, -LARGEST),
    "one huge pixel": SPIKE,
    "smallest normal": np.full_like(NOISE, np.finfo(np.float32).tiny),
    "denormal": (1e-40 * NOISE.astype(np.float64)).astype(np.float32),
}
NOT_FINITE = {"NaN": np.nan, "infinite": np.inf, "beyond float32": 1e200, "below float32": -1e39}

PAIRS = [
    *(("noise", kind) for kind in KINDS),
    *((kind, "noise") for kind in KINDS),
    *(("largest", kind) for kind in ("black", "hugely negative", "denormal", "smallest normal")),
    *((kind, "black") for kind in ("black", "denormal")),
]
RELATIVE = ("nrmse", "relmse", "relative_bias")
NOT_ABOVE_ZERO = ("black", "negative", "hugely negative")
FACTORS = np.float32([0.9, 0.95, 1.0, 0.97])  # of batches; none above 1, which the largest values would not survive


def exactly(name, tested, reference):
    """The measurement; a warning on the way is a failure."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        return measure(name, tested, reference)


@pytest.mark.parametrize("batches", [1, 4])
@pytest.mark.parametrize("name", METRICS)
def test_finite_images_have_a_defined_answer(name, batches):
    for tested_kind, kind in PAIRS:
        tested, image = KINDS[tested_kind], KINDS[kind]
        reference = image if batches == 1 else FACTORS[:, None, None, None] * image
        found = exactly(name, tested, reference)
        pair = f"{tested_kind} against {kind}: {found}"
        if name in RELATIVE and (kind == "black" or (name != "relmse" and kind in NOT_ABOVE_ZERO)):
            assert math.isnan(found.value), pair
            assert found.how == "undefined: the reference is black", pair
            continue
        if name == "psnr" and measure("mse", tested, reference).value <= 0:
            assert found.value == math.inf, pair
            continue
        assert math.isfinite(found.value), pair
        assert all(x is None or not math.isnan(x) for x in (found.low, found.high, found.floor)), pair
        if name.startswith("flip"):
            assert 0 <= found.value <= 1, pair
        if name == "ssim":
            assert -1 - 1e-6 <= found.value <= 1 + 1e-6, pair


@pytest.mark.parametrize("name", METRICS)
def test_an_image_against_itself_is_perfect_whatever_it_holds(name):
    for kind, image in KINDS.items():
        found = exactly(name, image, image).value
        if name in RELATIVE and found != 0:
            assert kind in NOT_ABOVE_ZERO, kind
        else:
            # SSIM is a quotient of equal float32 sums.
            assert found == pytest.approx({"psnr": math.inf, "ssim": 1}.get(name, 0), abs=1e-5), kind


@pytest.mark.parametrize("kind", NOT_FINITE)
@pytest.mark.parametrize("name", METRICS)
def test_what_float32_cannot_hold_is_not_finite(name, kind):
    broken = NOISE.astype(np.float64)
    broken[2, 3, 1] = NOT_FINITE[kind]
    found = exactly(name, broken, NOISE)
    assert math.isnan(found.value)
    assert "1 non-finite pixel" in found.how
    with pytest.raises(InputError, match=r"reference is not finite.*row 2, column 3"):
        exactly(name, NOISE, broken)


@pytest.mark.parametrize("size", [(1, 1), (1, 7), (10, 10), (3, 16)], ids=str)
@pytest.mark.parametrize("name", METRICS)
def test_images_smaller_than_a_filter(name, size):
    rng = np.random.default_rng(1)
    tested, batches = rng.random((*size, 3)), rng.random((4, *size, 3))
    for reference in (batches, batches[0]):
        if name == "ssim":
            with pytest.raises(InputError, match="smaller than SSIM's window"):
                exactly(name, tested, reference)
        else:
            assert math.isfinite(exactly(name, tested, reference).value)


def test_ssim_of_values_whose_fourth_powers_leave_float32():
    # SSIM does not change where images and data range are scaled alike; a = 1, b = 0 in units of 1e30.
    black, huge = KINDS["black"], KINDS["huge"]
    assert measure("ssim", huge, huge).value == pytest.approx(1, abs=1e-12)
    assert abs(measure("ssim", black, huge).value) < 1e-30
    scaled = measure("ssim", np.float32(1e30) * KINDS["constant"], huge, data_range=1e30).value
    assert scaled == pytest.approx(measure("ssim", KINDS["constant"], NOISE).value, rel=1e-4)


@pytest.mark.parametrize("name", METRICS)
def test_the_rule_for_odd_values_is_documented(name):
    text = METRICS[name].function.__doc__ or ""
    assert any(word in text.lower() for word in ("negative", "clamped", "else as `rms_p95`", "arguments as of `flip`"))
