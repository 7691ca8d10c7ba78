"""The tone curve's fit against the transform that it imitates."""

import numpy as np

from lightmeter.groundtruth.oracles import tone
from lightmeter.realtime.discovery import effect
from lightmeter.realtime.effects.narkowicz import twin

PUBLISHED = 0.0138
"""Narkowicz 2016: the fit's largest error on its own curve."""


def largest_error(prescale: float) -> float:
    """Over greys from 2⁻¹⁰ to 2⁵, display-linear."""
    grey = np.repeat(2.0 ** np.linspace(-10, 5, 2000)[:, None], 3, axis=1)
    exact = tone.evaluate(grey.astype(np.float32))
    return float(np.abs(twin.tone(grey, {"prescale": prescale}) - exact).max())


def test_the_fit_is_as_good_as_published_at_its_default_scale():
    default = effect("narkowicz").settings({})["prescale"]
    # The published figure has three digits.
    assert abs(largest_error(float(default)) - PUBLISHED) < 5e-5


def test_no_other_scale_that_a_sweep_visits_is_better():
    knob = effect("narkowicz").knobs[0]
    assert min(knob.sweep, key=largest_error) == knob.default
