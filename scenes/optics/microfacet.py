"""Microfacets: distributions of normals, masking and shadowing, Schlick's Fresnel, sampling of visible normals.

The material is GGX with height-correlated Smith (`material.py`); the other distributions and maskings are what
real-time renderers put in their place. `alpha` is the square of glTF's perceptual roughness. Cosines outside their
range give 0 where a comment says so.
"""

from collections.abc import Callable

from . import arrays as xp
from .arrays import Array
from .frames import basis

PI = 3.141592653589793
MIN_ALPHA = 1e-3
"""The smallest α either side evaluates: below it a lobe is narrower than float32 resolves (design, section 3)."""


def alpha_from_roughness(roughness: Array) -> Array:
    """α = max(roughness², 1e-3) (Burley 2012, section 5.4; glTF 2.0, B.2.3)."""
    return xp.maximum(roughness * roughness, MIN_ALPHA)


def half_cosines(n: Array, v: Array, l: Array) -> tuple[Array, Array, Array]:  # noqa: E741 (l: light, as in the field)
    """n·h, |n × h|² and v·h of the half vector h between v and l; all 0 where l = −v."""
    h = xp.normalize(v + l)
    n_cross_h = xp.cross(n, h)
    return xp.dot(n, h), xp.dot(n_cross_h, n_cross_h), xp.dot(v, h)


def d_ggx(n_dot_h: Array, sin2_h: Array, alpha: Array) -> Array:
    """GGX distribution of normals, 1/sr (Walter et al. 2007, eq. 33); 0 below the horizon.

    `sin2_h` is |n × h|². The textbook's cos²θ·(α²−1)+1 cancels for small α; cos²θ·α² + sin²θ with the sine taken
    from the cross product does not (as Filament's D_GGX does for half floats).
    """
    # The divisor is at least α² ≥ 1e-6 for a unit h; h is 0 where light comes from straight behind v.
    k = alpha / xp.maximum(n_dot_h * n_dot_h * alpha * alpha + sin2_h, 1e-12)
    return xp.where(n_dot_h > 0, k * k * (1 / PI), 0 * k)


def cosine_power(cosine: Array, sin2: Array, exponent: Array) -> Array:
    """cosᵉ of an angle, given its cosine and squared sine; 0 for a negative cosine.

    Near 1 the logarithm of a rounded cosine has lost its digits: there it is a series in the squared sine.
    """
    series = -0.5 * sin2 * (1 + sin2 * (1 / 2 + sin2 * (1 / 3 + sin2 * (1 / 4))))
    logarithm = xp.where(sin2 < 1 / 64, series, xp.log(xp.maximum(cosine, 1e-30)))
    return xp.where(cosine > 0, xp.exp(exponent * logarithm), 0 * logarithm)


def blinn_exponent(alpha: Array) -> Array:
    """The exponent of n·h whose lobe is as high as GGX's, 1/(π·α²) (Walter et al. 2007, section 5.2)."""
    return 2 / (alpha * alpha) - 2


def d_beckmann(n_dot_h: Array, sin2_h: Array, alpha: Array) -> Array:
    """Beckmann's distribution of normals, 1/sr (Walter et al. 2007, eq. 25); 0 below the horizon."""
    cosine2 = xp.maximum(n_dot_h * n_dot_h, 1e-14)
    a2 = alpha * alpha
    value = xp.exp(-sin2_h / (cosine2 * a2)) / (PI * a2 * cosine2 * cosine2)
    return xp.where(n_dot_h > 0, value, 0 * value)


def d_blinn(n_dot_h: Array, sin2_h: Array, alpha: Array) -> Array:
    """Blinn's power of the cosine as a distribution, 1/sr (Walter et al. 2007, eq. 30); 0 below the horizon."""
    exponent = blinn_exponent(alpha)
    return (exponent + 2) / (2 * PI) * cosine_power(n_dot_h, sin2_h, exponent)


def v_smith_ggx_correlated(n_dot_v: Array, n_dot_l: Array, alpha: Array) -> Array:
    """G/(4·n·v·n·l) with height-correlated Smith masking-shadowing (Heitz 2014, eq. 99). Cosines > 0."""
    a2 = alpha * alpha
    lambda_v = n_dot_l * xp.sqrt(n_dot_v * n_dot_v * (1 - a2) + a2)
    lambda_l = n_dot_v * xp.sqrt(n_dot_l * n_dot_l * (1 - a2) + a2)
    return 0.5 / xp.maximum(lambda_v + lambda_l, 1e-30)


def v_smith_ggx_separable(n_dot_v: Array, n_dot_l: Array, alpha: Array) -> Array:
    """G1(v)·G1(l)/(4·n·v·n·l): Smith's masking and shadowing as if independent (Walter et al. 2007, eq. 23, 34)."""
    a2 = alpha * alpha
    toward_v = n_dot_v + xp.sqrt(n_dot_v * n_dot_v * (1 - a2) + a2)
    toward_l = n_dot_l + xp.sqrt(n_dot_l * n_dot_l * (1 - a2) + a2)
    return 1 / (toward_v * toward_l)


