"""Light from everywhere, against closed forms and published albedos."""

import numpy as np
import pytest

from lightmeter.scenes.optics import anisotropy, material, microfacet
from lightmeter.scenes.optics.furnace import COARSE, FINE, SEARCH, light_from_everywhere

UP = np.array([[0.0], [0.0], [1.0]])


def view(cosine: float) -> np.ndarray:
    return np.array([[np.sqrt(1 - cosine * cosine)], [0.0], [cosine]])


def albedo(lobe, cosine: float, rule=FINE, turn: float | None = None) -> float:
    """Of a lobe f·(n·l) of v and l."""
    light, weight = light_from_everywhere(cosine, rule, turn)
    return float(np.sum(lobe(view(cosine) + 0 * light, light) * weight))


def white_metal(alpha: float):
    point = material.MaterialPoint(np.ones((3, 1)), 1.0, np.sqrt(alpha), 1.0)
    return lambda v, light: material.evaluate(point, UP + 0 * light, v, light)[0]


def mirror_power(exponent: float):
    """(s + 2)/(2π)·cosˢ to the mirror direction, times n·l: Lafortune's normalisation of Phong."""

    def lobe(v, light):
        mirrored = np.stack([-v[0], -v[1], v[2]])
        sin2 = np.sum(np.cross(mirrored, light, axis=0) ** 2, axis=0)
        power = microfacet.cosine_power(np.sum(mirrored * light, axis=0), sin2, exponent)
        return (exponent + 2) / (2 * np.pi) * power * light[2]

    return lobe


@pytest.mark.parametrize("cosine", [1.0, 0.5, 0.01, 1e-3])
def test_what_is_even_is_given_back_whole(cosine):
    light, weight = light_from_everywhere(cosine, FINE)
    assert (light[2] > -1e-12).all() and np.linalg.norm(light, axis=0) == pytest.approx(1)
    # What lies within 1e-6 of the horizon is left out: 1e-12 of a cosine's integral, 1e-6 of a constant's.
    assert np.sum(light[2] * weight) / np.pi == pytest.approx(1, abs=1e-9)
    assert np.sum(weight) / (2 * np.pi) == pytest.approx(1, abs=3e-6)


@pytest.mark.parametrize(
    ("alpha", "cosine", "published"),
    [
        (1, 1, 1 - np.log(2)),
        (0.25, 1, 0.9158),
        (0.09, 1, 0.9907),
        (1, 0.5, 0.4507),
        (0.25, 0.5, 0.8573),
        (0.09, 0.5, 0.9751),
    ],
)
def test_ggx(alpha, cosine, published):
    """The first in closed form; the others to the digits that are published."""
    assert albedo(white_metal(alpha), cosine) == pytest.approx(published, abs=1e-8 if alpha == cosine == 1 else 5e-5)


def test_a_mirrors_lobe_is_resolved_at_any_width():
    """At normal incidence Lafortune's lobe returns all, for every exponent; aside nearly the mirror's cosine."""
    for exponent in (2.0, 50.0, 5e3, 5e5):
        assert albedo(mirror_power(exponent), 1.0) == pytest.approx(1, abs=1e-7)
    assert albedo(mirror_power(5e5), 0.1) == pytest.approx(0.1, abs=1e-7)
    # The rules' own errors, as their declaration says.
    assert albedo(mirror_power(5e5), 1.0, COARSE) == pytest.approx(1, abs=2e-5)
    assert albedo(mirror_power(5e5), 1.0, SEARCH) == pytest.approx(1, abs=5e-3)


def grained(strength: float, turn: float):
    grain = anisotropy.Grain(strength, np.array([[np.cos(turn)], [np.sin(turn)], [0.0]]))
    return lambda v, light: anisotropy.lobe(grain, 1e-3, UP, v, light) * np.maximum(light[2], 0)


def test_a_grain_is_resolved_wherever_it_runs():
    """From straight above a grain may run anywhere, while the nodes lie otherwise for each."""
    for strength in (0.3, 1.0):
        found = [albedo(grained(strength, turn), 1.0, turn=turn) for turn in (0.0, 0.4, np.pi / 4, np.pi / 2)]
        assert found == pytest.approx([found[0]] * 4, abs=1e-7)
    # Without one the lobe is GGX's, which the nodes of half a turn resolve too.
    assert albedo(grained(0.0, 0.4), 0.1, turn=0.4) == pytest.approx(albedo(white_metal(1e-3), 0.1), abs=1e-8)
