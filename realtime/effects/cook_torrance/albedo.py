"""The table that compensation reads: what single scattering returns, for the parts that the knobs choose."""

from functools import cache

import numpy as np

from lightmeter.scenes.optics import microfacet
from lightmeter.scenes.optics.albedo import directional_albedo, mean_albedo

SIDE = 32


@cache
def albedo_table(distribution: str, masking: str) -> np.ndarray:
    """(32, 32, 4) float32: E(n·v) and its mean over the hemisphere, over roughness (down) and √(n·v) (across), 0…1.

    The root spreads grazing angles, where E bends most.

    Args:
        distribution, masking: names of functions of `scenes.optics.microfacet`.
    """
    parts = getattr(microfacet, distribution), getattr(microfacet, masking)
    alpha = microfacet.alpha_from_roughness(np.linspace(0.0, 1.0, SIDE))[:, None]
    cosine = np.maximum(np.linspace(0.0, 1.0, SIDE) ** 2, 1e-5)
    nodes, weights = np.polynomial.legendre.leggauss(16)
    nodes, weights = (nodes + 1) / 2, weights / 2
    table = np.zeros((SIDE, SIDE, 4), np.float32)
    table[..., 0] = directional_albedo(*parts, alpha, cosine)
    table[..., 1] = mean_albedo(directional_albedo(*parts, alpha, nodes), nodes, weights)[:, None]
    return table
