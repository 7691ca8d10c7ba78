"""SSIM's closed forms and ΔE against published pairs."""

import numpy as np
import pytest

from lightmeter.metrics import InputError, measure
from lightmeter.metrics.delta_e import delta_e_2000_map, delta_e_itp_map
from lightmeter.metrics.ssim import ssim_map


def solid(value, size=16):
    return np.broadcast_to(np.asarray(value, float), (size, size, 3))


def test_ssim_of_solids():
    # No variance: only the luminance term is left, (2ab + C1)/(a² + b² + C1), C1 = (0.01 · range)². float32 sums of
    # the window lose a few 1e-7 of a², which the variances, being differences, feel against C2 = 9e-4: 1e-3.
    a, b, c1 = 0.4, 0.7, 1e-4
    expected = (2 * a * b + c1) / (a * a + b * b + c1)
    assert measure("ssim", solid(a), solid(b)).value == pytest.approx(expected, abs=1e-3)
    expected = (2 * a * b + 4 * c1) / (a * a + b * b + 4 * c1)
    assert measure("ssim", solid(a), solid(b), data_range=2.0).value == pytest.approx(expected, abs=1e-3)


def test_ssim_of_a_scaled_pattern():
    # y = 2m − x, mirrored about its mean: where the local mean is near m, structure is −1. Against the formula, with
    # moments from a direct 11 × 11 Gaussian sum at the middle pixel.
    rng = np.random.default_rng(0)
    x = np.repeat(rng.random((11, 11, 1)), 3, axis=2)
    y = 1 - x
    g = np.exp(-(np.arange(-5, 6) ** 2) / (2 * 1.5**2))
    w = np.outer(g, g) / g.sum() ** 2
    mx, my = (w * x[..., 0]).sum(), (w * y[..., 0]).sum()
    vx, cov = (w * (x[..., 0] - mx) ** 2).sum(), -(w * (x[..., 0] - mx) ** 2).sum()
    expected = (2 * mx * my + 1e-4) * (2 * cov + 9e-4) / ((mx**2 + my**2 + 1e-4) * (2 * vx + 9e-4))
    found = ssim_map(x, y)
    assert found[5, 5] == pytest.approx(expected, abs=1e-4)
    assert np.isnan(found).sum() == 121 - 1
    assert measure("ssim", x, y).value == pytest.approx(expected, abs=1e-4)


def test_ssim_equal_and_masked():
    image = np.random.default_rng(1).random((20, 24, 3))
    assert measure("ssim", image, image).value == pytest.approx(1)
    broken = image.copy()
    broken[:, 12:] = 0
    mask = np.zeros((20, 24), bool)
    mask[:, :7] = True  # five pixels from the damage
    assert measure("ssim", broken, image, mask).value == pytest.approx(1)
    assert measure("ssim", broken, image).value < 0.9
    edge = np.zeros((20, 24), bool)
    edge[0] = True
    with pytest.raises(InputError, match="at every pixel of the mask"):
        measure("ssim", image, image, edge)


def test_ssim_needs_its_window():
    with pytest.raises(InputError, match="at least 11×11 pixels, got 30×10"):
        measure("ssim", np.zeros((10, 30, 3)), np.zeros((10, 30, 3)))


def test_ssim_data_range_matters():
    rng = np.random.default_rng(2)
    a, b = rng.random((2, 16, 16, 3))
    assert measure("ssim", a, b).value == pytest.approx(measure("ssim", 3 * a, 3 * b, data_range=3.0).value, abs=1e-5)


# Sharma, Wu, Dalal 2005, table 1: pairs 1, 4, 7, 9, 13, 16, 17, 20, 25, 31, 34 (hue's wrap, the rotation term, greys).
SHARMA = [
    ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
    ((50.0, -1.3802, -84.2814), (50.0, 0.0, -82.7485), 1.0000),
    ((50.0, 0.0, 0.0), (50.0, -1.0, 2.0), 2.3669),
    ((50.0, 2.4900, -0.0010), (50.0, -2.4900, 0.0009), 7.1792),
    ((50.0, -0.0010, 2.4900), (50.0, 0.0009, -2.4900), 4.8045),
    ((50.0, 2.5, 0.0), (50.0, 0.0, -2.5), 4.3065),
    ((50.0, 2.5, 0.0), (73.0, 25.0, -18.0), 27.1492),
    ((50.0, 2.5, 0.0), (58.0, 24.0, 15.0), 19.4535),
    ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
    ((90.8027, -2.0831, 1.4410), (91.1528, -1.6435, 0.0447), 1.4441),
    ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082),
]


