"""Oren-Nayar's forms against quadrature: what they return of the light, and both ways alike."""

from functools import partial

import numpy as np
import pytest

from lightmeter.scenes.optics import oren_nayar
from lightmeter.scenes.optics.oren_nayar import eon, fujii, fujii_albedo, fujii_albedo_fit, full, qualitative

from .test_optics import UP, hemisphere, leaning

FORMS = {"full": full, "qualitative": qualitative, "fujii": fujii, "eon": eon}
WHITE = np.ones((3, 1))
COSINES = (1.0, 0.7, 0.3, 0.1)


def albedo(form, spread: float, cosine: float, rho: float = 1.0) -> float:
    """Reflected of light from one direction; by reciprocity, of v."""
    light, solid = hemisphere(120, 121)
    value = form(rho * WHITE, np.full(1, spread), UP, leaning(cosine), light)
    return float(np.sum(value[0] * solid))


@pytest.mark.parametrize("form", FORMS.values(), ids=FORMS)
def test_without_spread_it_is_lambert_s_and_behind_the_surface_nothing(form):
    """EON guards a division by 1e-7, which leaves 1e-7/π."""
    light, _ = hemisphere(20, 21)
    rho = np.array([[0.8], [0.5], [0.2]])
    assert np.allclose(form(rho, np.zeros(1), UP, leaning(0.6), light), rho / np.pi * light[2], atol=1e-7)
    assert (form(rho, np.full(1, 0.5), UP, leaning(0.6), -light) == 0).all()
    assert (form(rho, np.full(1, 0.5), UP, -leaning(0.6), light) == 0).all()


@pytest.mark.parametrize("form", FORMS.values(), ids=FORMS)
def test_it_is_reciprocal(form):
    rng = np.random.default_rng(4)
    a, b = rng.normal(size=(2, 3, 500))
    a, b = (np.concatenate([v[:2], np.abs(v[2:])]) / np.linalg.norm(v, axis=0) for v in (a, b))
    rho, spread = np.full((3, 1), 0.7), np.full(1, 0.6)
    assert np.allclose(form(rho, spread, UP, a, b) / b[2], form(rho, spread, UP, b, a) / a[2], rtol=1e-10)


@pytest.mark.parametrize("spread", [0.2, 0.6, 1.0])
@pytest.mark.parametrize("cosine", COSINES)
def test_the_closed_form_of_fujii_s_albedo_is_its_integral(spread, cosine):
    """And the fit, whose authors state 1e-3."""
    assert albedo(fujii, spread, cosine) == pytest.approx(fujii_albedo(cosine, spread), abs=2e-4)
    assert fujii_albedo_fit(cosine, spread) == pytest.approx(fujii_albedo(cosine, spread), abs=1e-3)


@pytest.mark.parametrize("spread", [0.2, 0.6, 1.0])
@pytest.mark.parametrize("cosine", COSINES)
def test_eon_returns_a_white_furnace_whole(spread, cosine):
    """To the quadrature's 2e-4; with the fit of the albedo to the fit's own error."""
    assert albedo(eon, spread, cosine) == pytest.approx(1, abs=2e-4)
    assert albedo(partial(eon, albedo=fujii_albedo_fit), spread, cosine) == pytest.approx(1, abs=1.2e-3)
    assert albedo(eon, spread, cosine, rho=0.5) < 0.5


def test_the_forms_of_1994_lose_energy():
    """What a white surface of spread 1 returns of light from everywhere; Fujii's by its closed form."""
    nodes, weights = np.polynomial.legendre.leggauss(6)
    cosines, weight = (nodes + 1) / 2, weights / 2
    means = {
        name: 2 * sum(w * c * albedo(form, 1.0, c) for c, w in zip(cosines, weight, strict=True))
        for name, form in FORMS.items()
    }
    assert means["qualitative"] < means["fujii"] < means["eon"]
    assert means["eon"] == pytest.approx(1, abs=2e-4)
    mean = (1 + oren_nayar.MEAN_2) / (1 + oren_nayar.MEAN_1)
    assert means["fujii"] == pytest.approx(mean, abs=2e-4)
    assert means["full"] < 1


def test_light_from_the_viewer_is_brighter_at_the_limb_than_lambert_s():
    """The model's point (the flat full moon), for σ = 0.5 at 75°: v = l."""
    v = leaning(np.cos(np.radians(75)))
    lambert = 1 / np.pi * v[2]
    for form in (full, qualitative, fujii, eon):
        middle = form(WHITE, np.full(1, 0.5), UP, UP, UP)[0, 0] * np.pi
        limb = form(WHITE, np.full(1, 0.5), UP, v, v)[0] / lambert
        assert limb > 1.5 * middle
