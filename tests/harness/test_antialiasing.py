"""How effects for coverage are judged: at their own samples with all else exact, by what they make of these."""

import numpy as np
import pytest

from lightmeter.display_shares import attribute_display
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.mse import rmse
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.sides import coverage_sides, effect_sides, filtered_sides
from lightmeter.truth import Truth

SIZE = 48, 48


@pytest.fixture(scope="module")
def truth() -> Truth:
    """The control's: its light is punctual, and its error is its outline's; only the reference has noise."""
    return Truth(load("control"), SIZE, Budget(256))


def sides(truth: Truth, *used: str, of: str, **settings):
    choice = Choice(use=used, without=("shadow_map",), settings=settings)
    renderer = Renderer(Device(), compile_plan(truth.scene, effects(), choice), SIZE)
    return renderer, effect_sides(renderer, truth, silent, only=(of,))[of]


def error(found) -> float:
    tested = found.tested[0] if len(found.tested) == 1 else found.tested
    return rmse(Comparison(tested, found.truth)).value


def test_samples_and_frames_come_nearer_to_the_box_filter(truth):
    """An outline's error falls from one sample to eight by more than half; of the frames the clamp cuts a little."""
    _, centre = sides(truth, of="supersampling")
    _, some = sides(truth, "msaa", of="msaa", msaa={"samples": 2})
    _, many = sides(truth, "msaa", of="msaa", msaa={"samples": 8})
    _, clamped = sides(truth, "taa", of="taa")
    assert error(many) < error(some) < error(centre)
    assert error(many) < 0.5 * error(centre)
    assert error(clamped) < 0.5 * error(centre)


def test_fxaa_is_judged_in_code_values_beside_the_centre_sample(truth):
    renderer, found = sides(truth, "fxaa", of="fxaa")
    bare, centre = sides(truth, of="supersampling")
    assert found.space == "display"
    plain = filtered_sides(bare.plan, "", centre)
    assert np.array_equal(found.truth[0], plain.truth[0])
    assert error(found) < 0.8 * error(plain)
    inside = np.abs(found.tested[0] - plain.tested[0]).max(axis=-1) > 0
    assert 0 < inside.mean() < 0.2  # the outline
    names = [player.name for player in attribute_display(renderer.plan, truth.reference.batches).players]
    assert names[-1] == "fxaa"


def test_a_sweep_judges_msaa_as_a_comparison_does(truth):
    renderer, found = sides(truth, "msaa", of="msaa")
    swept = coverage_sides(renderer, truth, silent)
    np.testing.assert_allclose(swept.tested[0], found.tested[0], rtol=1e-6, atol=1e-7)


def test_a_limit_on_what_is_not_linear_is_refused(run, tmp_path):
    """MSAA's error has an interval; TAA's and FXAA's are told at the mean of all batches."""
    limit = '[[limit]]\nscene = "plane"\nmetric = "rmse"\nmax = 1.0\nuse = ["{0}"]\nof = "{0}"\n'
    for name, code in (("msaa", 0), ("taa", 2), ("fxaa", 2)):
        (tmp_path / "lightmeter.toml").write_text('[defaults]\nsize = "16x16"\nspp = 16\n' + limit.format(name))
        found = run("gate")
        assert found.code == code, found
        if code:
            assert f"{name} does not filter linearly" in found.err
