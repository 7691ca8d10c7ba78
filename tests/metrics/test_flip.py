"""FLIP against published values, against NVIDIA's own program, and where that has no answer."""

import importlib.util
import os
import subprocess
import sys

import numpy as np
import pytest

from lightmeter.metrics import Comparison, InputError, measure
from lightmeter.metrics.flip import PIXELS_PER_DEGREE, FlipAgainst, exposure_range, hdr_flip, ldr_flip


def solid(rgb, size=64):
    return np.broadcast_to(np.asarray(rgb, np.float32), (size, size, 3))


# NVIDIA's means are sums in float32: with n = 4096 equal terms the rounding of the running sum is up to n/2 · 2⁻²⁴ ≈
# 1.2e-4 of the value, seen as 4e-5. In exact arithmetic the first solid is 0.967380, against the published 0.967345.
@pytest.mark.parametrize(
    ("reference", "tested", "published"),
    [
        ((0, 0, 0), (1, 1, 1), 0.967345),
        ((0, 1, 0), (0, 0, 1), 1.0),
        ((1, 0, 0), (0, 1, 0), 0.986630),
        ((0.5, 0.5, 0.5), (0.6, 0.6, 0.6), 0.285048),
    ],
)
def test_published_solids(reference, tested, published):
    error = ldr_flip(solid(tested), solid(reference), 67)
    assert error.shape == (64, 64)
    assert error.mean(dtype=float) == pytest.approx(published, abs=1e-4)


