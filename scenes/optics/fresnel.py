"""Fresnel's equations for unpolarised light: dielectrics, conductors, and the indices that a reflectance stands for.

Outside is a vacuum. Schlick's approximation is in `microfacet.py`.
"""

from . import arrays as xp
from .arrays import Array

BRIGHTEST_F0 = 0.9999
"""An index is finite up to here: a perfect mirror has none."""


def f_dielectric(cosine: Array, index: Array) -> Array:
    """Reflectance of a dielectric, 0…1 (Walter et al. 2007, eq. 22).

    Args:
        cosine: of the angle between ray and normal; held within 0…1.
        index: real refractive index, at least 1.
    """
    c = xp.clip(cosine, 0.0, 1.0)
    g = xp.sqrt(xp.maximum(index * index - 1 + c * c, 0.0))
    # Where both vanish (index 1 at grazing incidence) there is no surface: the guard makes 0 of 0/0.
    across = (g - c) / xp.maximum(g + c, 1e-20)
    along = (c * (g + c) - 1) / (c * (g - c) + 1)
    return 0.5 * across * across * (1 + along * along)


def f_conductor(cosine: Array, n: Array, k: Array) -> Array:
    """Reflectance of a conductor of complex index n + ik, 0…1 (Born & Wolf 1999, section 14.2; Lagarde 2013).

    Args:
        cosine: of the angle between ray and normal; held within 0…1.
        n, k: real part, above 0, and extinction coefficient, at least 0.
    """
    c = xp.clip(cosine, 0.0, 1.0)
    c2 = c * c
    s2 = 1 - c2
    # (a + ib)² = (n + ik)² − sin². Of a² and b² the larger is a sum; the smaller would cancel as a difference.
    difference = (n - 1) * (n + 1) - k * k + c2
    product = n * k
    size = xp.sqrt(difference * difference + 4 * product * product)
    larger = 0.5 * (size + xp.maximum(difference, -difference))
    smaller = product * product / xp.maximum(larger, 1e-20)
    a2, b2 = xp.where(difference > 0, larger, smaller), xp.where(difference > 0, smaller, larger)
    a = xp.sqrt(a2)
    across = ((a - c) * (a - c) + b2) / xp.maximum((a + c) * (a + c) + b2, 1e-20)
    below, above = a * c - s2, a * c + s2
    along = (below * below + b2 * c2) / xp.maximum(above * above + b2 * c2, 1e-20)
    return 0.5 * across * (1 + along)


def index_of(f0: Array) -> Array:
    """The real refractive index whose reflectance at normal incidence is f0: (1 + √f0)/(1 − √f0)."""
    root = xp.sqrt(xp.minimum(f0, BRIGHTEST_F0))
    return (1 + root) / (1 - root)


def complex_index_of(f0: Array, edge_tint: Array) -> tuple[Array, Array]:
    """n and k whose reflectance at normal incidence is f0 (Gulbrandsen 2014, Artist Friendly Metallic Fresnel).

    Args:
        f0: 0…1.
        edge_tint: which of the indices with that f0: 0 is the largest n (k = 0, a dielectric), 1 the smallest.
    """
    root = xp.sqrt(xp.minimum(f0, BRIGHTEST_F0))
    square = root * root
    n = xp.mix((1 + root) / (1 - root), (1 - square) / (1 + square), edge_tint)
    # His k² = (f0·(n + 1)² − (n − 1)²)/(1 − f0), with the factor that vanishes for edge_tint = 0 taken out.
    k2 = 2 * edge_tint * root * (root * (n + 1) + n - 1) / ((1 - root) * (1 + square))
    return n, xp.sqrt(xp.maximum(k2, 0.0))
