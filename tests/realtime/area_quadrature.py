"""Radiance reflected from area lights by quadrature in float64: the light's points, weighted, and the optics."""

from itertools import pairwise

import numpy as np

from lightmeter.scenes.optics import material
from lightmeter.scenes.points import SurfacePoints

CHUNK = 2_000_000


def of_polygon(corners: np.ndarray, order: int = 48) -> tuple[np.ndarray, np.ndarray]:
    """Points (N, 3) of a convex polygon and their area vectors (N, 3): Gauss-Legendre over each triangle of a fan."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    nodes, weights = (nodes + 1) / 2, weights / 2
    u, v = np.meshgrid(nodes, nodes, indexing="ij")
    weight = np.outer(weights, weights) * u  # Duffy's map of the square to the triangle: (u, u·v)
    points, areas = [], []
    for b, c in pairwise(corners[1:]):
        a = corners[0]
        places = a + (b - a) * (u * (1 - v))[..., None] + (c - a) * (u * v)[..., None]
        points.append(places.reshape(-1, 3))
        areas.append(weight.reshape(-1, 1) * np.cross(b - a, c - a))
    return np.concatenate(points), np.concatenate(areas)


def reflected(points: SurfacePoints, places: np.ndarray, areas: np.ndarray, radiance, two_sided=False) -> np.ndarray:
    """(n, 3): Σ f(v, l)·(n·l)·L·cos θ·dA/d² at flattened points, of which each sees all of the light.

    Args:
        places, areas: (N, 3) each, of the light.
    """
    out = np.zeros((len(points.position), 3))
    step = max(1, CHUNK // len(places))
    for start in range(0, len(out), step):
        part = slice(start, start + step)

        def columns(array, part=part):
            return array[part].astype(np.float64).T[..., None]

        offset = places.T[:, None] - columns(points.position)
        square = np.sum(offset**2, axis=0)
        towards = offset / np.sqrt(square)
        leaving = -np.sum(towards * areas.T[:, None], axis=0)
        leaving = np.abs(leaving) if two_sided else np.maximum(leaving, 0)
        shaded = material.MaterialPoint(
            columns(points.base_color),
            *(columns(a[:, None])[0] for a in (points.metallic, points.roughness, points.specular)),
        )
        value = material.evaluate(shaded, columns(points.normal), columns(points.view), towards)
        out[part] = np.sum(value * (leaving / square), axis=-1).T * radiance
    return out