def v_schlick(n_dot_v: Array, n_dot_l: Array, k: Array) -> Array:
    """G1(v)·G1(l)/(4·n·v·n·l) with Schlick's rational G1 = c/(c·(1 − k) + k) (Schlick 1994, eq. 19)."""
    return 0.25 / ((n_dot_v * (1 - k) + k) * (n_dot_l * (1 - k) + k))


def v_schlick_half(n_dot_v: Array, n_dot_l: Array, alpha: Array) -> Array:
    """Schlick's masking with k = α/2, nearest to Smith's for GGX (Karis 2013, Real Shading in Unreal Engine 4)."""
    return v_schlick(n_dot_v, n_dot_l, 0.5 * alpha)


def v_schlick_remapped(n_dot_v: Array, n_dot_l: Array, alpha: Array) -> Array:
    """Schlick's masking with k = (roughness + 1)²/8, for analytic lights (Karis 2013; Burley's remapping)."""
    widened = xp.sqrt(alpha) + 1
    return v_schlick(n_dot_v, n_dot_l, widened * widened * (1 / 8))


def v_smith_ggx_fast(n_dot_v: Array, n_dot_l: Array, alpha: Array) -> Array:
    """Height-correlated Smith without roots (Hammon 2017, PBR Diffuse Lighting for GGX+Smith; Filament's fast V)."""
    return 0.5 / xp.maximum(xp.mix(2 * n_dot_l * n_dot_v, n_dot_l + n_dot_v, alpha), 1e-30)


def v_implicit(_n_dot_v: Array, _n_dot_l: Array, alpha: Array) -> Array:
    """G = n·v·n·l, which the divisor takes away (Hoffman 2010, Crafting Physically Motivated Shading Models)."""
    return 0.25 + 0 * alpha


def f_schlick(v_dot_h: Array, f0: Array, f90: Array) -> Array:
    """Fresnel reflectance (Schlick 1994, eq. 15) between f0 and f90."""
    m = xp.clip(1 - v_dot_h, 0.0, 1.0)
    m2 = m * m
    return f0 + (f90 - f0) * (m2 * m2 * m)


def sample_visible_normal(
    v: Array, alpha: Array, u1: Array, u2: Array, vector: Callable, alpha_y: Array | None = None
) -> Array:
    """A microfacet normal seen from v, with density D_v = G1·max(0, v·h)·D/(n·v) (Heitz 2018, listing 1).

    v is in the local frame (n = +z, v.z > 0). `vector` builds a vector from x, y, z (Dr.Jit's
    `Vector3f`; in NumPy `lambda *c: np.stack(c)`). `alpha_y` is α along y where it is another than along x.
    """
    alpha_y = alpha if alpha_y is None else alpha_y
    vh = xp.normalize(vector(alpha * v[0], alpha_y * v[1], v[2]))
    length2 = vh[0] * vh[0] + vh[1] * vh[1]
    inverse = xp.where(length2 > 0, 1 / xp.sqrt(xp.maximum(length2, 1e-38)), 0 * length2)
    flat = length2 > 0
    zero = 0 * inverse
    t1 = vector(xp.where(flat, -vh[1] * inverse, 1 + zero), xp.where(flat, vh[0] * inverse, zero), zero)
    t2 = xp.cross(vh, t1)
    radius = xp.sqrt(u1)
    sin_phi, cos_phi = xp.sincos(2 * PI * u2)
    p1 = radius * cos_phi
    s = 0.5 * (1 + vh[2])
    p2 = (1 - s) * xp.sqrt(xp.maximum(1 - p1 * p1, 0.0)) + s * (radius * sin_phi)
    p3 = xp.sqrt(xp.maximum(1 - p1 * p1 - p2 * p2, 0.0))
    nh = p1 * t1 + p2 * t2 + p3 * vh
    return xp.normalize(vector(alpha * nh[0], alpha_y * nh[1], xp.maximum(nh[2], 1e-6)))


def mirrored_density(n_dot_v: Array, d: Array, alpha: Array) -> Array:
    """Density over l of light mirrored at a visible normal of GGX, 1/sr: G1·D/(4·n·v) (Heitz 2018, eq. 17).

    It is the density of visible normals over h, times dh/dl = 1/(4·v·h).

    Args:
        d: D at the half vector.
    """
    a2 = alpha * alpha
    g1_over_4nv = 0.5 / xp.maximum(n_dot_v + xp.sqrt(n_dot_v * n_dot_v * (1 - a2) + a2), 1e-30)
    return g1_over_4nv * d


def sample_mirrored(n: Array, v: Array, alpha: Array, u1: Array, u2: Array, vector: Callable) -> Array:
    """A direction with density `mirrored_density`; may fall below the horizon. `vector` builds one from x, y, z."""
    s, t = basis(n, vector)
    local_v = vector(xp.dot(s, v), xp.dot(t, v), xp.maximum(xp.dot(n, v), 1e-6))
    h = sample_visible_normal(local_v, alpha, u1, u2, vector)
    local = 2 * xp.dot(local_v, h) * h - local_v
    return xp.normalize(local[0] * s + local[1] * t + local[2] * n)
