"""A clear coat over a material, as KHR_materials_clearcoat defines it: GGX of a dielectric of index 1.5, F0 = 0.04.

f = mix(base, coat, c·F(n_c·v)): the coat takes from everything below it, alike for all light, what it reflects towards
the viewer by itself. That F is of the view alone makes it simple, and not reciprocal. The coat has its own normal n_c,
and reflects between directions on that normal's side.
"""

from collections.abc import Callable
from dataclasses import dataclass

from . import arrays as xp
from . import microfacet
from .arrays import Array

F0 = 0.04


@dataclass(frozen=True)
class Coat:
    """A coat at points: `factor` and `roughness` (N,), 0…1; `normal` (3, N), unit."""

    factor: Array
    roughness: Array
    normal: Array

    @property
    def alpha(self) -> Array:
        """GGX's α."""
        return microfacet.alpha_from_roughness(self.roughness)


def reflectance(coat: Coat, v: Array) -> Array:
    """c·F(|n_c·v|): the share of the coat in what v sees."""
    n_dot_v = xp.dot(coat.normal, v)
    return coat.factor * microfacet.f_schlick(xp.maximum(n_dot_v, -n_dot_v), F0, 1.0)


def lobe(coat: Coat, v: Array, l: Array) -> Array:  # noqa: E741 (l: light, as in the field)
    """D·V·(n_c·l), 1/sr: the coat as if it reflected everything."""
    n_dot_v, n_dot_l = xp.dot(coat.normal, v), xp.dot(coat.normal, l)
    n_dot_h, sin2_h, _ = microfacet.half_cosines(coat.normal, v, l)
    d = microfacet.d_ggx(n_dot_h, sin2_h, coat.alpha)
    visible = microfacet.v_smith_ggx_correlated(xp.maximum(n_dot_v, 1e-7), xp.maximum(n_dot_l, 1e-7), coat.alpha)
    value = d * visible * n_dot_l
    return xp.where((n_dot_v > 0) & (n_dot_l > 0), value, 0 * value)


def over(coat: Coat, base: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """f·cos of the coated base, 1/sr, given that of the base, (3, N)."""
    return xp.mix(base, lobe(coat, v, l), reflectance(coat, v))


def probability(coat: Coat, base_albedo: Array, v: Array) -> Array:
    """How often sampling picks the coat: its share of a cheap estimate of both albedos, (N,)."""
    share = reflectance(coat, v)
    picked = share / xp.maximum(share + (1 - share) * base_albedo, 1e-7)
    # A coat seen from below its own horizon has no lobe, and what nothing reflects needs no samples.
    there = (share > 0) & (xp.dot(coat.normal, v) > 0)
    return xp.where(there, xp.clip(picked, 0.1, 1.0), 0 * picked)


def pdf(coat: Coat, v: Array, l: Array) -> Array:  # noqa: E741
    """Density of `sample` over directions l, 1/sr; 0 below the coat's horizon."""
    n_dot_v, n_dot_l = xp.dot(coat.normal, v), xp.dot(coat.normal, l)
    n_dot_h, sin2_h, _ = microfacet.half_cosines(coat.normal, v, l)
    d = microfacet.d_ggx(n_dot_h, sin2_h, coat.alpha)
    value = microfacet.mirrored_density(n_dot_v, d, coat.alpha)
    return xp.where((n_dot_v > 0) & (n_dot_l > 0), value, 0 * value)


def sample(coat: Coat, v: Array, u1: Array, u2: Array, vector: Callable) -> Array:
    """A direction mirrored at a visible microfacet of the coat; `vector` builds a vector from x, y, z."""
    return microfacet.sample_mirrored(coat.normal, v, coat.alpha, u1, u2, vector)
