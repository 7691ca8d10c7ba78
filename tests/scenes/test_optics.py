"""The shared optics against closed forms, quadrature and published numbers, in float64 NumPy."""

import numpy as np
import pytest

from lightmeter.scenes.optics import frames, lights, material, microfacet
from lightmeter.scenes.optics.material import MaterialPoint

from .. import white_metal

UP = np.array([[0.0], [0.0], [1.0]])


def stack(*components):
    """A vector of its components."""
    return np.stack(np.broadcast_arrays(*components))


def leaning(cosine):
    """A unit vector of that cosine with +Z, leaning towards +X."""
    return np.array([[np.sqrt(1 - cosine**2)], [0.0], [cosine]])


def midpoints(n: int) -> np.ndarray:
    """The middles of n cells of 0…1."""
    return (np.arange(n) + 0.5) / n


def hemisphere(n: int, m: int):
    """Directions (3, n·m) above +Z, and the solid angle each stands for: Gauss in the angle, even around."""
    nodes, weights = np.polynomial.legendre.leggauss(n)
    theta = (nodes + 1) * np.pi / 4
    theta_all, phi = (a.ravel() for a in np.meshgrid(theta, 2 * np.pi * midpoints(m), indexing="ij"))
    solid = np.repeat(weights * np.pi / 4 * np.sin(theta), m) * 2 * np.pi / m
    return stack(np.sin(theta_all) * np.cos(phi), np.sin(theta_all) * np.sin(phi), np.cos(theta_all)), solid


def metal(alpha: float) -> MaterialPoint:
    """A white conductor: F = 1 everywhere."""
    return MaterialPoint(np.ones((3, 1)), np.ones(1), np.full(1, np.sqrt(alpha)), np.ones(1))


def albedo(point: MaterialPoint, cosine: float, n: int = 1000) -> float:
    """Reflected over incident, by the material's own sampling on a regular grid of random numbers."""
    u1, u2 = (a.ravel() for a in np.meshgrid(midpoints(n), midpoints(n)))
    v = leaning(cosine)
    light = material.sample(point, UP, v, (np.full(u1.shape, 0.5), u1, u2), stack)
    density = material.pdf(point, UP, v, light)
    value = material.evaluate(point, UP, v, light)[0]
    return float(np.mean(np.where(density > 0, value / np.maximum(density, 1e-300), 0)))


@pytest.mark.parametrize(("alpha", "cosine", "expected"), white_metal.ALBEDOS)
def test_single_scattering_albedo_of_a_white_conductor(alpha, cosine, expected):
    assert albedo(metal(alpha), cosine) == pytest.approx(expected, abs=2e-4)


