"""GGX with two roughnesses, as KHR_materials_anisotropy defines it: α_t = mix(α, 1, s²) along the grain, α_b = α else.

The extension's D_GGX_anisotropic and V_GGX_anisotropic: GGX stretched along the grain (Burley 2012, Physically Based
Shading at Disney, on anisotropy), with height-correlated Smith masking of its slopes (Heitz 2014, eq. 99).
"""

from dataclasses import dataclass

from . import arrays as xp
from .arrays import Array

PI = 3.141592653589793


@dataclass(frozen=True)
class Grain:
    """The grain at points: `strength` (N,), 0…1; `direction` (3, N), unit, across the normal."""

    strength: Array
    direction: Array


def alphas(grain: Grain, alpha: Array) -> tuple[Array, Array]:
    """GGX's α along the grain and across it, (N,) each: α…1 and α."""
    return xp.mix(alpha, 1.0, grain.strength * grain.strength), alpha


def d_ggx(t_dot_h: Array, b_dot_h: Array, n_dot_h: Array, along: Array, across: Array) -> Array:
    """The distribution of normals, 1/sr, of a half vector's components; 0 below the horizon.

    Args:
        t_dot_h, b_dot_h, n_dot_h: (N,) its components along the grain, across it and along the normal.
        along, across: (N,) α along the grain and across it, above 0.
    """
    x, y = t_dot_h / along, b_dot_h / across
    # The sum is at least |h|² = 1; h is 0 where light comes from straight behind v.
    spread = xp.maximum(x * x + y * y + n_dot_h * n_dot_h, 1e-12)
    value = 1 / (PI * along * across * spread * spread)
    return xp.where(n_dot_h > 0, value, 0 * value)


def stretched(t_dot: Array, b_dot: Array, n_dot: Array, along: Array, across: Array) -> Array:
    """|(α_t·t·v, α_b·b·v, n·v)|: n·v·(1 + 2Λ), of which Smith's masking is made."""
    x, y = along * t_dot, across * b_dot
    return xp.sqrt(x * x + y * y + n_dot * n_dot)


def lobe(grain: Grain, alpha: Array, n: Array, v: Array, l: Array) -> Array:  # noqa: E741 (l: light, as in the field)
    """D·V, (N,) in 1/sr, of unit directions (3, N); `alpha` (N,), across the grain."""
    t, b = grain.direction, xp.cross(n, grain.direction)
    along, across = alphas(grain, alpha)
    h = xp.normalize(v + l)
    d = d_ggx(xp.dot(t, h), xp.dot(b, h), xp.dot(n, h), along, across)
    n_dot_v, n_dot_l = xp.maximum(xp.dot(n, v), 1e-7), xp.maximum(xp.dot(n, l), 1e-7)
    toward_v = n_dot_l * stretched(xp.dot(t, v), xp.dot(b, v), n_dot_v, along, across)
    toward_l = n_dot_v * stretched(xp.dot(t, l), xp.dot(b, l), n_dot_l, along, across)
    return d * (0.5 / xp.maximum(toward_v + toward_l, 1e-30))


def mirrored_density(grain: Grain, alpha: Array, n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """Density over l of light mirrored at a visible normal, 1/sr, as `microfacet.mirrored_density`."""
    t, b = grain.direction, xp.cross(n, grain.direction)
    along, across = alphas(grain, alpha)
    h = xp.normalize(v + l)
    d = d_ggx(xp.dot(t, h), xp.dot(b, h), xp.dot(n, h), along, across)
    n_dot_v = xp.dot(n, v)
    masked = n_dot_v + stretched(xp.dot(t, v), xp.dot(b, v), n_dot_v, along, across)
    return 0.5 / xp.maximum(masked, 1e-30) * d
