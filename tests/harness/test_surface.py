"""The true surface in comparisons: what is exact with it, and that everything exact is still the reference."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.closure import closure_batches
from lightmeter.comparison import compare
from lightmeter.families import Families, composition, offset_layers
from lightmeter.metrics.registry import measure
from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.sides import FramePoints, effect_sides
from lightmeter.truth import Truth
from lightmeter.variants import Variants

SIZE = (32, 32)
FLAT = Choice(use=("flat_shading",), settings={"flat_shading": {"tessellation": 8}})


def both_sides(choice: Choice, name: str = "control", spp: int = 32, size: tuple[int, int] = SIZE):
    """The renderer and the truth of a scene."""
    plan = compile_plan(load(name), effects(), choice)
    return Renderer(Device(), plan, size), Truth(plan.true_scene, size, Budget(spp, least=8))


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


def test_the_report_has_the_surfaces_row_and_its_share():
    found = compare(load("control"), (16, 16), Budget(16), choice=FLAT).results
    effect = next(e for e in found.effects if e.effect == "flat_shading")
    assert effect.terms == ("surface",) and effect.metrics["rmse"].value > 0
    player = next(p for p in found.attribution.players if p.name == "flat_shading")
    shares = sum(p.share["mse"].value for p in found.attribution.players)
    total = found.attribution.total["mse"].value
    assert shares + found.attribution.residual["mse"].value == pytest.approx(total, rel=1e-9)
    assert player.share["mse"].value > 0.3 * total
    assert "surface" not in found.not_approximated


def test_gouraud_is_judged_on_the_sum_of_its_terms():
    """On its surface, with the light that it interpolated, and the exact visibility: against everything exact."""
    renderer, truth = both_sides(Choice(use=("gouraud",), settings={"gouraud": {"tessellation": 8}}), spp=8)
    at = FramePoints.of(renderer, truth)
    sides = effect_sides(renderer, truth, lambda *_: None, at, only=("gouraud",))["gouraud"]
    exact, drawn = at.batch((), 0, 1), at.captures[0].direct[0]
    arrives = np.where(exact.direct[0][0] > 0, exact.shadowed[0][0] / np.maximum(exact.direct[0][0], 1e-9), 1)
    np.testing.assert_allclose(sides.tested[0], drawn * arrives, atol=1e-5)
    assert measure("rmse", sides.tested, sides.truth).value > 0.05 * sides.truth[0].max()
