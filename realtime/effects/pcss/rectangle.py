"""The rectangle that stands for an emissive surface."""

import math

import numpy as np

from lightmeter.scenes.features import is_flat
from lightmeter.scenes.model import AreaLight, Scene


def half_sides(scene: Scene, light: AreaLight) -> tuple[np.ndarray, np.ndarray, float]:
    """Half sides u, v (3,) of a flat emitter's rectangle, metres; of another emitter half the side of a facing square.

    The rectangle has the emitter's second moments of area, along the sides of the smallest rectangle around it: it is
    the emitter itself where that is a rectangle, and has √¾ of a disk's radius for half a side. What is not flat is
    taken for a sphere of the same second moments, and that for the disk that is seen of it.

    Returns:
        u, v, 0; or zeros and half the square's side.
    """
    mesh = scene.shapes[light.shape].world
    corners = mesh.positions[mesh.triangles].astype(np.float64)
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    areas = np.linalg.norm(faces, axis=1)
    weights = areas / max(areas.sum(), 1e-300)
    centre = weights @ corners.mean(axis=1)
    # Over a triangle E[x·xᵀ] is (Σ vᵢ·vᵢᵀ + 9·m·mᵀ)/12, with m the mean of its corners.
    offsets, middles = corners - centre, corners.mean(axis=1) - centre
    moments = np.einsum("t,tci,tcj->ij", weights, offsets, offsets) / 12
    moments += 9 / 12 * np.einsum("t,ti,tj->ij", weights, middles, middles)
    if not is_flat(scene.shapes[light.shape]):
        return np.zeros(3), np.zeros(3), math.sqrt(0.75 * np.trace(moments))
    normal = faces.sum(axis=0) / max(np.linalg.norm(faces.sum(axis=0)), 1e-300)
    u, v = _sides(offsets.reshape(-1, 3), normal)
    # A rectangle's variance along a side is a third of half the side, squared.
    return u * math.sqrt(3 * u @ moments @ u), v * math.sqrt(3 * v @ moments @ v), 0.0


def _sides(points: np.ndarray, normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit directions of the sides of the smallest rectangle around points of a plane.

    It has a side in common with their convex hull (Freeman & Shapira 1975).
    """
    from scipy.spatial import ConvexHull

    first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    basis = np.stack([first, np.cross(normal, first)]) / np.linalg.norm(first)
    flat = points @ basis.T
    hull = flat[ConvexHull(flat).vertices]
    edges = np.roll(hull, -1, axis=0) - hull
    edges /= np.linalg.norm(edges, axis=1, keepdims=True)
    along, across = hull @ edges.T, hull @ np.stack([-edges[:, 1], edges[:, 0]])
    side = edges[np.argmin(np.ptp(along, axis=0) * np.ptp(across, axis=0))]
    u = side @ basis
    return u, np.cross(normal, u)