def exact_solid(a, b):
    """The paper's formulas for two solids in float64: no filter changes a solid, and no feature is in it."""
    matrix = np.array(
        [
            [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
            [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
            [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
        ]
    )

    def lab(rgb):
        v = np.asarray(rgb, float)
        linear = np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)
        xyz = matrix @ linear / matrix.sum(axis=1)
        f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz * 841 / 108 + 4 / 29)
        lightness = 116 * f[1] - 16
        return lightness, 5 * lightness * (f[0] - f[1]), 2 * lightness * (f[1] - f[2])

    def distance(a, b):
        p, q = lab(a), lab(b)
        return (abs(p[0] - q[0]) + np.hypot(p[1] - q[1], p[2] - q[2])) ** 0.7

    largest = distance((0, 1, 0), (0, 0, 1))
    d, knee = distance(a, b), 0.4 * largest
    return 0.95 * d / knee if d < knee else 0.95 + 0.05 * (d - knee) / (largest - knee)


@pytest.mark.parametrize("seed", range(5))
def test_solids_in_exact_arithmetic(seed):
    # The feature filters leave about 1e-7 of a solid in float32, whose square root, 3e-4, is an exponent: it moves a
    # value c by 3e-4 · |c ln c| ≤ 1.1e-4.
    a, b = np.random.default_rng(seed).random((2, 3))
    assert ldr_flip(solid(a), solid(b)).mean(dtype=float) == pytest.approx(exact_solid(a, b), abs=1.1e-4)


def pictures():
    """(name, mode, reference, tested): random and structured, sizes that are no multiple of the tile."""
    rng = np.random.default_rng(5)
    y, x = np.mgrid[0:150, 0:203].astype(np.float32)
    checker = np.repeat((((x // 9 + y // 7) % 2) * 0.8 + 0.1)[..., None], 3, axis=2)
    ramp = np.stack([x / 203, y / 150, 0.5 + 0.5 * np.sin(x * y / 800)], axis=2)
    disc = np.where(((x - 100) ** 2 + (y - 70) ** 2 < 2000)[..., None], [0.9, 0.3, 0.1], [0.1, 0.2, 0.6])
    noise = rng.random((150, 203, 3))
    found = []
    for name, picture in (("checker", checker), ("ramp", ramp), ("disc", disc), ("noise", noise)):
        shifted = np.roll(picture, (1, 2), (0, 1))
        noisy = np.clip(picture + rng.normal(0, 0.08, picture.shape), 0, 1)
        for kind, tested in (("shifted", shifted), ("noisy", noisy)):
            found.append((f"{name}-{kind}", "LDR", picture, tested))
            found.append((f"{name}-{kind}", "HDR", 9 * picture**3 + 1e-3, 9 * tested**3))
    # A ratio of luminances that is a power of two: the number of exposures must not be one more.
    octaves = np.full((150, 203, 3), 0.25)
    octaves[:5] = 4.0
    found.append(("octaves", "HDR", octaves, octaves * 1.1))
    tiny = rng.random((5, 7, 3))
    found.append(("tiny", "LDR", tiny, tiny[::-1]))
    return [(n, m, r.astype(np.float32), t.astype(np.float32)) for n, m, r, t in found]


NVIDIA = """
import sys, numpy as np, flip_evaluator
images = np.load(sys.argv[1])
out = {}
for i in range(len(images.files) // 2):
    for mode in ("LDR", "HDR"):
        if f"{mode}{i}r" in images.files:
            pair = images[f"{mode}{i}r"], images[f"{mode}{i}t"]
            error, mean, p = flip_evaluator.evaluate(*pair, mode, applyMagma=False)
            out[f"{mode}{i}"] = np.squeeze(error)
            out[f"{mode}{i}m"] = np.array([mean, p["startExposure"], p["stopExposure"], p["numExposures"]])
np.savez(sys.argv[2], **out)
"""


@pytest.mark.skipif(importlib.util.find_spec("flip_evaluator") is None, reason="flip-evaluator is not installed")
def test_equals_nvidias_program(tmp_path):
    cases = pictures()
    stored = {}
    for i, (_, mode, reference, tested) in enumerate(cases):
        stored |= {f"{mode}{i}r": reference, f"{mode}{i}t": tested}
    np.savez(tmp_path / "in.npz", **stored)
    # A child process, because the program may exit; with every allocation from fresh pages, because it takes a maximum
    # with memory that it never cleared.
    subprocess.run(
        [sys.executable, "-c", NVIDIA, str(tmp_path / "in.npz"), str(tmp_path / "out.npz")],
        check=True,
        env=os.environ | {"MALLOC_MMAP_THRESHOLD_": "2048"},
        timeout=60,
    )
    theirs = np.load(tmp_path / "out.npz")
    for i, (name, mode, reference, tested) in enumerate(cases):
        mean, start, stop, count = theirs[f"{mode}{i}m"]
        if mode == "HDR":
            ours = hdr_flip(tested, reference)
            assert (ours.start, ours.stop) == pytest.approx((start, stop), abs=1e-5), name
            assert ours.count == count, name
            error = ours.error
        else:
            error = ldr_flip(tested, reference)
        assert error.mean(dtype=float) == pytest.approx(mean, abs=1e-4), (name, mode)
        assert error.mean(dtype=float) == pytest.approx(theirs[f"{mode}{i}"].mean(dtype=float), abs=2e-5), (name, mode)
        # A pixel: where colours are equal, 1e-7 of filter residue goes through a power of 0.7 and one of 0.5.
        np.testing.assert_allclose(error, theirs[f"{mode}{i}"], atol=2e-3, err_msg=f"{name} {mode}")


def test_strips_and_tiles_leave_no_seam():
    # The error of a shifted crop, away from the edges, is the crop of the error: whatever the tile it falls in.
    rng = np.random.default_rng(0)
    a, b = rng.random((2, 200, 210, 3), dtype=np.float32)
    whole = ldr_flip(a, b)
    part = ldr_flip(a[17:180, 23:190], b[17:180, 23:190])
    np.testing.assert_allclose(part[12:-12, 12:-12], whole[29:168, 35:178], atol=1e-5)


def test_equal_images_have_no_error():
    image = np.random.default_rng(0).random((30, 80, 3))
    assert ldr_flip(image, image).max() == 0
    assert hdr_flip(image * 50, image * 50).error.max() == 0


def test_black_hdr_reference_has_an_answer():
    black = np.zeros((40, 50, 3), np.float32)
    assert hdr_flip(black, black).error.max() == 0
    lit = black.copy()
    lit[10:20, 10:20] = 0.3
    found = hdr_flip(lit, black)
    # The range comes from the tested image: 0.3 is brought to 0.85, far above black.
    assert found.error[15, 15] > 0.7
    assert found.error[35, 45] < 0.01
    assert np.isfinite([found.start, found.stop]).all()
    assert measure("flip_hdr", lit, black).value == pytest.approx(found.error.mean(dtype=float))


def test_mostly_black_hdr_reference_uses_lit_median():
    reference = np.zeros((40, 50, 3), np.float32)
    reference[:4] = 0.5
    start, stop = exposure_range(reference, reference)
    assert start == stop
    assert np.isfinite(hdr_flip(reference * 0.5, reference).error).all()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_non_finite_pixels_are_not_averaged_away(value):
    image = np.full((100, 90, 3), 0.5, np.float32)
    broken = image.copy()
    broken[70, 20, 1] = value
    error = ldr_flip(broken, image)
    assert np.isnan(error[70, 20])
    assert error[5, 80] == 0
    assert np.isnan(hdr_flip(broken, image).error).all()
    for name in ("flip", "flip_hdr"):
        found = measure(name, broken, image)
        assert np.isnan(found.value)
        assert "row 70, column 20" in found.how


def test_values_outside_the_display_are_clamped():
    rng = np.random.default_rng(1)
    a, b = rng.random((2, 20, 20, 3)) * 3 - 1
    np.testing.assert_array_equal(ldr_flip(a, b), ldr_flip(np.clip(a, 0, 1), np.clip(b, 0, 1)))
    np.testing.assert_array_equal(hdr_flip(a, b).error, hdr_flip(np.maximum(a, 0), np.maximum(b, 0)).error)


def test_huge_radiance_is_finite():
    image = np.full((20, 20, 3), 1.0, np.float32)
    huge = image.copy()
    huge[3, 3] = 3e38
    assert np.isfinite(hdr_flip(huge, image).error).all()
    assert np.isfinite(hdr_flip(image, huge).error).all()


def test_bad_input_is_named():
    image = np.zeros((20, 30, 3))
    with pytest.raises(InputError, match=r"differ in size: expected 30×20.*got 10×20"):
        ldr_flip(image[:, :10], image)
    with pytest.raises(InputError, match=r"shape \(height, width, 3\)"):
        ldr_flip(image[..., 0], image)
    with pytest.raises(InputError, match="pixels_per_degree above 0"):
        ldr_flip(image, image, 0)
    with pytest.raises(InputError, match="start ≤ stop"):
        hdr_flip(image, image, start=1, stop=0)
    with pytest.raises(InputError, match="count of 2"):
        hdr_flip(image, image, count=1)


def test_viewing_condition_changes_the_filters():
    rng = np.random.default_rng(2)
    a, b = rng.random((2, 60, 60, 3))
    # Farther away the noise melts: more pixels a degree, less difference.
    means = [ldr_flip(a, b, ppd).mean() for ppd in (20, PIXELS_PER_DEGREE, 200)]
    assert means[0] > means[1] > means[2]


def test_noisy_reference_raises_flip_and_the_report_says_so():
    rng = np.random.default_rng(3)
    truth = rng.random((48, 48, 3)) * 0.5 + 0.25
    batches = truth + rng.normal(0, 0.1, (8, 48, 48, 3))
    found = measure("flip", truth, batches)
    assert 0 <= found.corrected < found.value < found.floor
    assert found.low == 0
    assert found.value < found.high < found.floor
    cheap = measure("flip", truth, batches, bound=False)
    assert (cheap.value, cheap.floor) == (found.value, found.floor)
    assert (cheap.low, cheap.high, cheap.corrected) == (None, None, None)


def test_mask_selects_pixels_of_the_map():
    rng = np.random.default_rng(6)
    a, b = rng.random((2, 30, 40, 3))
    mask = rng.random((30, 40)) < 0.3
    found = measure("flip", Comparison(a, b).tested_batches[0], b, mask)
    assert found.value == pytest.approx(ldr_flip(a, b)[mask].mean(dtype=float))


@pytest.mark.parametrize("size", [(1, 1), (65, 130), (200, 64)])
def test_many_images_against_one(size):
    """Filtering the reference once changes nothing, to the last bit."""
    rng = np.random.default_rng(4)
    reference, *images = rng.random((3, *size, 3)).astype(np.float32)
    images[1][0, 0, 0] = np.nan
    against = FlipAgainst(reference, 40)
    for image in images:
        np.testing.assert_array_equal(against(image), ldr_flip(image, reference, 40))
    with pytest.raises(InputError, match="differ in size"):
        against(np.zeros((3, 3, 3)))