@pytest.mark.parametrize(("alpha", "loss"), white_metal.LOSSES)
def test_mean_energy_loss(alpha, loss):
    """1 − 2∫E(µ)µ dµ: what single scattering loses under light from everywhere."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    mu, weight = (nodes + 1) / 2, weights / 2
    mean = sum(2 * w * m * albedo(metal(alpha), m, 150) for m, w in zip(mu, weight, strict=True))
    assert 1 - mean == pytest.approx(loss, abs=1.5e-3)


@pytest.mark.parametrize("alpha", [0.05, 0.3, 1.0])
def test_the_distribution_of_normals_covers_the_surface(alpha):
    """∫D(h)(n·h) dh = 1."""
    h, solid = hemisphere(300, 1)
    d = microfacet.d_ggx(h[2], h[0] ** 2 + h[1] ** 2, alpha)
    assert np.sum(d * h[2] * solid) == pytest.approx(1, abs=1e-4)


def test_masking_at_normal_incidence_is_one():
    """V·4·n·v·n·l = G is 1 for light and view straight above, and height-correlated G2 exceeds G1·G1."""
    assert microfacet.v_smith_ggx_correlated(1.0, 1.0, 0.7) * 4 == pytest.approx(1)
    cosine, alpha = 0.3, 0.8
    g1 = 2 * cosine / (cosine + np.sqrt(alpha**2 + (1 - alpha**2) * cosine**2))
    g2 = microfacet.v_smith_ggx_correlated(cosine, cosine, alpha) * 4 * cosine * cosine
    lambda_ = (np.sqrt(1 + alpha**2 * (1 / cosine**2 - 1)) - 1) / 2
    assert g2 == pytest.approx(1 / (1 + 2 * lambda_))
    assert g1 == pytest.approx(1 / (1 + lambda_))
    assert g2 > g1 * g1


@pytest.mark.parametrize(("index", "largest", "angle"), [(1.5, 0.0357, 85.0), (1.333, 0.0592, None)])
def test_schlick_s_largest_error(index, largest, angle):
    theta = np.radians(np.linspace(0, 90, 9001))
    cos_i, cos_t = np.cos(theta), np.sqrt(1 - (np.sin(theta) / index) ** 2)
    parallel = ((index * cos_i - cos_t) / (index * cos_i + cos_t)) ** 2
    across = ((cos_i - index * cos_t) / (cos_i + index * cos_t)) ** 2
    f0 = ((index - 1) / (index + 1)) ** 2
    error = np.abs(microfacet.f_schlick(cos_i, f0, 1.0) - (parallel + across) / 2)
    assert error.max() == pytest.approx(largest, abs=1e-4)
    if angle:
        assert np.degrees(theta[error.argmax()]) == pytest.approx(angle, abs=0.6)


def some_materials():
    """Dielectrics and metals, smooth and rough."""
    for metallic, roughness, specular in ((0, 1, 1), (0, 0.4, 1), (0.5, 0.6, 0.7), (1, 0.5, 1), (1, 1, 1), (0, 0.3, 0)):
        color = np.array([[0.8], [0.5], [0.2]])
        yield MaterialPoint(
            color, np.full(1, metallic, float), np.full(1, roughness, float), np.full(1, specular, float)
        )


def test_the_material_is_reciprocal():
    rng = np.random.default_rng(1)
    a, b = rng.normal(size=(2, 3, 500))
    a, b = (np.concatenate([v[:2], np.abs(v[2:])]) / np.linalg.norm(v, axis=0) for v in (a, b))
    for point in some_materials():
        there = material.evaluate(point, UP, a, b) / b[2]
        back = material.evaluate(point, UP, b, a) / a[2]
        assert np.allclose(there, back, rtol=1e-10)


@pytest.mark.parametrize("cosine", [1.0, 0.6, 0.2])
def test_metals_and_lambert_lose_energy_and_a_white_dielectric_gains_a_little(cosine):
    """glTF's base is dimmed by Fresnel at v·h, not at the surface's own angles: white and smooth, it returns 1.007 at
    53° and 1.125 at 78°. That is the material's definition, which both renderers share.
    """
    light, solid = hemisphere(200, 200)
    for point in some_materials():
        white = MaterialPoint(np.ones((3, 1)), point.metallic, point.roughness, point.specular)
        total = np.sum(material.evaluate(white, UP, leaning(cosine), light) * solid, axis=1)
        dielectric = point.metallic[0] == 0 and point.specular[0] > 0
        assert (total <= (1.13 if dielectric else 1 + 1e-3)).all() and (total > 0.2).all()


def test_without_specular_a_dielectric_is_lambert_s():
    light, _ = hemisphere(20, 20)
    point = MaterialPoint(np.array([[0.8], [0.5], [0.2]]), np.zeros(1), np.full(1, 0.5), np.zeros(1))
    expected = np.array([[0.8], [0.5], [0.2]]) / np.pi * light[2]
    assert np.allclose(material.evaluate(point, UP, leaning(0.7), light), expected, rtol=1e-12)


@pytest.mark.parametrize("cosine", [1.0, 0.5, 0.15])
def test_the_density_integrates_to_what_stays_above_the_horizon(cosine):
    """∫pdf + the share of samples below the horizon = 1; and a histogram of samples follows the density (chi²)."""
    rng = np.random.default_rng(5)
    light, solid = hemisphere(300, 300)
    v = leaning(cosine)
    for point in some_materials():
        count = 100_000
        u = rng.random((3, count))
        drawn = material.sample(point, UP, v, (u[0], u[1], u[2]), stack)
        above = drawn[2] > 0
        density = np.broadcast_to(material.pdf(point, UP, v, light), solid.shape)
        total = np.sum(density * solid)
        assert total == pytest.approx(above.mean(), abs=4 * 0.5 / np.sqrt(count) + 1e-3)
        cells = 10, 12

        def cell(d, cells=cells):
            row = np.minimum((np.arccos(np.clip(d[2], -1, 1)) / (np.pi / 2) * cells[0]).astype(int), cells[0] - 1)
            column = ((np.arctan2(d[1], d[0]) / (2 * np.pi) % 1) * cells[1]).astype(int) % cells[1]
            return row * cells[1] + column

        expected = np.bincount(cell(light), density * solid, 120) * count
        found = np.bincount(cell(drawn[:, above]), minlength=120)
        sure = expected > 20
        # Quadrature of a cell is good to a few in a thousand; chi² per cell then stays near 1.
        spread = np.sqrt(expected + (0.01 * expected) ** 2)
        z = (found - expected)[sure] / spread[sure]
        assert np.mean(z**2) < 2 and np.abs(z).max() < 6


def test_evaluation_is_finite_everywhere():
    """Grazing and opposite directions, the smallest and largest α, and light straight from behind the viewer."""
    cosines = np.array([1.0, 1e-3, 1e-9, 0.0, -1e-9, -1.0])
    v = np.concatenate([leaning(c) for c in cosines], axis=1)
    for point in some_materials():
        for sign in (1, -1):
            for other in (v, -v, v * np.array([[-1], [1], [1]])):
                value = material.evaluate(point, UP, v, sign * other)
                assert np.isfinite(value).all() and (value >= 0).all()
                assert (value[:, v[2] <= 0] == 0).all()


def test_spot_falloff():
    """KHR_lights_punctual: 0.0901 at 35° in a cone of 20° to 40°, where a ramp linear in the angle has 0.25."""
    inner, outer = np.radians(20), np.radians(40)
    cosine = np.cos(np.radians([0, 20, 35, 40, 60]))
    ramp = (cosine[2] - np.cos(outer)) / (np.cos(inner) - np.cos(outer))
    assert lights.spot_attenuation(cosine, inner, outer) == pytest.approx([1, 1, ramp**2, 0, 0], abs=1e-12)
    assert ramp**2 == pytest.approx(0.09, abs=5e-3)


def test_light_from_a_position():
    position, point = np.array([[0.0], [3.0], [4.0]]), np.array([[0.0, 0.0], [0.0, 3.0], [0.0, 4.0]])
    direction, inverse_square = lights.from_position(position, point)
    assert np.allclose(direction.T, [[0, 0.6, 0.8], [0, 0, 0]])
    assert np.allclose(inverse_square, [1 / 25, 0])


def test_a_range_ends_the_light():
    """KHR_lights_punctual: 1 − (d/r)⁴ up to the range, 0 beyond; without end for a range that nothing reaches."""
    distance = np.array([1e-6, 1.0, 1.5, 2.0, 3.0, 1e6])
    window = lights.range_window(1 / distance**2, np.float64(4.0))
    np.testing.assert_allclose(window, [1, 1 - 1 / 16, 1 - 81 / 256, 0, 0, 0], atol=1e-12)
    np.testing.assert_allclose(lights.range_window(1 / distance[:5] ** 2, np.float64(1e18)), 1)


def test_irradiance_of_a_point_light_on_a_plane():
    """I·h/(h² + r²)^(3/2), Lambert's cosine law."""
    height, radius = 2.0, np.linspace(0, 5, 7)
    points = stack(radius, 0 * radius, 0 * radius)
    direction, inverse_square = lights.from_position(np.array([[0.0], [0.0], [height]]), points)
    assert np.allclose(direction[2] * inverse_square, height / (height**2 + radius**2) ** 1.5)


