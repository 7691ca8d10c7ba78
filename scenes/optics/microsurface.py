"""Light that bounces on a GGX microsurface until it leaves: a random walk (Heitz et al. 2016).

"Multiple-Scattering Microfacet BSDFs with the Smith Model": the truth that single scattering falls short of on rough
metals, and that compensation approximates. The surface is z = 0, its facets are mirrors. A height is told by the share
of the surface that lies below it: whatever the heights' distribution, the directions are the same.
`walk` is in float64 NumPy; its steps serve Dr.Jit as well, where `groundtruth` walks inside a renderer.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from . import arrays as xp
from . import microfacet
from .arrays import Array

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
        leaves, below[inside] = next_height(direction[2, inside], below[inside], alpha, rng.random(len(inside)))
        gone, inside = inside[leaves], inside[~leaves]
        weight[:, gone], out[:, gone] = left[:, gone], direction[:, gone]
        facing = -direction[:, inside]
        u1, u2 = rng.random((2, len(inside)))
        normal = microfacet.sample_visible_normal(facing, alpha, u1, u2, _stack)
        cosine = np.sum(facing * normal, axis=0)
        left[:, inside] *= reflectance(cosine)
        direction[:, inside] = 2 * cosine * normal - facing
        bounces[inside] += 1
    return Walk(out, weight, bounces)


def next_height(cosine: Array, below: Array, alpha: Array, u: Array) -> tuple[Array, Array]:
    """Whether rays leave, and what lies below the facet that they meet otherwise (algorithm 1).

    Args:
        cosine: of the direction they go, with the surface's normal.
        below: of where they are.
        u: uniform in [0, 1).
    """
    area = lambda_ggx(cosine, alpha)
    remaining = xp.log(1 - u)
    leaves = (cosine > 0) & (remaining <= area * xp.log(below))
    onward = xp.minimum(below * xp.exp(-remaining / xp.where(leaves, 1.0, area)), 1.0)
    return leaves, xp.where(leaves, 1.0, onward)


def lambda_ggx(cosine: Array, alpha: Array) -> Array:
    """Smith's Λ of GGX (Heitz 2014, eq. 72); of a direction downward −1 − Λ of its opposite."""
    # Level rays meet a facet where they are: the step is small, not undefined.
    level = xp.where(cosine * cosine < 1e-18, 1e-9, cosine)
    root = xp.sqrt(1 + alpha * alpha * (1 - level * level) / (level * level))
    return (xp.where(level > 0, root, -root) - 1) / 2


def mirrored(facing: Array, l: Array, alpha: Array, vector: Callable) -> tuple[Array, Array]:  # noqa: E741
    """Density over l, 1/sr, of what the facets that are seen from `facing` mirror there, and the cosine at the facet.

    The phase function of mirrors, D(h)/(4·σ), with σ the area of facets that is seen per area of surface.

    Args:
        facing: unit, in the frame of the surface; may be below it, where only steep facets are seen.
        l: unit, above the surface.
    """
    n_dot_h, sin2_h, cosine = microfacet.half_cosines(vector(0 * l[2], 0 * l[2], 1 + 0 * l[2]), facing, l)
    z, a2 = facing[2], alpha * alpha
    root = xp.sqrt(z * z * (1 - a2) + a2)
    # σ = (z + root)/2, which cancels for z < 0: there the root's conjugate, as root² − z² = α²·(1 − z²).
    seen = xp.where(z > 0, z + root, a2 * (1 - z * z) / xp.maximum(root - z, 1e-20))
    density = microfacet.d_ggx(n_dot_h, sin2_h, alpha) / xp.maximum(2 * seen, 1e-20)
    return density, cosine


def _stack(*components: np.ndarray) -> np.ndarray:
    return np.stack(np.broadcast_arrays(*components))
