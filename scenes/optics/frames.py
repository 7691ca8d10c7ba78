"""Local frames: an orthonormal basis about a normal, and MikkTSpace's frame for normal maps."""

from . import arrays as xp
from .arrays import Array


def tangent_to_world(tangent: Array, bitangent_sign: Array, normal: Array, mapped: Array) -> Array:
    """A normal-map vector in world space: normalize(x·t + y·b + z·n), b = sign·(n × t) (Mikkelsen 2008).

    Normal and tangent are interpolated and not renormalised, as MikkTSpace asks of a pixel shader.
    """
    bitangent = bitangent_sign * xp.cross(normal, tangent)
    return xp.normalize(mapped[0] * tangent + mapped[1] * bitangent + mapped[2] * normal)


def decode_normal(texel: Array, scale: Array, vector) -> Array:
    """A normal map's vector from a texel in 0…1: 2·t − 1, x and y times the scale (glTF 2.0, 3.9.3)."""
    return vector((2 * texel[0] - 1) * scale, (2 * texel[1] - 1) * scale, 2 * texel[2] - 1)


def along_grain(
    tangent: Array, bitangent_sign: Array, normal: Array, shading_normal: Array, x: Array, y: Array, vector
) -> Array:
    """The unit direction x·t + y·b of MikkTSpace's frame, laid across the shading normal.

    Where nothing of it is left (no tangent, or one along the normal), the first axis of `basis`.
    """
    direction = x * tangent + y * bitangent_sign * xp.cross(normal, tangent)
    direction = direction - xp.dot(direction, shading_normal) * shading_normal
    there = xp.dot(direction, direction) > 1e-12
    return xp.normalize(xp.where(there, direction, basis(shading_normal, vector)[0]))


def basis(n: Array, vector) -> tuple[Array, Array]:
    """Two unit vectors that make a right-handed orthonormal frame (s, t, n) (Duff et al. 2017, listing 3)."""
    sign = xp.where(n[2] >= 0, 1.0 + 0 * n[2], -1.0 + 0 * n[2])
    a = -1 / (sign + n[2])
    b = n[0] * n[1] * a
    s = vector(1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0])
    t = vector(b, sign + n[1] * n[1] * a, -n[1])
    return s, t
