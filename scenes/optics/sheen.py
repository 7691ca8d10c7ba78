"""Sheen of cloth over a material, as KHR_materials_sheen defines it (Estevez & Kulla 2017, Production Friendly
Microfacet Sheen BRDF).

f = color·D·V + base·min(1 − m·E(n·v), 1 − m·E(n·l)), m the largest of the colour's channels and E the albedo of D·V:
what the sheen returns the base does not get. D is the exponentiated sine ("Charlie"), V has the paper's own Λ.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from . import arrays as xp
from . import microfacet
from .arrays import Array
from .frames import basis

PI = 3.141592653589793
TABLE_SIDE = 32


@dataclass(frozen=True)
class Sheen:
    """Sheen at points: `color` (3, N) and `roughness` (N,), 0…1; `table` holds `albedo_table`, flat."""

    color: Array
    roughness: Array
    table: Array

    @property
    def strength(self) -> Array:
        """The largest channel of its colour."""
        return xp.maximum(xp.maximum(self.color[0], self.color[1]), self.color[2])


def d_charlie(n_dot_h: Array, sin2_h: Array, alpha: Array) -> Array:
    """The distribution of fibres, 1/sr: (2 + 1/α)·sin^(1/α)/2π (eq. 2); 0 below the horizon."""
    inverse = 1 / alpha
    value = (2 + inverse) * xp.exp(0.5 * inverse * xp.log(xp.maximum(sin2_h, 1e-30))) * (1 / (2 * PI))
    return xp.where(n_dot_h > 0, value, 0 * value)


def curve(x: Array, alpha: Array) -> Array:
    """The fit of ln Λ up to 60°, x the cosine, 0.5…1 there (eq. 3, table 1)."""
    t = (1 - alpha) * (1 - alpha)
    a, b = xp.mix(21.5473, 25.3245, t), xp.mix(3.82987, 3.32435, t)
    c, d, e = xp.mix(0.19823, 0.16801, t), xp.mix(-1.97760, -1.27393, t), xp.mix(-4.32054, -4.85967, t)
    return a / (1 + b * xp.exp(c * xp.log(xp.maximum(x, 1e-30)))) + d * x + e


def shadowing(cosine: Array, alpha: Array) -> Array:
    """Λ of Smith's masking, 0 or more, of cosines 0…1: the fit, mirrored at 60° (eq. 3)."""
    steep = 2 * curve(0.5 + 0 * cosine, alpha) - curve(1 - cosine, alpha)
    return xp.exp(xp.where(cosine < 0.5, curve(cosine, alpha), steep))


def v_charlie(n_dot_v: Array, n_dot_l: Array, alpha: Array) -> Array:
    """G/(4·n·v·n·l), 1/(1 + Λ(v) + Λ(l)) being G. Cosines > 0."""
    masked = 1 + shadowing(n_dot_v, alpha) + shadowing(n_dot_l, alpha)
    return 0.25 / (masked * n_dot_v * n_dot_l)


def lobe(sheen: Sheen, n: Array, v: Array, l: Array) -> Array:  # noqa: E741 (l: light, as in the field)
    """D·V·(n·l), 1/sr: the sheen as if it were white."""
    n_dot_v, n_dot_l = xp.dot(n, v), xp.dot(n, l)
    n_dot_h, sin2_h, _ = microfacet.half_cosines(n, v, l)
    alpha = microfacet.alpha_from_roughness(sheen.roughness)
    to_v, to_l = xp.maximum(n_dot_v, 1e-6), xp.maximum(n_dot_l, 1e-6)
    value = d_charlie(n_dot_h, sin2_h, alpha) * v_charlie(to_v, to_l, alpha) * to_l
    return xp.where((n_dot_v > 0) & (n_dot_l > 0), value, 0 * value)


def scaling(sheen: Sheen, n_dot_v: Array, n_dot_l: Array) -> Array:
    """What the sheen leaves of its base, 0…1."""
    returned = xp.maximum(albedo(sheen, n_dot_v), albedo(sheen, n_dot_l))
    return xp.maximum(1 - sheen.strength * returned, 0.0)


