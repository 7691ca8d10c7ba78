"""Distributions, maskings, Fresnel's equations and metals against closed forms, quadrature and published numbers."""

import numpy as np
import pytest

from lightmeter.scenes.optics import conductors, fresnel, microfacet
from lightmeter.scenes.optics.albedo import directional_albedo, mean_albedo

from .. import white_metal

ANGLES = np.radians(np.linspace(0, 90, 9001))
MASKINGS = (
    microfacet.v_smith_ggx_correlated,
    microfacet.v_smith_ggx_separable,
    microfacet.v_schlick_half,
    microfacet.v_schlick_remapped,
    microfacet.v_smith_ggx_fast,
    microfacet.v_implicit,
)


@pytest.mark.parametrize(("index", "largest", "degrees"), [(1.5, 0.0357, 85.0), (1.333, 0.0592, 83.8)])
def test_schlick_s_largest_error_is_the_published_one(index, largest, degrees):
    f0 = ((index - 1) / (index + 1)) ** 2
    error = np.abs(microfacet.f_schlick(np.cos(ANGLES), f0, 1.0) - fresnel.f_dielectric(np.cos(ANGLES), index))
    assert error.max() == pytest.approx(largest, abs=5e-5)
    assert np.degrees(ANGLES[error.argmax()]) == pytest.approx(degrees, abs=0.1)


def reflectance(cosine, index):
    """Fresnel's equations as they are written, with complex numbers."""
    inside = np.sqrt(1 - (1 - cosine**2) / index**2 + 0j)
    senkrecht = (cosine - index * inside) / (cosine + index * inside)
    parallel = (index * cosine - inside) / (index * cosine + inside)
    return (np.abs(senkrecht) ** 2 + np.abs(parallel) ** 2) / 2


def test_fresnel_s_equations_are_those_with_complex_numbers():
    """Both in float64, where each loses a few digits of ε at most."""
    rng = np.random.default_rng(1)
    cosine = rng.random(10_000)
    n, k = np.exp(rng.uniform(-3, 3, (2, 10_000)))
    assert np.allclose(fresnel.f_conductor(cosine, n, k), reflectance(cosine, n + 1j * k), atol=1e-13)
    assert np.allclose(fresnel.f_dielectric(cosine, 1 + n), reflectance(cosine, 1 + n), atol=1e-13)
    assert np.allclose(fresnel.f_conductor(cosine, 1 + n, 0.0), fresnel.f_dielectric(cosine, 1 + n), atol=1e-13)


def test_without_an_interface_nothing_is_reflected():
    for cosine in (0.0, 1e-3, 1.0, 1.1, -0.1):
        assert fresnel.f_dielectric(cosine, 1.0) == fresnel.f_conductor(cosine, 1.0, 0.0) == 0


@pytest.mark.parametrize("tint", [0.0, 0.3, 1.0])
def test_indices_of_a_reflectance_give_it_back(tint):
    f0 = np.array([0.0, 0.02, 0.04, 0.5, 0.9, 0.999])
    n, k = fresnel.complex_index_of(f0, tint)
    assert np.allclose(fresnel.f_conductor(1.0, n, k), f0, atol=1e-12)
    assert np.allclose(fresnel.f_dielectric(1.0, fresnel.index_of(f0)), f0, atol=1e-12)
    # His own form of k² cancels, in ε·n²/(1 − f0) at most.
    assert (np.abs(k**2 - (f0 * (n + 1) ** 2 - (n - 1) ** 2) / (1 - f0)) < 1e-15 * (n + 1) ** 2 / (1 - f0)).all()


@pytest.mark.parametrize("alpha", [0.01, 0.1, 0.5, 1.0])
@pytest.mark.parametrize("distribution", [microfacet.d_ggx, microfacet.d_beckmann, microfacet.d_blinn])
def test_every_distribution_covers_the_surface_and_is_as_high_as_the_others(distribution, alpha):
    """∫D(h)(n·h) dh = 1, over slopes tan θ = α·s: dh = 2π sin θ dθ, dθ = cos²θ·α ds."""
    nodes, weights = np.polynomial.legendre.leggauss(200)
    s = (1 + nodes) / (1 - nodes)  # 0…∞
    weight = weights * 2 / (1 - nodes) ** 2
    cosine = 1 / np.sqrt(1 + (alpha * s) ** 2)
    sine2 = 1 - cosine**2 if alpha > 0.1 else (alpha * s * cosine) ** 2
    density = distribution(cosine, sine2, alpha) * cosine
    assert np.sum(weight * density * 2 * np.pi * np.sqrt(sine2) * cosine**2 * alpha) == pytest.approx(1, abs=1e-5)
    assert distribution(1.0, 0.0, alpha) == pytest.approx(1 / (np.pi * alpha**2))
    assert distribution(-0.5, 0.75, alpha) == 0


