"""Points on an emissive shape, evenly by area, in sets that are each well spread."""

import numpy as np

from lightmeter.scenes.model import Shape
from lightmeter.scenes.optics.texture import look_up

from ...points_on_meshes import points_on_mesh

ROBERTS = 0.7548776662466927, 0.5698402909980532
"""1/p and 1/p² with p³ = p + 1: the plane's R sequence (Roberts 2018, The Unreasonable Effectiveness of Quasirandom
Sequences)."""


def light_points(shape: Shape, count: int, sets: int) -> np.ndarray:
    """(sets, 3·count, 3) float64: for each point position, front's normal and radiance · area / count.

    In each set the k-th point's first coordinate lies in the k-th of `count` strata of the area; sets differ by a shift
    modulo 1 (Cranley & Patterson 1976).
    """
    shifts = np.outer(np.arange(1, sets + 1), ROBERTS) % 1
    index = np.arange(count)
    x = (index + shifts[:, :1]) / count
    y = (index * (0.5 * (np.sqrt(5) - 1)) + shifts[:, 1:]) % 1
    triangle, b1, b2, area, normals = points_on_mesh(shape.world, x.ravel(), y.ravel())
    corners = shape.world.positions[shape.world.triangles[triangle]].astype(np.float64)
    weights = np.stack([1 - b1 - b2, b1, b2], axis=1)[..., None]
    positions = np.sum(weights * corners, axis=1)
    radiance = _radiance(shape, triangle, weights) * (area / count)
    return np.stack([positions, normals[triangle], radiance], axis=1).reshape(sets, 3 * count, 3)


def _radiance(shape: Shape, triangle: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """(n, 3) what leaves the front there: through the emissive texture, and nothing in a mask's holes."""
    material, mesh = shape.material, shape.world

    def texel(texture) -> np.ndarray:
        corners = mesh.texcoords[texture.texcoord][mesh.triangles[triangle]].astype(np.float64)
        return look_up(texture, *np.sum(weights * corners, axis=1).T).T

    out = np.broadcast_to(np.array(material.emissive, dtype=np.float64), (len(triangle), 3))
    if material.emissive_texture is not None:
        out = out * texel(material.emissive_texture)[:, :3]
    if material.alpha_mode == "mask":
        alpha = np.full(len(triangle), material.alpha)
        if material.base_color_texture is not None:
            alpha = alpha * texel(material.base_color_texture)[:, 3]
        if mesh.colors is not None:
            alpha = alpha * np.sum(weights[..., 0] * mesh.colors[mesh.triangles[triangle], 3], axis=1)
        out = np.where((alpha >= material.alpha_cutoff)[:, None], out, 0.0)
    return out
