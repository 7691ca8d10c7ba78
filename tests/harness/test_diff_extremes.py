"""`lightmeter diff` of images that no renderer should make: an answer or one message, no traceback, no warning."""

import warnings

import numpy as np
import pytest

from .small_images import exr, noise

NOISE = noise(13, 12)
LARGEST = np.finfo(np.float32).max
KINDS = {
    "black": np.zeros_like(NOISE),
    "constant": np.full_like(NOISE, 0.5),
    "negative": -NOISE,
    "huge": np.float32(1e30) * NOISE,
    "largest": np.full_like(NOISE, LARGEST),
    "hugely negative": np.full_like(NOISE, -LARGEST),
    "denormal": np.full_like(NOISE, 1e-40),
    "NaN": np.full_like(NOISE, np.nan),
    "infinite": np.full_like(NOISE, -np.inf),
}


@pytest.mark.parametrize("kind", KINDS)
def test_with_pictures_as_either_side(run, tmp_path, kind):
    exr(tmp_path / "odd.exr", KINDS[kind])
    exr(tmp_path / "noise.exr", NOISE)
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        tested = run("diff", "odd.exr", "noise.exr", "--exposure", "8", "-o", "out", "--json")
        reference = run("diff", "noise.exr", "odd.exr", "--json")
    values = {name: entry["value"] for name, entry in tested.json["frame"]["metrics"].items()}
    assert tested.code == 0
    assert (tmp_path / "out" / "report.html").exists()
    if not np.isfinite(KINDS[kind]).all():
        assert set(values.values()) == {"NaN"}
        assert tested.json["nonfinite"]["frame"] == 12 * 13
        assert (reference.code, reference.out) == (2, "")
        assert "a reference must be finite everywhere" in reference.err
        return
    assert all(isinstance(value, float | int) for value in values.values()), values
    undefined = {name for name, entry in reference.json["frame"]["metrics"].items() if entry["value"] == "NaN"}
    black = {"black": {"nrmse", "relmse", "relative_bias"}}
    below = {"negative": {"nrmse", "relative_bias"}, "hugely negative": {"nrmse", "relative_bias"}}
    assert undefined == (black | below).get(kind, set())


def test_of_one_pixel(run, refused, tmp_path):
    exr(tmp_path / "a.exr", NOISE[:1, :1])
    exr(tmp_path / "b.exr", NOISE[1:2, :1])
    found = run("diff", "a.exr", "b.exr", "-o", "out", "--json")
    assert found.code == 0
    assert found.json["left_out"] == [{"what": "ssim", "why": "its window is 11×11 pixels, and the images are smaller"}]
    assert "SSIM's window" in refused("diff", "a.exr", "b.exr", "--metric", "ssim")
