"""The random walk on the microsurface against what is known of it: nothing is lost, and its first bounce is GGX's lobe.

Tolerances are 4.5 standard errors of a share of N rays, √(p(1 − p)/N) ≤ 1/(2√N): one false alarm in 10⁵ a number.
"""

import numpy as np
import pytest

from lightmeter.scenes.optics import microfacet
from lightmeter.scenes.optics.albedo import directional_albedo
from lightmeter.scenes.optics.microsurface import walk

from .. import white_metal

COUNT = 40_000
SURE = 4.5 / (2 * np.sqrt(COUNT))


def mirror(cosine):
    """F = 1."""
    return np.ones((1, len(cosine)))


def leaning(cosine: float) -> np.ndarray:
    """That many times a direction of that cosine."""
    return np.repeat([[np.sqrt(1 - cosine**2)], [0.0], [cosine]], COUNT, axis=1)


def from_everywhere(rng: np.random.Generator) -> np.ndarray:
    """Directions as light from everywhere meets a plane: by the cosine."""
    cosine, turn = np.sqrt(rng.random(COUNT)), 2 * np.pi * rng.random(COUNT)
    sine = np.sqrt(1 - cosine**2)
    return np.stack([sine * np.cos(turn), sine * np.sin(turn), cosine])


@pytest.mark.parametrize("alpha", [1.0, 0.25, 0.01])
@pytest.mark.parametrize("cosine", [1.0, 0.5, 0.1])
def test_a_white_furnace_is_returned_whole_and_the_first_bounce_is_the_lobe(alpha, cosine):
    rng = np.random.default_rng([round(100 * alpha), round(10 * cosine)])
    found = walk(leaning(cosine), alpha, mirror, rng)
    assert found.albedo() == pytest.approx([1], abs=1e-12)
    assert (found.direction[2] > 0).all()
    assert np.linalg.norm(found.direction, axis=0) == pytest.approx(np.ones(COUNT))
    lobe = directional_albedo(microfacet.d_ggx, microfacet.v_smith_ggx_correlated, alpha, cosine)
    assert found.albedo(1, 1) == pytest.approx([lobe], abs=SURE)


@pytest.mark.parametrize(("alpha", "loss"), white_metal.LOSSES)
def test_what_single_scattering_loses_comes_back_later(alpha, loss):
    rng = np.random.default_rng(7)
    found = walk(from_everywhere(rng), alpha, mirror, rng)
    assert found.albedo(2) == pytest.approx([loss], abs=SURE + 1e-3)


def test_every_bounce_is_dimmed():
    """With F = ½ a ray of k bounces weighs 2⁻ᵏ, whatever else."""
    rng = np.random.default_rng(3)
    found = walk(leaning(0.8), 1.0, lambda cosine: np.full((2, len(cosine)), [[0.5], [0.25]]), rng)
    np.testing.assert_allclose(found.weight, np.array([[0.5], [0.25]]) ** found.bounces)
    assert found.bounces.max() > 4


def test_a_smooth_surface_mirrors():
    found = walk(leaning(0.6), 1e-3, mirror, np.random.default_rng(1))
    assert np.abs(found.direction - np.array([[-0.8], [0], [0.6]])).mean() < 3e-3


def test_a_ray_that_is_given_up_weighs_nothing():
    found = walk(leaning(0.6), 1.0, mirror, np.random.default_rng(1), most=1)
    assert set(found.bounces[found.weight[0] == 0]) == {2}
    assert found.albedo()[0] == pytest.approx(found.albedo(1, 1)[0])


def test_the_lobe_of_all_bounces_is_reciprocal():
    """f(v, l) = f(l, v): from 25° the share that leaves within 65 ± 5° is that from 65° within 25 ± 5°, per solid angle
    and cosine of the leaving direction. Shares are a few in a hundred; bins are 10° wide, in which f bends by 1 %.
    """
    rng = np.random.default_rng(11)

    def share(come: float, go: float) -> float:
        low, high = np.cos(np.radians([go + 5, go - 5]))
        out = walk(leaning(np.cos(np.radians(come))), 0.7, mirror, rng).direction[2]
        return np.mean((out > low) & (out < high)) / (np.pi * (high**2 - low**2))

    there, back = share(25, 65), share(65, 25)
    assert there == pytest.approx(back, rel=0.06)
