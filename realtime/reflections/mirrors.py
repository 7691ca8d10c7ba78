"""Which shapes mirror, and where."""

from dataclasses import dataclass

import numpy as np

from lightmeter.scenes.features import is_flat
from lightmeter.scenes.model import Material, Scene, Shape

from ..projection import viewer

SMOOTH = 0.1
"""Roughness up to which a surface counts as a mirror: its lobe is about a degree wide."""


def mirrors_at_all(material: Material) -> bool:
    """Whether the material has a specular lobe."""
    return material.metallic > 0 or material.specular > 0


def nothing_mirrors(scene: Scene) -> str:
    """Why a scene needs no reflections; "" where some surface has a specular lobe."""
    return "" if any(mirrors_at_all(shape.material) for shape in scene.shapes) else "no surface has a specular lobe"


def is_smooth(shape: Shape) -> bool:
    """Whether a shape is a smooth mirror, as far as its material's factors say."""
    return mirrors_at_all(shape.material) and shape.material.roughness <= SMOOTH and len(shape.mesh.triangles) > 0


@dataclass(frozen=True, eq=False)
class FlatMirror:
    """A flat smooth shape.

    Attributes:
        shape: its index.
        plane: (4,) float64: unit normal of its front, and minus its distance from the origin along it.
        area: m².
    """

    shape: int
    plane: np.ndarray
    area: float


def flat_mirrors(scene: Scene) -> tuple[FlatMirror, ...]:
    """The scene's flat mirrors whose fronts face the camera, the largest first."""
    found = []
    for index, shape in enumerate(scene.shapes):
        if not is_smooth(shape) or not is_flat(shape):
            continue
        mesh = shape.world
        a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
        faces = np.cross(b - a, c - a) / 2
        area = float(np.linalg.norm(faces, axis=1).sum())
        if area > 0:
            normal = faces.sum(axis=0) / np.linalg.norm(faces.sum(axis=0))
            plane = np.append(normal, -normal @ a.mean(axis=0))
            if plane @ viewer(scene.camera) > 0:
                found.append(FlatMirror(index, plane, area))
    return tuple(sorted(found, key=lambda mirror: -mirror.area))


def mirroring_shapes(scene: Scene) -> tuple[int, ...]:
    """The smooth shapes that are not flat, those with the largest boxes first."""
    sizes = {}
    for index, shape in enumerate(scene.shapes):
        if is_smooth(shape) and not is_flat(shape):
            low, high = box_of(shape)
            sizes[index] = float(np.linalg.norm(high - low))
    return tuple(sorted(sizes, key=lambda index: -sizes[index]))


def box_of(shape: Shape) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest corner of a shape, (3,) float64 each."""
    positions = shape.world.positions.astype(np.float64)
    return positions.min(axis=0), positions.max(axis=0)


def reflection(plane: np.ndarray) -> np.ndarray:
    """(4, 4) that mirrors points at a plane (unit normal, minus its distance)."""
    matrix = np.eye(4)
    matrix[:3, :3] -= 2 * np.outer(plane[:3], plane[:3])
    matrix[:3, 3] = -2 * plane[3] * plane[:3]
    return matrix


def clipped_at(projection: np.ndarray, plane: np.ndarray) -> np.ndarray:
    """A projection whose near plane is another one (Lengyel 2005, Oblique View Frustum Depth Projection and Clipping).

    Args:
        projection: (4, 4) camera to clip space.
        plane: (4,) in camera space; what lies where its value is positive is kept.
    """
    out = projection.copy()
    # The corner of the frustum that lies farthest in front of the plane stays on the far plane: eq. 7.
    corner = np.linalg.inv(projection) @ np.array([np.sign(plane[0]) or 1.0, np.sign(plane[1]) or 1.0, 1.0, 1.0])
    scaled = plane * (2 * (projection[3] @ corner) / (plane @ corner))
    out[2] = scaled - projection[3]
    return out
