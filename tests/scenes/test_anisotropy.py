"""KHR_materials_anisotropy's definition, in float64: the isotropic case, energy, reciprocity, sampling, the frame."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.scenes.optics import anisotropy, frames, material, microfacet
from lightmeter.scenes.optics.anisotropy import Grain
from lightmeter.scenes.optics.material import MaterialPoint

from .test_optics import UP, hemisphere, leaning, stack

GRAIN = np.array([[0.6], [0.8], [0.0]])


def brushed(strength: float, roughness: float = 0.4, grain=GRAIN) -> MaterialPoint:
    """A white metal with a grain."""
    bare = MaterialPoint(np.ones((3, 1)), np.ones(1), np.full(1, roughness), np.ones(1))
    return replace(bare, grain=Grain(np.full(1, strength), grain))


def directions(count: int) -> np.ndarray:
    """Random unit vectors above the surface."""
    d = np.random.default_rng(2).normal(size=(3, count))
    d[2] = np.abs(d[2])
    return d / np.linalg.norm(d, axis=0)


def test_without_strength_it_is_isotropic():
    v, light = directions(600)[:, :300], directions(600)[:, 300:]
    point = brushed(0.0)
    bare = replace(point, grain=None)
    for function in (material.evaluate, material.pdf):
        there, plain = function(point, UP, v, light), function(bare, UP, v, light)
        np.testing.assert_allclose(there, plain, rtol=1e-9)


def test_the_roughness_grows_along_the_grain_alone():
    """α_t = mix(α, 1, s²), α_b = α: at strength 0.5 and α = 0.16 the lobe along the grain is that of 0.37."""
    along, across = anisotropy.alphas(Grain(np.float64(0.5), GRAIN), 0.16)
    assert (along, across) == (pytest.approx(0.16 + 0.84 * 0.25), 0.16)
    for grain, alpha in ((UP * 0 + [[1.0], [0.0], [0.0]], along), ([[0.0], [1.0], [0.0]] + UP * 0, across)):
        tilt = leaning(0.9)
        found = anisotropy.d_ggx(np.sum(grain * tilt), 0 if alpha == along else tilt[0], tilt[2], along, across)
        n_dot_h, sin2 = tilt[2], 1 - tilt[2] ** 2
        # A section of the stretched lobe is GGX's of that α, times α over the other's.
        ratio = alpha / (across if alpha == along else along)
        np.testing.assert_allclose(found, microfacet.d_ggx(n_dot_h, sin2, alpha) * ratio, rtol=1e-12)


@pytest.mark.parametrize(("strength", "roughness"), [(0.3, 0.3), (1.0, 0.3), (0.7, 0.8), (1.0, 1.0)])
def test_the_distribution_is_of_microfacets_and_the_metal_makes_no_light(strength, roughness):
    """∫D·cos = 1, and the albedo of a white metal is at most 1; quadrature to 2e-3 for α ≥ 0.09."""
    light, solid = hemisphere(400, 400)
    point = brushed(strength, roughness)
    along, across = anisotropy.alphas(point.grain, point.alpha)
    b = np.cross(UP, GRAIN, axis=0)
    d = anisotropy.d_ggx(np.sum(GRAIN * light, axis=0), np.sum(b * light, axis=0), light[2], along, across)
    assert np.sum(d * light[2] * solid) == pytest.approx(1, abs=2e-3)
    for cosine in (1.0, 0.5, 0.2):
        total = np.sum(material.evaluate(point, UP, leaning(cosine), light)[0] * solid)
        assert 0.25 < total <= 1 + 2e-3


def test_it_is_reciprocal():
    a, b = directions(600)[:, :300], directions(600)[:, 300:]
    point = brushed(0.8)
    there, back = material.evaluate(point, UP, a, b) / b[2], material.evaluate(point, UP, b, a) / a[2]
    np.testing.assert_allclose(there, back, rtol=1e-10)


@pytest.mark.parametrize("cosine", [1.0, 0.5, 0.2])
@pytest.mark.parametrize(("strength", "roughness"), [(0.6, 0.4), (1.0, 0.6)])
def test_samples_follow_the_density(cosine, strength, roughness):
    """∫pdf is the share above the horizon, and cell by cell the histogram follows it (chi² per cell near 1)."""
    rng = np.random.default_rng(5)
    count, cells = 100_000, (10, 12)
    u = rng.random((3, count))
    point, v = brushed(strength, roughness), leaning(cosine)
    drawn = material.sample(point, UP, v, (u[0], u[1], u[2]), stack)
    light, solid = hemisphere(300, 300)
    density = material.pdf(point, UP, v, light) * solid
    above = drawn[2] > 0
    assert density.sum() == pytest.approx(above.mean(), abs=4 * 0.5 / np.sqrt(count) + 1e-3)

    def cell(d):
        row = np.minimum((np.arccos(np.clip(d[2], -1, 1)) / (np.pi / 2) * cells[0]).astype(int), cells[0] - 1)
        return row * cells[1] + ((np.arctan2(d[1], d[0]) / (2 * np.pi) % 1) * cells[1]).astype(int) % cells[1]

    expected = np.bincount(cell(light), density, 120) * count
    found = np.bincount(cell(drawn[:, above]), minlength=120)
    sure = expected > 20
    z = (found - expected)[sure] / np.sqrt(expected + (0.01 * expected) ** 2)[sure]
    assert np.mean(z**2) < 2 and np.abs(z).max() < 6


def test_the_grain_lies_across_the_normal_whatever_the_tangent():
    normal = np.array([[0.0], [0.6], [0.8]])
    tangent = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 0.6], [0.0, 0.0, 0.8]])  # beside it, none, along the normal
    found = frames.along_grain(tangent, 1.0, normal, normal, np.cos(0.3), np.sin(0.3), stack)
    np.testing.assert_allclose(np.sum(found * normal, axis=0), 0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(found, axis=0), 1, rtol=1e-12)
    # Turned towards the bitangent, n × t.
    np.testing.assert_allclose(found[:, 0], [np.cos(0.3), 0.8 * np.sin(0.3), -0.6 * np.sin(0.3)], atol=1e-12)


def test_it_is_finite_everywhere():
    cosines = np.array([1.0, 1e-3, 1e-9, 0.0, -1e-9, -1.0])
    v = np.concatenate([leaning(c) for c in cosines], axis=1)
    for roughness in (0.0, 0.5, 1.0):
        for other in (v, -v, v * np.array([[-1], [1], [1]])):
            for function in (material.evaluate, material.pdf):
                value = function(brushed(0.9, roughness), UP, v, other)
                assert np.isfinite(value).all() and (value >= 0).all()
