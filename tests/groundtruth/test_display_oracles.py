"""The oracles of the display terms and of coverage, and how oracles are found."""

from typing import get_args

import numpy as np
import pytest

from lightmeter.groundtruth import oracles
from lightmeter.groundtruth.oracles import coverage, encode, tone
from lightmeter.scenes.model import View
from lightmeter.scenes.optics.color import srgb_decode, srgb_encode
from lightmeter.scenes.terms import TERMS


def test_every_oracle_is_a_term_and_names_itself():
    for name in oracles.names():
        module = oracles.find(name)
        assert name in TERMS
        assert name == module.TERM
        assert module.__doc__.startswith(f"`{name}`")
        assert callable(module.evaluate)
    with pytest.raises(LookupError, match="no oracle"):
        oracles.find("lens_flare")


@pytest.mark.parametrize("word", get_args(View))
def test_tone_is_the_aces_view_without_its_encoding(word):
    """Against the view itself with its sRGB code values, decoded by IEC 61966-2-1; the two inverses differ by 2e-7."""
    import PyOpenColorIO

    name, of_display = tone.VIEWS[word]
    config = PyOpenColorIO.Config.CreateFromBuiltinConfig(name)
    view = PyOpenColorIO.DisplayViewTransform(src=tone.SOURCE, display=tone.DISPLAY, view=of_display)
    image = np.random.default_rng(0).lognormal(-1, 2, (64, 64, 3)).astype(np.float32)
    codes = image.copy()
    config.getProcessor(view).getOptimizedCPUProcessor(PyOpenColorIO.OPTIMIZATION_LOSSLESS).applyRGB(codes)
    expected = np.clip(srgb_decode(codes.astype(float)), 0, 1)
    np.testing.assert_allclose(tone.evaluate(image, word), expected, atol=5e-6)
    assert np.abs(tone.evaluate(image, "aces-1") - tone.evaluate(image, "aces-2")).max() > 0.1


def test_tone_has_its_known_values_and_lets_no_wrong_pixel_pass():
    grey = tone.evaluate(np.array([[[0.18] * 3, [0.0] * 3, [1e4] * 3, [np.nan, 0, 0], [np.inf, 0, 0]]]))
    assert grey.shape == (1, 5, 3)
    np.testing.assert_allclose(grey[0, 0], 0.104, atol=5e-4)
    assert np.all(grey[0, 1] < 1e-6)
    assert np.all(grey[0, 2] == 1)
    assert np.isnan(grey[0, 3:]).all()
    with pytest.raises(ValueError, match="shape"):
        tone.evaluate(np.zeros((4, 4)))


def test_encode_is_the_optics_srgb():
    linear = np.linspace(-0.5, 1.5, 1001)
    np.testing.assert_allclose(encode.evaluate(linear), srgb_encode(np.clip(linear, 0, 1)), atol=1e-7)


@pytest.mark.parametrize("pattern", ["independent", "r2"])
def test_offsets_are_uniform_and_batches_independent_of_how_many_are_asked_for(pattern):
    offsets = coverage.evaluate(500, 16, seed=1, pattern=pattern)
    assert offsets.shape == (500, 16, 2)
    assert offsets.min() >= 0
    assert offsets.max() < 1
    np.testing.assert_array_equal(offsets[7:9], coverage.evaluate(2, 16, seed=1, first=7, pattern=pattern))
    # Uniform at each place of the sequence: mean ½, variance 1/12; five standard errors of 500 batches.
    assert np.abs(offsets.mean(axis=0) - 0.5).max() < 5 * np.sqrt(1 / 12 / 500)
    spread = offsets.mean(axis=1).std()
    assert spread < 0.05 if pattern == "r2" else spread == pytest.approx(np.sqrt(1 / 12 / 16), rel=0.15)
    with pytest.raises(ValueError, match="at least one"):
        coverage.evaluate(0, 1)
