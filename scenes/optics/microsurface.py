"""Light that bounces on a GGX microsurface until it leaves: a random walk (Heitz et al. 2016).

"Multiple-Scattering Microfacet BSDFs with the Smith Model": the truth that single scattering falls short of on rough
metals, and that compensation approximates. Float64 NumPy; the surface is z = 0, its facets are mirrors. A height is
told by the share of the surface that lies below it: whatever the heights' distribution, the directions are the same.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .microfacet import sample_visible_normal

Reflectance = Callable[[np.ndarray], np.ndarray]
"""Fresnel's reflectance, (C, N), of the cosine (N,) between a ray and a facet's normal."""


@dataclass(frozen=True, eq=False)
class Walk:
    """Rays that met a microsurface.

    Attributes:
        direction: (3, N) unit, where each left to, above the surface; 0 for one that was given up.
        weight: (C, N) what is left of each, 0 for one that was given up.
        bounces: (N,) facets met; 1 is single scattering.
    """

    direction: np.ndarray
    weight: np.ndarray
    bounces: np.ndarray

    def albedo(self, least: int = 1, most: int | None = None) -> np.ndarray:
        """(C,): the share of the light that left after `least` to `most` bounces; all of it by default."""
        counted = (self.bounces >= least) & (self.bounces <= (self.bounces.max() if most is None else most))
        return np.where(counted, self.weight, 0.0).mean(axis=1)


def walk(v: np.ndarray, alpha: float, reflectance: Reflectance, rng: np.random.Generator, most: int = 100) -> Walk:
    """Light from v, followed until it leaves.

    Args:
        v: (3, N) unit, above the surface.
        alpha: GGX's α.
        most: bounces after which a ray is given up.
    """
    count = v.shape[1]
    direction, below = -v, np.ones(count)
    left = np.ones((len(reflectance(np.ones(1))), count))
    weight, out, bounces = np.zeros_like(left), np.zeros_like(direction), np.zeros(count, int)
    inside = np.arange(count)
    for _ in range(most + 1):
        leaves, below[inside] = _next_height(direction[2, inside], below[inside], alpha, rng)
        gone, inside = inside[leaves], inside[~leaves]
        weight[:, gone], out[:, gone] = left[:, gone], direction[:, gone]
        facing = -direction[:, inside]
        u1, u2 = rng.random((2, len(inside)))
        normal = sample_visible_normal(facing, alpha, u1, u2, _stack)
        cosine = np.sum(facing * normal, axis=0)
        left[:, inside] *= reflectance(cosine)
        direction[:, inside] = 2 * cosine * normal - facing
        bounces[inside] += 1
    return Walk(out, weight, bounces)


def _next_height(
    cosine: np.ndarray, below: np.ndarray, alpha: float, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Whether rays leave, and what lies below the facet that they meet otherwise (algorithm 1).

    Args:
        cosine: of the direction they go, with the surface's normal.
        below: of where they are.
    """
    # Λ: of directions downward −1 − Λ of the opposite. Level ones meet a facet where they are.
    level = np.where(np.abs(cosine) < 1e-9, 1e-9, cosine)
    area = (np.sign(level) * np.sqrt(1 + alpha**2 * (1 - level**2) / level**2) - 1) / 2
    remaining = np.log(1 - rng.random(len(cosine)))
    leaves = (cosine > 0) & (remaining <= area * np.log(below))
    onward = np.minimum(below * np.exp(-remaining / np.where(leaves, 1.0, area)), 1.0)
    return leaves, np.where(leaves, 1.0, onward)


def _stack(*components: np.ndarray) -> np.ndarray:
    return np.stack(np.broadcast_arrays(*components))
