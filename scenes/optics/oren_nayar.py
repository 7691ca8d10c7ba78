"""Rough matt surfaces of V-shaped Lambertian grooves: Oren & Nayar 1994, and energy-preserving forms of it.

Every form takes the reflectance ρ (3, N) of the grooves' sides, the spread of their slopes, and the directions n, v and
l (3, N), and gives f·(n·l) in 1/sr, 0 where light or viewer is behind the surface. At spread 0 each is Lambert's.
"""

from . import arrays as xp
from .arrays import Array

PI = 3.141592653589793
MEAN_1 = 0.5 - 2 / (3 * PI)
MEAN_2 = 2 / 3 - 28 / (15 * PI)


def _lit(n: Array, v: Array, l: Array, value: Array) -> Array:  # noqa: E741 (l: light, as in the field)
    n_dot_l = xp.dot(n, l)
    return xp.where((xp.dot(n, v) > 0) & (n_dot_l > 0), value * n_dot_l, 0 * value)


def _along(n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """sin θᵥ·sin θₗ·cos φ: how far light and viewer lean the same way. v·l − (n·v)(n·l) without its cancellation."""
    return xp.dot(xp.cross(n, v), xp.cross(n, l))


def grooves(rho: Array, sigma: Array, angles: Array, sines: Array, cosines: Array, cos_phi: Array) -> Array:
    """Light once and twice reflected by the grooves, over n·l (Oren & Nayar 1994, eq. 30 and 31).

    Args:
        sigma: standard deviation of the grooves' angles, radians.
        angles, sines, cosines: (2, N), of the angles from n to v and to l.
        cos_phi: of the angle from v to l about n.
    """
    flat = xp.minimum(angles[0], angles[1])
    s2 = sigma * sigma
    tan_flat = xp.minimum(sines[0], sines[1]) / xp.maximum(cosines[0], cosines[1])
    # tan of half the sum of two angles is the sum of the sines over that of the cosines.
    tan_mean = (sines[0] + sines[1]) / (cosines[0] + cosines[1])
    backward = 2 * flat * (1 / PI)
    c1 = 1 - 0.5 * s2 / (s2 + 0.33)
    opposed = xp.where(cos_phi < 0, backward * backward * backward, 0 * backward)
    c2 = 0.45 * s2 / (s2 + 0.09) * (xp.maximum(sines[0], sines[1]) - opposed)
    both = 4 * angles[0] * angles[1] * (1 / (PI * PI))
    c3 = 0.125 * s2 / (s2 + 0.09) * (both * both)
    aside = xp.maximum(1 - xp.maximum(cos_phi, -cos_phi), 0.0)
    once = c1 + cos_phi * c2 * tan_flat + aside * c3 * tan_mean
    twice = 0.17 * s2 / (s2 + 0.13) * (1 - cos_phi * backward * backward)
    # Negative where both graze from opposite sides.
    return rho * (1 / PI) * xp.maximum(once + rho * twice, 0.0)


def full(rho: Array, sigma: Array, n: Array, v: Array, l: Array) -> Array:  # noqa: E741 (l: light, as in the field)
    """The full model with one interreflection.

    Args:
        sigma: standard deviation of the grooves' angles, radians.
    """
    cosines = xp.maximum(xp.dot(n, v), 1e-7), xp.maximum(xp.dot(n, l), 1e-7)
    n_cross_v, n_cross_l = xp.cross(n, v), xp.cross(n, l)
    sines = xp.sqrt(xp.dot(n_cross_v, n_cross_v)), xp.sqrt(xp.dot(n_cross_l, n_cross_l))
    angles = xp.arctan2(sines[0], cosines[0]), xp.arctan2(sines[1], cosines[1])
    cos_phi = xp.dot(n_cross_v, n_cross_l) / xp.maximum(sines[0] * sines[1], 1e-14)
    return _lit(n, v, l, grooves(rho, sigma, angles, sines, cosines, cos_phi))


def qualitative(rho: Array, sigma: Array, n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """The short form without interreflections (Oren & Nayar 1994, eq. 32).

    Args:
        sigma: standard deviation of the grooves' angles, radians.
    """
    s2 = sigma * sigma
    a, b = 1 - 0.5 * s2 / (s2 + 0.33), 0.45 * s2 / (s2 + 0.09)
    along = _along(n, v, l)
    # cos φ·sin α·tan β, where light and viewer lean the same way.
    toward = xp.maximum(along, 0.0) / xp.maximum(xp.maximum(xp.dot(n, v), xp.dot(n, l)), 1e-7)
    return _lit(n, v, l, rho * (1 / PI) * (a + b * toward))


def fujii(rho: Array, roughness: Array, n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """Fujii's form, without the dark ring of the short one (Fujii 2012, A Tiny Improvement of Oren-Nayar).

    Args:
        roughness: 0…1.
    """
    along = _along(n, v, l)
    facing = xp.maximum(xp.maximum(xp.dot(n, v), xp.dot(n, l)), 1e-7)
    toward = xp.where(along > 0, along / facing, along)
    return _lit(n, v, l, rho * (1 / PI) / (1 + MEAN_1 * roughness) * (1 + roughness * toward))


def fujii_albedo(cosine: Array, roughness: Array) -> Array:
    """What `fujii` returns of light from one direction for ρ = 1, 0…1 (Portsmouth, Kutz & Hill 2024, listing 1, exact).

    Args:
        cosine: of the direction to the normal, above 0.
        roughness: 0…1.
    """
    sine = xp.sqrt(xp.maximum(1 - cosine * cosine, 0.0))
    angle = xp.arctan2(sine, cosine)
    g = sine * (angle - sine * cosine) + 2 / 3 * (sine / cosine * (1 - sine * sine * sine) - sine)
    return (1 + roughness * (g * (1 / PI))) / (1 + MEAN_1 * roughness)


def fujii_albedo_fit(cosine: Array, roughness: Array) -> Array:
    """The polynomial fit of `fujii_albedo` (Portsmouth, Kutz & Hill 2024, listing 1, approximate): to 1e-3."""
    m = 1 - cosine
    g = m * (0.0571085289 + m * (0.491881867 + m * (-0.332181442 + m * 0.0714429953)))
    return (1 + roughness * g) / (1 + MEAN_1 * roughness)


def eon(rho: Array, roughness: Array, n: Array, v: Array, l: Array, albedo=fujii_albedo) -> Array:  # noqa: E741
    """Fujii's form and a lobe of what bounces between the grooves: a white surface loses nothing (EON, Portsmouth, Kutz
    & Hill 2024, EON: A Practical Energy-Preserving Rough Diffuse BRDF, listing 1).

    Args:
        roughness: 0…1.
        albedo: `fujii_albedo`, or its fit as shaders use it.
    """
    mean = (1 + MEAN_2 * roughness) / (1 + MEAN_1 * roughness)
    again = rho * rho * mean / (1 - rho * (1 - mean))
    # 1 − E is 0 for a smooth surface, where the fit and rounding may make it negative.
    lost_v = xp.maximum(1 - albedo(xp.maximum(xp.dot(n, v), 1e-7), roughness), 1e-7)
    lost_l = xp.maximum(1 - albedo(xp.maximum(xp.dot(n, l), 1e-7), roughness), 1e-7)
    lobe = again * (1 / PI) * lost_v * lost_l / xp.maximum(1 - mean, 1e-7)
    return fujii(rho, roughness, n, v, l) + _lit(n, v, l, lobe)
