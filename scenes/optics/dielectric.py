"""A smooth surface between two dielectrics: Fresnel's equations and Snell's law (Born & Wolf 1999, section 1.5).

`eta` is the index of refraction beyond the surface over that on the viewer's side.
"""

from . import arrays as xp
from .arrays import Array


def cosine_beyond(cosine: Array, eta: Array) -> Array:
    """The refracted direction's cosine to the normal; 0 from the critical angle on."""
    return xp.sqrt(xp.maximum(1 - (1 - cosine * cosine) / (eta * eta), 0.0))


def reflectance(cosine: Array, eta: Array) -> Array:
    """The share of unpolarised light that is mirrored, 1 from the critical angle on.

    Args:
        cosine: of the direction to the viewer with the normal on the viewer's side, 0…1.
    """
    beyond = cosine_beyond(cosine, eta)
    across = (cosine - eta * beyond) / (cosine + eta * beyond)
    along = (eta * cosine - beyond) / (eta * cosine + beyond)
    return xp.where(beyond > 0, 0.5 * (across * across + along * along), 1.0)


def refracted(normal: Array, view: Array, cosine: Array, eta: Array) -> Array:
    """The direction, away from the surface on its far side, of what the viewer sees through it; unit.

    Args:
        normal, view: unit vectors, the normal on the viewer's side; `cosine` is theirs.
    """
    return normal * (cosine / eta - cosine_beyond(cosine, eta)) - view / eta
