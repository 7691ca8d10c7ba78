"""Surfaces of few triangles: who draws which, what it leaves out, and how fast the error falls."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.effect import EffectError
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Camera
from lightmeter.scenes.points import SurfacePoints

SIZE = (96, 96)
FLAT, SMOOTH = "flat_shading", "interpolated_normals"


def asked(effect: str, steps: int) -> Choice:
    return Choice(use=(effect,), settings={effect: {"tessellation": steps}})


def torus():
    """A torus alone, seen from the front."""
    scene = load("torus")
    camera = Camera("camera", look_at((0.3, 3.0, 1.2), (0, 0.35, 0)), yfov=0.85)
    return replace(scene, shapes=scene.shapes[1:], camera=camera)


def test_no_surface_but_the_scenes_own_unless_one_is_asked_for():
    scene = load("torus")
    plan = compile_plan(scene, effects())
    assert plan.scene is scene and plan.true_scene is scene
    assert "surface" in plan.missing and "surface" not in plan.not_approximated
    assert not {FLAT, SMOOTH} & set(plan.effects)
    assert "--use flat_shading" in plan.why_absent(FLAT)


def test_one_of_two_surfaces_is_drawn_and_the_other_told():
    plan = compile_plan(load("torus"), effects(), Choice(use=(FLAT, SMOOTH)))
    assert plan.effects_of("surface") == (FLAT,) or plan.effects_of("surface") == (SMOOTH,)
    taken = plan.effects_of("surface")[0]
    assert taken in plan.why_absent(SMOOTH if taken == FLAT else FLAT)


def test_a_scene_without_forms_needs_none():
    plan = compile_plan(load("cornell-box"), effects(), asked(FLAT, 8))
    assert plan.scene is plan.true_scene and "surface" in plan.missing
    assert "more than its triangles" in plan.why_absent(FLAT)


def test_a_tessellation_out_of_range_says_what_is_in_it():
    with pytest.raises(EffectError, match=r"flat_shading.tessellation: expected a value within \[3, 512\], got 2"):
        compile_plan(load("torus"), effects(), asked(FLAT, 2))


def test_facets_have_one_normal_each_and_interpolated_ones_meet(device):
    scene = torus()
    for effect, most in ((FLAT, 1e-6), (SMOOTH, np.inf)):
        points = Renderer(device, compile_plan(scene, effects(), asked(effect, 12)), SIZE).capture(terms=False).points
        number = points.triangle[points.hit]
        spread = [np.ptp(points.normal[points.hit][number == one], axis=0).max() for one in np.unique(number)]
        assert max(spread) <= most
        assert len(spread) > 50
    assert max(spread) > 0.1


@pytest.fixture(scope="module")
def truth(device) -> SurfacePoints:
    plan = compile_plan(torus(), effects(), asked(SMOOTH, 8))
    return Renderer(device, plan.with_true_surface(), SIZE).capture(terms=False).points


def normal_error(device, truth: SurfacePoints, effect: str, steps: int) -> float:
    """The root mean square angle between the normals drawn and the true ones, where both are seen from the front.

    Near the outline the surface is seen so slantwise that its error has no order.
    """
    plan = compile_plan(torus(), effects(), asked(effect, steps))
    drawn = Renderer(device, plan, SIZE).capture(terms=False).points
    inside = drawn.hit & truth.hit & (np.sum(truth.normal * truth.view, axis=-1) > 0.5)
    difference = (drawn.normal - truth.normal)[inside].astype(np.float64)
    assert inside.sum() > 1000
    return float(np.sqrt(np.mean(np.sum(difference**2, axis=-1))))


@pytest.mark.parametrize(("effect", "order"), [(FLAT, 1), (SMOOTH, 2)])
def test_the_error_falls_with_the_tessellation_by_its_order(device, truth, effect, order):
    """Facets' normals are wrong by their angle, interpolated ones by its square.

    The next term is of relative size Δ² = (2π·2/32)², the tube has half as many steps: orders are right to about
    0.15/ln 4 of it, 0.11, between 32 and 128 steps.
    """
    coarse, fine = (normal_error(device, truth, effect, steps) for steps in (32, 128))
    assert np.log(coarse / fine) / np.log(4) == pytest.approx(order, abs=0.11)


def test_the_finest_tessellation_is_the_truth(device, truth):
    plan = compile_plan(torus(), effects(), asked(SMOOTH, 512))
    drawn = Renderer(device, plan, SIZE).capture(terms=False).points
    np.testing.assert_array_equal(drawn.normal, truth.normal)