def test_a_power_of_a_cosine_near_one_keeps_its_digits():
    """cos 1e-4 to the 2·10⁶ is e^(−0.01): ln cos x = −x²/2 − x⁴/12. From a float32 cosine it would be 1."""
    right = np.exp(2e6 * (-(1e-4**2) / 2 - 1e-4**4 / 12))
    cosine, sin2 = np.float32(np.cos(1e-4)), np.float32(np.sin(1e-4) ** 2)
    assert microfacet.cosine_power(cosine, sin2, np.float32(2e6)) == pytest.approx(right, rel=1e-6)
    assert abs(cosine ** np.float32(2e6) - right) > 1e-3
    for angle in (0.124, 0.126, 1.0):  # either side of where the series ends
        power = microfacet.cosine_power(np.cos(angle), np.sin(angle) ** 2, 500.0)
        assert power == pytest.approx(np.cos(angle) ** 500, rel=1e-5)


@pytest.mark.parametrize("masking", MASKINGS)
def test_maskings_are_reciprocal_and_hide_a_share(masking):
    """0 ≤ G ≤ 1 for G = V·4·n·v·n·l; the fast one stays below 1 too: 2/(1/n·v + 1/n·l) ≤ its divisor's mean."""
    rng = np.random.default_rng(3)
    v, l, alpha = rng.uniform(1e-3, 1, (3, 10_000))  # noqa: E741
    value = masking(v, l, alpha)
    assert np.allclose(value, masking(l, v, alpha), rtol=1e-14)
    assert (value > 0).all() and (value * 4 * v * l <= 1 + 1e-12).all()


@pytest.mark.parametrize(
    ("masking", "expected"),
    [
        (microfacet.v_smith_ggx_separable, (0.307, 0.329, 0.409, 0.523)),
        (microfacet.v_smith_ggx_correlated, (0.307, 0.335, 0.451, 0.668)),
    ],
)
def test_white_conductor_albedo_with_separable_and_correlated_heights(masking, expected):
    """α = 1 at 1°, 30°, 60° and 80°; three digits are published."""
    cosine = np.cos(np.radians([1, 30, 60, 80]))
    assert directional_albedo(microfacet.d_ggx, masking, 1.0, cosine) == pytest.approx(expected, abs=5.5e-4)


@pytest.mark.parametrize(("alpha", "cosine", "expected"), white_metal.ALBEDOS)
def test_the_quadrature_of_an_albedo(alpha, cosine, expected):
    found = directional_albedo(microfacet.d_ggx, microfacet.v_smith_ggx_correlated, alpha, cosine)
    assert found == pytest.approx(expected, abs=6e-5)


@pytest.mark.parametrize(("alpha", "loss"), white_metal.LOSSES)
def test_mean_energy_loss(alpha, loss):
    nodes, weights = np.polynomial.legendre.leggauss(16)
    cosine, weight = (nodes + 1) / 2, weights / 2
    directional = directional_albedo(microfacet.d_ggx, microfacet.v_smith_ggx_correlated, alpha, cosine)
    assert 1 - mean_albedo(directional, cosine, weight) == pytest.approx(loss, abs=1e-3)


PUBLISHED = {
    "aluminium": (0.913, 0.922, 0.924),
    "chromium": (0.550, 0.556, 0.554),
    "copper": (0.955, 0.638, 0.538),
    "gold": (1.022, 0.782, 0.344),
    "iron": (0.562, 0.565, 0.578),
    "silver": (0.972, 0.960, 0.915),
}
"""Akenine-Möller, Haines & Hoffman et al. 2018, Real-Time Rendering, table 9.2: linear Rec. 709."""


@pytest.mark.parametrize("metal", conductors.METALS)
def test_metals_are_of_their_published_colours(metal):
    """Samples differ: evaporated films are purer and smoother than what others measured. Hence 0.09 (iron, blue)."""
    found = conductors.rgb_reflectance(metal, 1.0)
    assert found == pytest.approx(PUBLISHED[metal], abs=0.09)
    order = np.argsort(PUBLISHED[metal])
    if np.ptp(PUBLISHED[metal]) > 0.1:
        assert (np.argsort(found) == order).all()


def test_a_metal_s_colour_is_what_colour_science_makes_of_its_spectrum():
    """By another way: the reflectance as a spectral distribution under D65. Both sum over 5 nm and ASTM E308's
    corrections at the ends are 1e-3; the white point's rounding adds 4e-4."""
    colour = pytest.importorskip("colour")
    n, k = conductors.index_at("copper", conductors.WAVELENGTHS)
    values = fresnel.f_conductor(1.0, n, k)
    spectrum = colour.SpectralDistribution(dict(zip(conductors.WAVELENGTHS, values, strict=True)))
    seen = colour.sd_to_XYZ(spectrum, illuminant=colour.SDS_ILLUMINANTS["D65"]) / 100
    expected = colour.XYZ_to_RGB(seen, "ITU-R BT.709", apply_cctf_encoding=False)
    assert conductors.rgb_reflectance("copper", 1.0) == pytest.approx(expected, abs=2e-3)


def test_a_perfect_mirror_is_white_and_every_metal_shines_at_grazing_angles():
    assert conductors.rgb_weights().sum(axis=1) == pytest.approx([1, 1, 1])
    for metal in conductors.METALS:
        assert conductors.rgb_reflectance(metal, np.array([1.0, 0.0]))[:, 1] == pytest.approx([1, 1, 1])
        n, k = conductors.rgb_index(metal)
        assert (n > 0).all() and (k > 0).all()


def test_an_unknown_metal_is_refused():
    with pytest.raises(KeyError, match="unobtainium"):
        conductors.rgb_reflectance("unobtainium", 1.0)
