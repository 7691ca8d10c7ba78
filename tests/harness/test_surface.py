"""The true surface in comparisons: what is exact with it, and that everything exact is still the reference."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from lightmeter.closure import closure_batches
from lightmeter.families import Families, composition, offset_layers
from lightmeter.game import Game
from lightmeter.metrics.registry import measure
from lightmeter.metrics.shapley import orders_for
from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.scenes.true_surface import true_surface
from lightmeter.sides import FramePoints, effect_sides
from lightmeter.squared_shares import squared_errors
from lightmeter.substitution import players
from lightmeter.truth import Truth
from lightmeter.variants import Variants

SIZE = (32, 32)
CONTROL = load("control")
FLAT = Choice(use=("flat_shading",), settings={"flat_shading": {"tessellation": 8}})


@cache
def truth_of(spp: int) -> Truth:
    """Of the true surface: all tests share its triangles."""
    return Truth(true_surface(CONTROL), SIZE, Budget(spp, least=8))


@pytest.fixture(scope="module", autouse=True)
def released():
    """No later test's kernels hold the materials and lights of these worlds."""
    yield
    truth_of.cache_clear()


def both_sides(choice: Choice, spp: int = 16) -> tuple[Renderer, Truth]:
    """The renderer and the truth of the control scene."""
    plan = compile_plan(CONTROL, effects(), choice)
    assert plan.true_scene is truth_of(spp).scene
    return Renderer(Device(), plan, SIZE), truth_of(spp)


def test_with_the_surface_exact_the_frame_is_that_of_the_true_surface():
    renderer, truth = both_sides(FLAT)
    frame = renderer.render().radiance
    families = Families(renderer, truth, frame, FramePoints.of(renderer, truth))
    true = Renderer(renderer.device, renderer.plan.with_true_surface(), SIZE).render().radiance
    exact = composition(families.layers(("flat_shading",)), ("flat_shading",))[0]
    # Rays and rasteriser do not agree on every pixel of the outline, which is 2·32 pixels long at most.
    off = np.abs(exact - true).max(axis=-1)
    assert (off > 1e-4 * true.max()).sum() <= 4
    assert np.abs(frame - true).max() > 0.1 * true.max()
    np.testing.assert_allclose(composition(families.layers(()), ())[0], frame, atol=1e-6 * true.max())


def test_a_surfaces_own_error_is_the_composition_on_it_against_that_on_the_true_one():
    """The light is a point and nothing shadows but the facets: both are closed forms, whichever effects shade."""
    renderer, truth = both_sides(Choice(use=(*FLAT.use, "lambert"), settings=FLAT.settings))
    sides = effect_sides(renderer, truth, lambda *_: None, only=("flat_shading",))["flat_shading"]
    on_true = Variants(renderer, truth).see(("flat_shading",), np.zeros((1, 2)), terms=False)
    assert np.array_equal(sides.truth[0], sides.truth[1])
    exact = on_true.truth.batch(on_true.points, 0, "frame", 1).composition()
    np.testing.assert_array_equal(sides.truth[0], exact)
    assert measure("rmse", sides.tested, sides.truth).value > 0.05 * exact.max()


def test_everything_exact_is_the_reference_of_the_true_surface():
    """At 8 steps the sphere's outline alone lacks a tenth of its area: without the true surface nothing closes."""
    renderer, truth = both_sides(FLAT, spp=256)
    closed = closure_batches(renderer, truth)
    bias = measure("relative_bias", closed, truth.reference.batches)
    assert bias.low <= 0 <= bias.high
    assert bias.high - bias.low < 0.01
    drawn = np.stack([images[0] for images in offset_layers(Variants(renderer, truth), ())])
    assert measure("relative_bias", drawn, truth.reference.batches).high < -0.03


def test_the_finest_tessellation_has_no_error():
    """But for float32: the rasteriser's positions and those that rays hit differ by some 10⁻⁶ of what they are."""
    finest = replace(FLAT, use=("interpolated_normals",), settings={"interpolated_normals": {"tessellation": 512}})
    renderer, truth = both_sides(finest)
    sides = effect_sides(renderer, truth, lambda *_: None, only=("interpolated_normals",))["interpolated_normals"]
    assert measure("nrmse", sides.tested, sides.truth).value < 1e-4


def test_the_surface_has_most_of_the_error_and_shares_add_up():
    renderer, truth = both_sides(FLAT)
    among, plan = players(renderer.plan), renderer.plan
    assert among["flat_shading"] == ("surface",) and "surface" not in plan.not_approximated
    families = Families(renderer, truth, renderer.render().radiance, FramePoints.of(renderer, truth))
    game = Game(tuple(among), orders_for(len(among)), families, np.stack(truth.reference.batches))
    errors = squared_errors(game)
    shares = {name: errors.share(i).value for i, name in enumerate(game.names)}
    assert sum(shares.values()) + errors.residual().value == pytest.approx(errors.total().value, rel=1e-9)
    assert shares["flat_shading"] > 0.5 * errors.total().value


def test_gouraud_is_judged_on_the_sum_of_its_terms():
    """On its surface, with the light that it interpolated, and the exact visibility: against everything exact."""
    renderer, truth = both_sides(Choice(use=("gouraud",), settings={"gouraud": {"tessellation": 8}}))
    at = FramePoints.of(renderer, truth)
    sides = effect_sides(renderer, truth, lambda *_: None, at, only=("gouraud",))["gouraud"]
    exact, drawn = at.batch((), 0, 1), at.captures[0].direct[0]
    arrives = np.where(exact.direct[0][0] > 0, exact.shadowed[0][0] / np.maximum(exact.direct[0][0], 1e-9), 1)
    np.testing.assert_allclose(sides.tested[0], drawn * arrives, atol=1e-5)
    assert measure("rmse", sides.tested, sides.truth).value > 0.05 * sides.truth[0].max()
