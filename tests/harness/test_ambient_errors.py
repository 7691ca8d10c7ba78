"""Ambient visibility against its truths: the term, and the open directions that techniques aim at."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.ambient_errors import ambient_errors
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import measure_all
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.sides import FramePoints, effect_sides
from lightmeter.truth import Truth

SIZE = (48, 48)


@pytest.fixture(scope="module")
def truth():
    return Truth(load("corner"), SIZE, Budget(spp=64))


def judged(truth, choice):
    """The errors, and the effect's own."""
    renderer = Renderer(Device(), compile_plan(truth.scene, effects(), choice), SIZE)
    at = FramePoints.of(renderer, truth)
    sides = effect_sides(renderer, truth, silent, at)
    return ambient_errors(renderer, truth, at), sides


def test_a_short_radius_is_nearer_to_its_own_occlusion_than_to_the_term(truth):
    """GTAO within half a metre knows nothing of the walls that hide half the sky: its aim errs, not its means."""
    choice = Choice(use=("gtao",), settings={"gtao": {"radius": 0.5, "falloff": 0.0}})
    (term, near, everywhere), sides = judged(truth, choice)
    assert (term.truth, near.truth, everywhere.truth) == ("term", "occlusion", "occlusion")
    assert (term.radius, near.radius, everywhere.radius) == (None, 0.5, None)
    own = measure_all(["rmse"], Comparison(sides["gtao"].tested, sides["gtao"].truth))["rmse"]
    assert term.metrics["rmse"].value == pytest.approx(own.value, rel=1e-6)
    assert near.metrics["rmse"].high < 0.5 * everywhere.metrics["rmse"].low
    assert everywhere.metrics["relative_bias"].low > 0.2


def test_without_an_effect_there_is_nothing_to_hold(truth):
    errors, _ = judged(truth, Choice())
    assert errors == ()


def test_open_directions_of_a_lambert_surface_are_the_term(truth):
    """Without a mirrored part the ratio under an even sky is the open share; from other random numbers."""
    renderer = Renderer(Device(), compile_plan(truth.scene, effects()), SIZE)
    at = FramePoints.of(renderer, truth)
    matt = replace(at.points, specular=np.zeros_like(at.points.specular), metallic=np.zeros_like(at.points.metallic))
    batch = truth.batch(matt, 0, "frame", 256, keep=False, terms=("environment_visibility",))
    share = truth.ambient_occlusion(matt, np.inf, 0, 256)
    lit = batch.environment[..., 1] > 0
    ratio = batch.environment_shadowed[lit][:, 1] / batch.environment[lit][:, 1]
    # Each is a mean of 256 draws of 0 and 1: a spread of 1/32 at most, of the difference √2 of that, at each pixel.
    difference = ratio - share[lit]
    assert np.abs(difference.mean()) < 4 * np.sqrt(2) / 32 / np.sqrt(lit.sum())
    assert difference.std() < np.sqrt(2) / 32