def over(sheen: Sheen, base: Array, n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """f·(n·l) with the sheen, 1/sr, given that of the base, (3, N)."""
    return sheen.color * lobe(sheen, n, v, l) + base * scaling(sheen, xp.dot(n, v), xp.dot(n, l))


def albedo(sheen: Sheen, cosine: Array) -> Array:
    """E of cosines (N,), 0…1, by the table, interpolated linearly."""
    x, y = _place(xp.sqrt(xp.maximum(cosine, 0.0))), _place(sheen.roughness)
    left, top = (xp.minimum(xp.floor(place), TABLE_SIDE - 2) for place in (x, y))
    first = TABLE_SIDE * top + left

    def row(start: Array) -> Array:
        return xp.mix(xp.take(sheen.table, start), xp.take(sheen.table, start + 1), x - left)

    return xp.mix(row(first), row(first + TABLE_SIDE), y - top)


def _place(share: Array) -> Array:
    """Where in the table 0…1 lies; what is no number (a back has no normal, hence no cosine) leads to its start."""
    return xp.where(share > 0, xp.minimum(share, 1.0), 0.0) * (TABLE_SIDE - 1)


def probability(sheen: Sheen, base_albedo: Array, n_dot_v: Array) -> Array:
    """How often sampling picks the sheen: its share of a cheap estimate of both albedos, (N,)."""
    share = sheen.strength * albedo(sheen, n_dot_v)
    picked = xp.clip(share / xp.maximum(share + (1 - share) * base_albedo, 1e-7), 0.1, 1.0)
    return xp.where(sheen.strength > 0, picked, 0 * picked)


def pdf(n_dot_l: Array) -> Array:
    """Density of `sample`, 1/sr: even over the hemisphere, as the lobe is wide (Estevez & Kulla 2017, section 5)."""
    value = 1 / (2 * PI) + 0 * n_dot_l
    return xp.where(n_dot_l > 0, value, 0 * value)


def sample(n: Array, u1: Array, u2: Array, vector: Callable) -> Array:
    """A direction above n; `vector` builds a vector from x, y, z."""
    s, t = basis(n, vector)
    sine = xp.sqrt(xp.maximum(1 - u1 * u1, 0.0))
    sin_phi, cos_phi = xp.sincos(2 * PI * u2)
    return xp.normalize(sine * cos_phi * s + sine * sin_phi * t + u1 * n)


@cache
def albedo_table() -> np.ndarray:
    """(32, 32) float64: E over roughness (down) and √(n·v) (across), 0…1, by quadrature of the lobe.

    The root spreads grazing angles, where E bends most. The fit of Λ lets a smooth sheen return up to 2.7 times the
    light at grazing angles; there the table says 1, as a texture of 8 bits would, and nothing is left to the base.
    """
    cosine = np.maximum(np.linspace(0, 1, TABLE_SIDE) ** 2, 1e-3)
    table = [directional_albedo(roughness, cosine) for roughness in np.linspace(0, 1, TABLE_SIDE)]
    return np.minimum(np.stack(table), 1.0)


def directional_albedo(roughness: float, cosine: np.ndarray, rings: int = 48, sectors: int = 24) -> np.ndarray:
    """E of a roughness at cosines (n,), by Gauss's rule in polar angle and even steps over half a turn.

    With 48 × 24 nodes within 6e-4.
    """
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    theta = (nodes + 1) * np.pi / 4
    phi = np.pi * (np.arange(sectors) + 0.5) / sectors
    theta, turn = (a.ravel() for a in np.meshgrid(theta, phi, indexing="ij"))
    solid = np.repeat(weights * np.pi / 4, sectors) * np.sin(theta) * 2 * np.pi / sectors
    light = np.stack([np.sin(theta) * np.cos(turn), np.sin(theta) * np.sin(turn), np.cos(theta)])
    up = np.array([[0.0], [0.0], [1.0]])
    white = Sheen(np.ones((3, 1)), np.full(1, roughness), np.zeros(0))
    views = (np.array([[np.sqrt(1 - c * c)], [0.0], [c]]) for c in cosine)
    return np.array([np.sum(lobe(white, up, view, light) * solid) for view in views])
