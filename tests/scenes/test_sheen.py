"""KHR_materials_sheen's definition, in float64: albedo against quadrature, what is left of the base, sampling."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.scenes.optics import material, sheen
from lightmeter.scenes.optics.material import MaterialPoint
from lightmeter.scenes.optics.sheen import Sheen

from .test_optics import UP, hemisphere, leaning, stack


def felt(color: float, roughness: float, base: float = 0.0) -> MaterialPoint:
    """A grey sheen over grey Lambert."""
    below = MaterialPoint(np.full((3, 1), base), np.zeros(1), np.full(1, 0.6), np.zeros(1))
    return replace(below, sheen=Sheen(np.full((3, 1), color), np.full(1, roughness), sheen.albedo_table().ravel()))


def albedo(point: MaterialPoint, cosine: float) -> float:
    """Reflected of light from everywhere, by quadrature."""
    light, solid = hemisphere(300, 200)
    return float(np.sum(material.evaluate(point, UP, leaning(cosine), light)[0] * solid))


@pytest.mark.parametrize("roughness", [0.25, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("cosine", [1.0, 0.7, 0.3, 0.1])
def test_the_table_is_the_albedo(roughness, cosine):
    """To 6e-4 of its quadrature, and what linear interpolation over 1/31 of the roughness and of √cos leaves."""
    found = sheen.albedo(felt(1, roughness).sheen, np.array([cosine]))[0]
    assert found == pytest.approx(albedo(felt(1, roughness), cosine), abs=3e-3)


@pytest.mark.parametrize("roughness", [0.3, 0.5, 1.0])
@pytest.mark.parametrize("cosine", [1.0, 0.5, 0.2, 0.05])
def test_a_white_sheen_over_white_makes_no_light(roughness, cosine):
    """Albedo scaling (Estevez & Kulla 2017): to the table's error."""
    assert albedo(felt(1, roughness, base=1.0), cosine) <= 1 + 5e-3


def test_a_smooth_white_sheen_makes_light_at_grazing_angles():
    """The fit of Λ is of roughnesses near 1: at 0.1 (α = 0.01) the lobe alone returns 1.6 at a cosine of 0.02."""
    assert albedo(felt(1, 0.1), 0.02) == pytest.approx(1.626, abs=0.01)


def test_without_color_it_is_the_base():
    light, _ = hemisphere(20, 20)
    point = felt(0, 0.5, base=0.6)
    bare = replace(point, sheen=None)
    for function in (material.evaluate, material.pdf):
        assert np.array_equal(function(point, UP, leaning(0.4), light), function(bare, UP, leaning(0.4), light))


def test_it_is_reciprocal():
    """Layering included: the base is left what the larger of both albedos leaves."""
    d = np.random.default_rng(2).normal(size=(2, 3, 300))
    a, b = (np.concatenate([v[:2], np.abs(v[2:])]) / np.linalg.norm(v, axis=0) for v in d)
    point = felt(0.8, 0.5, base=0.7)
    there, back = material.evaluate(point, UP, a, b) / b[2], material.evaluate(point, UP, b, a) / a[2]
    np.testing.assert_allclose(there, back, rtol=1e-10)


@pytest.mark.parametrize(("color", "roughness", "cosine"), [(0.9, 0.5, 1.0), (0.9, 0.3, 0.2), (0.3, 1.0, 0.6)])
def test_samples_follow_the_density(color, roughness, cosine):
    """∫pdf is the share above the horizon, and E[f/pdf] the albedo by quadrature, within five sigma."""
    rng = np.random.default_rng(6)
    count = 60_000
    u = rng.random((3, count))
    point, v = felt(color, roughness, base=0.5), leaning(cosine)
    drawn = material.sample(point, UP, v, (u[0], u[1], u[2]), stack)
    density = material.pdf(point, UP, v, drawn)
    kept = density > 0
    weight = np.where(kept, material.evaluate(point, UP, v, drawn)[0] / np.where(kept, density, 1), 0)
    assert abs(weight.mean() - albedo(point, cosine)) < 5 * weight.std() / np.sqrt(count) + 1e-4
    light, solid = hemisphere(300, 200)
    total = np.sum(material.pdf(point, UP, v, light) * solid)
    assert abs(total - kept.mean()) < 5 * 0.5 / np.sqrt(count) + 1e-3


def test_it_is_finite_everywhere():
    cosines = np.array([1.0, 1e-3, 1e-9, 0.0, -1e-9, -1.0])
    v = np.concatenate([leaning(c) for c in cosines], axis=1)
    for roughness in (0.0, 0.5, 1.0):
        for other in (v, -v, v * np.array([[-1], [1], [1]])):
            for function in (material.evaluate, material.pdf):
                value = function(felt(0.9, roughness, 0.5), UP, v, other)
                assert np.isfinite(value).all() and (value >= 0).all()
