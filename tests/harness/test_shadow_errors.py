"""The split of a shadow's error on a scene: acne where the bias is missing, the edge where it is not."""

import pytest

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import measure_all
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.shadow_errors import shadow_errors
from lightmeter.sides import FramePoints, effect_sides
from lightmeter.truth import Truth

SIZE = (64, 64)


@pytest.fixture(scope="module")
def truth():
    return Truth(load("layers"), SIZE, Budget(spp=8))


def split(truth, **choice):
    """The sun's shadow, its two largest mistakes, and the effect's own RMSE."""
    renderer = Renderer(Device(), compile_plan(truth.scene, effects(), Choice(**choice)), SIZE)
    at = FramePoints.of(renderer, truth)
    (shadow,) = shadow_errors(renderer, truth, at)
    sides = effect_sides(renderer, truth, silent, at, only=(shadow.effect,))[shadow.effect]
    whole = measure_all(["rmse"], Comparison(sides.tested, sides.truth))["rmse"]
    parts = {(k, p): part.share.value for k, places in shadow.parts.items() for p, part in places.items()}
    assert shadow.light == "sun" and sum(parts.values()) == pytest.approx(1)
    assert shadow.rmse.value == pytest.approx(whole.value, rel=1e-5)
    return shadow, parts


def test_as_it_comes_a_map_errs_at_the_edges(truth):
    shadow, parts = split(truth)
    assert shadow.effect == "shadow_map"
    assert parts["lit", "edge"] + parts["dark", "edge"] + parts["lit", "contact"] > 0.95


def test_without_a_bias_it_has_acne(truth):
    settings = {"shadow_map": {"filter": "hard", "bias": 0, "slope_bias": 0}}
    shadow, parts = split(truth, settings=settings)
    assert parts["dark", "away"] > 0.5
    assert shadow.parts["dark"]["away"].pixels > 500


def test_with_a_large_one_the_kerb_s_shadow_comes_loose(truth):
    """Two hundred texels of 8 mm towards the sun: more than the kerb is high."""
    _, before = split(truth)
    _, parts = split(truth, settings={"shadow_map": {"bias": 10}})
    assert parts["lit", "contact"] > 0.4 > before["lit", "contact"]


def test_an_exponential_leaks_into_the_shadow(truth):
    """With a small exponent the whole shadow is too light; at this size no part of it is far from an edge."""
    other, before = split(truth)
    settings = {"exponential_shadow_map": {"exponent": 10}}
    shadow, parts = split(truth, use=("exponential_shadow_map",), settings=settings)
    assert shadow.effect == "exponential_shadow_map"
    assert sum(share for (kind, _), share in parts.items() if kind == "lit") > 0.95
    assert parts["lit", "near"] * shadow.rmse.value**2 > 3 * before["lit", "near"] * other.rmse.value**2


def test_a_frame_of_several_samples_is_split_by_its_pixels(truth):
    _, parts = split(truth, settings={"supersampling": {"grid": 2}})
    assert parts["lit", "edge"] + parts["dark", "edge"] > 0.7
