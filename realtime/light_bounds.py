"""The part of the picture that a light with a range can reach, so that its passes draw no more."""

import math

import numpy as np

from lightmeter.scenes.model import Camera, Light, PointLight, SpotLight

from .projection import projection_matrix, view_matrix

MARGIN = 1
"""Pixels beyond the sphere's edge: a sample's offset is below half of one, and so is rounding."""

Rectangle = tuple[int, int, int, int]
"""Left, bottom, width, height in pixels, rows counted from the bottom as OpenGL does."""


def reached(camera: Camera, size: tuple[int, int], light: Light) -> Rectangle | None:
    """The smallest rectangle that holds the sphere of a light's range; the whole picture for a light without one.

    After Mara & McGuire 2013, 2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere, section 3: along
    each axis the sphere is a circle, seen between two tangents.

    Returns:
        The rectangle, or None where nothing of it is in the picture.
    """
    if not isinstance(light, PointLight | SpotLight) or light.range is None:
        return 0, 0, *size
    x, y, z = (view_matrix(camera) @ np.append(light.position, 1.0))[:3]
    if -z + light.range <= camera.near or -z - light.range >= camera.far:
        return None
    projection = projection_matrix(camera, size)
    sides = []
    for along, scale, pixels in ((x, projection[0, 0], size[0]), (y, projection[1, 1], size[1])):
        if camera.yfov is None:
            low, high = along - light.range, along + light.range
        else:
            bounds = _tangents(along, -z, light.range)
            if bounds is None:
                return None
            low, high = bounds
        first, last = ((scale * bound + 1) / 2 * pixels for bound in (low, high))
        start = int(max(0.0, math.floor(max(first, -1e9)) - MARGIN))
        end = int(min(float(pixels), math.ceil(min(last, 1e9)) + MARGIN))
        if start >= end:
            return None
        sides.append((start, end - start))
    (left, width), (bottom, height) = sides
    return left, bottom, width, height


def _tangents(along: float, depth: float, radius: float) -> tuple[float, float] | None:
    """Lowest and highest slope along/depth at which a circle is seen from the origin; None where it lies behind."""
    distance = math.hypot(along, depth)
    if distance <= radius:
        return -math.inf, math.inf
    middle, half = math.atan2(along, depth), math.asin(radius / distance)
    low, high = max(middle - half, -math.pi / 2), min(middle + half, math.pi / 2)
    if low >= high:
        return None
    return (
        -math.inf if low <= -math.pi / 2 else math.tan(low),
        math.inf if high >= math.pi / 2 else math.tan(high),
    )