def to_srgb(lab):
    """CIELAB to sRGB-encoded values, in plain NumPy, with the sRGB matrix' own white."""
    matrix = np.array(
        [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]  # IEC 61966-2-1
    )
    lightness, a, b = lab
    f = (lightness + 16) / 116 + np.array([a / 500, 0, -b / 200])
    xyz = np.where(f > 6 / 29, f**3, (f - 4 / 29) * 108 / 841) * matrix.sum(axis=1)
    linear = np.linalg.solve(matrix, xyz)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.abs(linear) ** (1 / 2.4) - 0.055)


@pytest.mark.parametrize(("one", "other", "published"), SHARMA)
def test_delta_e_2000_of_sharmas_pairs(one, other, published):
    pair = [to_srgb(one), to_srgb(other)]
    if min(map(np.min, pair)) < 0 or max(map(np.max, pair)) > 1:
        # Outside of sRGB: no display image can hold it. Then the formula alone.
        from lightmeter.metrics.delta_e import _colour

        found = _colour().difference.delta_E_CIE2000(np.array(one), np.array(other))
    else:
        found = delta_e_2000_map(np.array(pair[0]).reshape(1, 1, 3), np.array(pair[1]).reshape(1, 1, 3))[0, 0]
    # Published to four digits; the sRGB curve's two pieces meet with a step of 2e-8 only.
    assert found == pytest.approx(published, abs=2e-4)


def test_some_of_sharmas_pairs_are_display_colours():
    inside = [np.concatenate([to_srgb(a), to_srgb(b)]) for a, b, _ in SHARMA]
    assert sum(((v >= 0) & (v <= 1)).all() for v in inside) >= 7


def test_delta_e_2000_of_greys():
    # Neutral colours: only lightness is left, ΔL / S_L. Black and white: 100 / (1 + 0.015·0/√20) = 100.
    assert delta_e_2000_map(solid(1, 2), solid(0, 2)) == pytest.approx(100, abs=1e-6)
    assert measure("delta_e_2000", solid(2, 2), solid(1, 2)).value == 0  # clamped


def test_delta_e_itp_of_greys():
    # BT.2124: 720 √(ΔI² + …), neutral colours differ in I alone, and I of a grey is PQ of its luminance (ST 2084). The
    # matrices' digits (four, in BT.2087 and BT.2100) leave neutral colours 1e-4 off: 0.1 of 720.
    def pq(luminance):
        y = (luminance / 10000) ** (2610 / 16384)
        return ((3424 / 4096 + 2413 / 128 * y) / (1 + 2392 / 128 * y)) ** (2523 / 32)

    found = delta_e_itp_map(solid(1, 2), solid(0.5, 2), white=200)
    assert found == pytest.approx(720 * (pq(200) - pq(100)), abs=0.1)
    assert measure("delta_e_itp", solid(-1, 2), solid(0, 2)).value == pytest.approx(0, abs=1e-9)
    assert np.isfinite(measure("delta_e_itp", solid(1e30, 2), solid(0, 2)).value)
    with pytest.raises(InputError, match="needs a white"):
        measure("delta_e_itp", solid(1, 2), solid(1, 2), white=0)


def test_display_transform_is_put_on_both_sides():
    rng = np.random.default_rng(3)
    tested, batches = rng.random((14, 14, 3)) * 4, rng.random((3, 14, 14, 3)) * 4

    def display(radiance):
        return np.clip(radiance / 4, 0, 1) ** (1 / 2.2)

    for name in ("flip", "ssim", "delta_e_2000"):
        found = measure(name, tested, batches, display=display)
        assert found.value == pytest.approx(measure(name, display(tested), display(batches.mean(axis=0))).value)
        halves = [display(batches[i::2].mean(axis=0)) for i in (0, 1)]
        assert found.floor == pytest.approx(measure(name, *halves).value)
