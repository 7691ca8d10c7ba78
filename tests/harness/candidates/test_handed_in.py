"""What is handed in comes out as the light it stands for."""

import numpy as np
import pytest
from PIL import Image

from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.handed import take
from lightmeter.candidates.obtaining import Files
from lightmeter.reports.image_files import write_exr
from lightmeter.scenes.optics.color import srgb_encode

RADIANCE = np.linspace(0.0, 0.9, 4 * 6 * 3).reshape(4, 6, 3).astype(np.float32)
STEP = 1 / 255
"""Of an 8-bit code."""


def shown(image: np.ndarray) -> np.ndarray:
    """A display transform with a shoulder, channel by channel."""
    return srgb_encode(np.clip(image / (1 + image), 0, 1))


def taken(path, exposure=0.0, **how):
    candidate = Candidate("x", "file", str(path), **how)
    return take(candidate, Files(path, path.with_suffix(".json")), (6, 4), exposure, shown)


def write_png(path, values):
    Image.fromarray(np.round(values * 255).astype(np.uint8)).save(path)
    return path


def test_a_scene_linear_image_is_taken_as_it_is(tmp_path):
    path = write_exr(tmp_path / "a.exr", RADIANCE)
    assert np.array_equal(taken(path).image, RADIANCE)
    assert taken(path).display is None


def test_stated_stops_are_taken_out(tmp_path):
    path = write_exr(tmp_path / "a.exr", RADIANCE * 4)
    assert np.array_equal(taken(path, exposure=2.0).image, RADIANCE * 4)  # the camera's own exposure is not in it
    (tmp_path / "a.json").write_text('{"exposure": 2}')
    assert np.array_equal(taken(path).image, RADIANCE)


def test_display_images_stand_for_light(tmp_path):
    # A code is off by half a step at most; the decoding curve's slope is at most 2.4 · 1.055^-1 < 2.3.
    close = {"rtol": 0, "atol": 2.3 * STEP / 2}
    srgb = taken(write_png(tmp_path / "s.png", srgb_encode(RADIANCE)), transfer="srgb")
    np.testing.assert_allclose(srgb.image, RADIANCE, **close)
    gamma = taken(write_png(tmp_path / "g.png", RADIANCE ** (1 / 2.2)), transfer="gamma22")
    np.testing.assert_allclose(gamma.image, RADIANCE, **close)
    # d(x/(1-x))/dx = (1 + radiance)², at most 1.9², on top.
    display = taken(write_png(tmp_path / "d.png", shown(RADIANCE)), transfer="display")
    np.testing.assert_allclose(display.image, RADIANCE, rtol=0, atol=1.9**2 * 2.3 * STEP / 2)
    for handed in (srgb, gamma, display):
        assert handed.display is not None
        assert "display metrics" in " ".join(handed.notes)


def test_the_scenes_exposure_is_in_a_display_image(tmp_path):
    path = write_png(tmp_path / "s.png", srgb_encode(RADIANCE / 2))
    handed = taken(path, exposure=-1.0, transfer="srgb")
    np.testing.assert_allclose(handed.display(RADIANCE), srgb_encode(RADIANCE / 2), atol=1e-6)


def test_a_png_must_say_how_it_was_made(tmp_path):
    with pytest.raises(CandidateError, match="--transfer"):
        taken(write_png(tmp_path / "s.png", RADIANCE))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"time_mss": 1}', "time_ms"),
        ("{", "no JSON"),
        ('{"time_ms": NaN}', "time_ms"),
        ('{"time_ms": -1}', "time_ms"),
        ('{"transfer": "rgb"}', "linear"),
        ("[]", "side file|table|object|dictionary"),
        ('{"unsupported": {"material": ["x"]}}', "materials"),
    ],
)
def test_a_side_file_that_makes_no_sense_is_refused(tmp_path, text, said):
    path = write_exr(tmp_path / "a.exr", RADIANCE)
    (tmp_path / "a.json").write_text(text)
    with pytest.raises(CandidateError, match=said):
        taken(path)


def test_the_engines_own_time_goes_before_the_clock(tmp_path):
    path = write_exr(tmp_path / "a.exr", RADIANCE)
    candidate, files = Candidate("x", "command", ""), Files(path, tmp_path / "a.json", 1.5)
    by_clock = take(candidate, files, (6, 4), 0.0, shown)
    assert (by_clock.time.median, by_clock.time_whole) == (1500.0, True)
    (tmp_path / "a.json").write_text('{"time_ms": {"median": 8, "mad": 0.5, "frames": 20}, "engine": "E"}')
    told = take(candidate, files, (6, 4), 0.0, shown)
    assert (told.time.median, told.time.mad, told.time.frames, told.time_whole) == (8, 0.5, 20, False)
    assert told.engine == "E"


def test_another_size_is_refused(tmp_path):
    path = write_exr(tmp_path / "a.exr", RADIANCE[:1, :1])
    with pytest.raises(CandidateError, match="expected 6×4 pixels, got 1×1"):
        taken(path)
