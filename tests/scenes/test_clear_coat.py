"""KHR_materials_clearcoat's definition, in float64: known numbers, energy, reciprocity, sampling."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.scenes.optics import clear_coat, material, microfacet
from lightmeter.scenes.optics.clear_coat import Coat
from lightmeter.scenes.optics.material import MaterialPoint

from .test_optics import UP, hemisphere, leaning, stack

TILTED = np.array([[0.3], [0.2], [1.0]]) / np.linalg.norm([0.3, 0.2, 1.0])


def painted(color: float = 0.0, *, specular: float = 0.0, factor: float = 1.0, roughness: float = 0.3, normal=UP):
    """A coat over a grey base."""
    base = MaterialPoint(np.full((3, 1), color), np.zeros(1), np.full(1, 0.6), np.full(1, specular))
    return replace(base, coat=Coat(np.full(1, factor), np.full(1, roughness), normal))


def albedo(point: MaterialPoint, cosine: float) -> np.ndarray:
    """(3,): reflected of light from everywhere, by quadrature."""
    light, solid = hemisphere(400, 200)
    return np.sum(material.evaluate(point, UP, leaning(cosine), light) * solid, axis=1)


def test_a_full_coat_over_black_reflects_four_hundredths_at_normal_incidence():
    """Less what single scattering at α = 0.09 loses: E(1) = 0.9907 (design, section 8)."""
    np.testing.assert_allclose(albedo(painted(), 1.0), 0.04 * 0.9907, rtol=1e-4)


@pytest.mark.parametrize("cosine", [1.0, 0.5, 0.15])
def test_a_coat_takes_from_its_base_what_it_reflects(cosine):
    """(1 − c·F)·base + c·F·E, with F by Schlick from 0.04 (KHR_materials_clearcoat)."""
    share = 0.7 * (0.04 + 0.96 * (1 - cosine) ** 5)
    coat = albedo(painted(), cosine) / (0.04 + 0.96 * (1 - cosine) ** 5)
    expected = (1 - share) * 0.6 + share * coat
    np.testing.assert_allclose(albedo(painted(0.6, factor=0.7), cosine), expected, rtol=1e-6)


def test_no_coat_and_a_coat_of_factor_0_are_the_base_to_the_bit():
    rng = np.random.default_rng(3)
    light = rng.normal(size=(3, 500))
    light /= np.linalg.norm(light, axis=0)
    point = painted(0.6, specular=1.0, factor=0.0)
    bare = replace(point, coat=None)
    v = leaning(0.6)
    assert np.array_equal(material.evaluate(point, UP, v, light), material.evaluate(bare, UP, v, light))
    assert np.array_equal(material.pdf(point, UP, v, light), material.pdf(bare, UP, v, light))


@pytest.mark.parametrize("cosine", [1.0, 0.6, 0.2, 0.05])
@pytest.mark.parametrize("normal", [UP, TILTED], ids=["up", "tilted"])
def test_a_white_base_under_a_coat_makes_no_light(cosine, normal):
    """What is mixed returns at most 1 each: white Lambert exactly, the coat's lobe less than it. Quadrature: 1e-3."""
    for factor in (0.3, 1.0):
        for roughness in (0.2, 0.6, 1.0):
            point = painted(1.0, factor=factor, roughness=roughness, normal=normal)
            assert (albedo(point, cosine) <= 1 + 1e-3).all()


def test_the_coat_s_lobe_is_reciprocal_and_the_layering_is_not():
    """The lobe is GGX. The share that the coat takes is of the view alone, by definition: swapped, another."""
    a, b = leaning(0.9), leaning(0.2) * np.array([[-1], [1], [1]])
    coat = painted().coat
    there, back = clear_coat.lobe(coat, a, b) / b[2], clear_coat.lobe(coat, b, a) / a[2]
    np.testing.assert_allclose(there, back, rtol=1e-12)
    point = painted(0.6)
    there, back = material.evaluate(point, UP, a, b) / b[2], material.evaluate(point, UP, b, a) / a[2]
    assert abs(there[0, 0] / back[0, 0] - 1) > 0.2


def test_the_coat_has_a_normal_of_its_own():
    """Its mirror direction is about its own normal, and it reflects where the base's normal faces away from light."""
    v = UP
    mirror = 2 * TILTED[2] * TILTED - UP
    coat = painted(roughness=0.2, normal=TILTED)
    assert material.evaluate(coat, UP, v, mirror)[0, 0] > 20 * material.evaluate(coat, UP, v, UP)[0, 0]
    low = np.array([[0.995], [0.0], [-0.1]]) / np.linalg.norm([0.995, 0.0, -0.1])
    assert material.evaluate(coat, UP, leaning(0.3), low)[0, 0] > 0
    assert material.evaluate(coat, UP, -leaning(0.3), low)[0, 0] == 0


@pytest.mark.parametrize("cosine", [1.0, 0.4])
@pytest.mark.parametrize("normal", [UP, TILTED], ids=["up", "tilted"])
@pytest.mark.parametrize(("color", "roughness"), [(0.05, 0.3), (0.8, 0.5)])
def test_samples_follow_the_density(cosine, normal, color, roughness):
    """∫pdf is the share of samples above either horizon; E[f/pdf] is the albedo by quadrature, within five sigma."""
    rng = np.random.default_rng(6)
    count = 60_000
    u = rng.random((3, count))
    point, v = painted(color, specular=1.0, roughness=roughness, normal=normal), leaning(cosine)
    drawn = material.sample(point, UP, v, (u[0], u[1], u[2]), stack)
    density = material.pdf(point, UP, v, drawn)
    kept = density > 0
    value = material.evaluate(point, UP, v, drawn)[0]
    assert not (value[~kept] > 0).any()
    weight = np.where(kept, value / np.where(kept, density, 1), 0)
    light, solid = hemisphere(300, 200)
    below = light * np.array([[1], [1], [-1]])  # a tilted coat's lobe hangs below the base's horizon
    both = np.concatenate([light, below], axis=1)
    solid = np.concatenate([solid, solid])
    expected = np.sum(material.evaluate(point, UP, v, both)[0] * solid)
    assert abs(weight.mean() - expected) < 5 * weight.std() / np.sqrt(count) + 1e-4
    total = np.sum(material.pdf(point, UP, v, both) * solid)
    assert abs(total - kept.mean()) < 5 * 0.5 / np.sqrt(count) + 1e-3


def test_it_is_finite_everywhere():
    cosines = np.array([1.0, 1e-3, 1e-9, 0.0, -1e-9, -1.0])
    v = np.concatenate([leaning(c) for c in cosines], axis=1)
    for normal in (UP, TILTED):
        for roughness in (0.0, 0.5, 1.0):
            point = painted(0.5, specular=1.0, roughness=roughness, normal=normal)
            for other in (v, -v, v * np.array([[-1], [1], [1]])):
                for value in (material.evaluate(point, UP, v, other), material.pdf(point, UP, v, other)):
                    assert np.isfinite(value).all() and (value >= 0).all()
                    assert (value[..., v[2] <= 0] == 0).all()


def test_schlick_s_share_is_1_at_grazing_incidence():
    coat = painted(factor=0.5).coat
    assert clear_coat.reflectance(coat, leaning(1e-9)) == pytest.approx(0.5, abs=1e-7)
    assert clear_coat.reflectance(coat, UP) == pytest.approx(0.5 * microfacet.f_schlick(1.0, 0.04, 1.0))
