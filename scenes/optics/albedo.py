"""How much of the light a lobe of microfacets returns, by quadrature over the half vectors."""

from collections.abc import Callable

import numpy as np

from . import microfacet
from .arrays import Array

Distribution = Callable[[Array, Array, Array], Array]
"""D of n·h, |n × h|² and α, 1/sr."""
Masking = Callable[[Array, Array, Array], Array]
"""V = G/(4·n·v·n·l) of n·v, n·l and α."""


def directional_albedo(
    distribution: Distribution,
    masking: Masking,
    alpha: np.ndarray,
    cosine: np.ndarray,
    rings: int = 32,
    sectors: int = 32,
) -> np.ndarray:
    """E(n·v): what single scattering with F = 1 reflects of light from one direction; above 1 energy is made.

    E = ∫ D·V·(n·l) dl over half vectors, dl = 4·(v·h) dh. Their slopes are spread as GGX's are, tan²θ = α²·t/(1 − t),
    so that a lobe of any width is resolved, and end where l meets the horizon: up to there the integrand is smooth.
    With 32 × 32 nodes GGX's E is within 5e-5 for n·v ≥ 0.1, and 5e-4 at 0.01.

    Args:
        alpha, cosine: of shapes that broadcast, float64; α ≥ 1e-3, cosines above 0.
        rings, sectors: nodes in slope (Gauss) and in azimuth (even, over half a turn: the lobe is symmetric).
    """
    alpha, cosine = (np.asarray(a, np.float64)[..., None, None] for a in np.broadcast_arrays(alpha, cosine))
    sine = np.sqrt(1 - cosine**2)
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    u, weight = ((nodes + 1) / 2)[:, None], (weights / 2)[:, None]
    turn = np.cos(np.pi * (np.arange(sectors) + 0.5) / sectors)
    # n·l = 0 where 2θ_h = 90° + atan(tan θ_v·cos φ).
    highest = np.tan(np.pi / 4 + np.arctan2(sine * turn, cosine) / 2) ** 2
    t_end = highest / (highest + alpha**2)
    # t = t_end·sin²(πu/2): the nodes crowd where the lobe is, and at the horizon, where V grows at grazing incidence.
    half_turn = np.pi / 2 * u
    t, weight = t_end * np.sin(half_turn) ** 2, t_end * np.pi * np.sin(half_turn) * np.cos(half_turn) * weight
    slope2 = alpha**2 * t / (1 - t)
    cosine_h, sin2_h = 1 / np.sqrt(1 + slope2), slope2 / (1 + slope2)
    v_dot_h = sine * np.sqrt(sin2_h) * turn + cosine * cosine_h
    n_dot_l = np.maximum(2 * v_dot_h * cosine_h - cosine, 1e-300)
    # GGX's own density over h is D·cos θ_h = dt dφ/(2π·dh): what remains of D is its ratio to GGX's.
    ratio = distribution(cosine_h, sin2_h, alpha) / microfacet.d_ggx(cosine_h, sin2_h, alpha)
    value = ratio * masking(cosine, n_dot_l, alpha) * 4 * v_dot_h * n_dot_l / cosine_h
    return np.sum(value * weight, axis=(-2, -1)) / sectors


def mean_albedo(directional: np.ndarray, cosines: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """2∫E(µ)·µ dµ: the share returned of light from everywhere.

    Args:
        directional: (…, n), E at the cosines.
        cosines, weights: (n,), a rule over 0…1.
    """
    return 2 * (directional * cosines * weights).sum(axis=-1)