def test_bases_are_right_handed_and_orthonormal():
    rng = np.random.default_rng(2)
    n = rng.normal(size=(3, 1000))
    n = np.concatenate([n / np.linalg.norm(n, axis=0), UP, -UP], axis=1)
    s, t = frames.basis(n, stack)
    assert np.allclose(np.cross(s, t, axis=0), n)
    assert np.allclose([np.sum(s * n, axis=0), np.sum(t * n, axis=0), np.sum(s * t, axis=0)], 0, atol=1e-12)


def test_metalness_mixes_a_whole_dielectric_with_a_whole_metal():
    """glTF 2.0, Appendix B.2: f(m) = (1 − m)·f(0) + m·f(1), for every pair of directions."""
    rng = np.random.default_rng(4)
    n, v, light = (d / np.linalg.norm(d, axis=0) for d in rng.normal(size=(3, 3, 500)))
    base, metallic, roughness, specular = rng.random((3, 500)), rng.random(500), rng.random(500), rng.random(500)

    def value(m):
        return material.evaluate(material.MaterialPoint(base, m, roughness, specular), n, v, light)

    mixed = (1 - metallic) * value(np.zeros(500)) + metallic * value(np.ones(500))
    assert (mixed > 0).any()
    np.testing.assert_allclose(value(metallic), mixed, rtol=1e-12)
