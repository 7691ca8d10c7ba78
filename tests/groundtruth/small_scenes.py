"""Scenes of a few triangles, made in the tests that use them."""

import math

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.model import Camera, Material, Mesh, Scene, Shape
from lightmeter.scenes.points import SurfacePoints

WHITE = Material(base_color=(1, 1, 1), specular=0)


def looking(position, target, *, yfov=None, ymag=None, up=(0, 1, 0)) -> Camera:
    """A camera at `position` that looks at `target`."""
    back = np.subtract(position, target).astype(float)
    back /= np.linalg.norm(back)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([right, np.cross(back, right), back], axis=1)
    matrix[:3, 3] = position
    return Camera("camera", matrix, yfov=yfov, ymag=ymag)


def placed(x=0.0, y=0.0, z=0.0) -> np.ndarray:
    """A translation."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def rectangle(corner, across, up) -> Mesh:
    """A rectangle whose front is where `across` × `up` points; texture origin at the top left."""
    corner, across, up = (np.asarray(v, float) for v in (corner, across, up))
    positions = np.stack([corner, corner + across, corner + across + up, corner + up])
    texcoords = np.array([[0, 1], [1, 1], [1, 0], [0, 0]])
    return Mesh(positions, np.array([[0, 1, 2], [0, 2, 3]]), None, (texcoords,))


def floor(half=1.0, y=0.0) -> Mesh:
    """A square that looks up."""
    return rectangle((-half, y, half), (2 * half, 0, 0), (0, 0, -2 * half))


def inside_out(mesh: Mesh) -> Mesh:
    """The mesh without vertex normals, its fronts turned inwards."""
    return Mesh(mesh.positions, mesh.triangles[:, ::-1], None, mesh.texcoords)


def hollow_sphere(material: Material, segments=128, **scene) -> Scene:
    """The inside of a flat-shaded unit sphere, with a camera at its centre."""
    ball = Shape("ball", inside_out(shapes.sphere(1.0, segments)), material)
    return Scene("hollow", (ball,), looking((0, 0, 0), (0.3, 0.2, -1), yfov=math.radians(90)), **scene)


def points_at(positions, normal, view, *, shape=0, triangle=0, material=WHITE) -> SurfacePoints:
    """(1, N) points of one material, all with one normal and one view."""
    positions = np.asarray(positions, np.float32).reshape(1, -1, 3)
    count = positions.shape[1]

    def row(value):
        return np.full((1, count), value, np.float32)

    def rows(value):
        unit = np.asarray(value, float) / max(np.linalg.norm(value), 1e-30)
        return np.broadcast_to(unit.astype(np.float32), (1, count, 3)).copy()

    return SurfacePoints(
        position=positions,
        normal=rows(normal),
        view=rows(view),
        base_color=np.broadcast_to(np.float32(material.base_color), (1, count, 3)).copy(),
        metallic=row(material.metallic),
        roughness=row(material.roughness),
        specular=row(material.specular),
        occlusion=row(1),
        emission=np.zeros((1, count, 3), np.float32),
        shape=np.full((1, count), shape, np.int32),
        triangle=np.full((1, count), triangle, np.int32),
    )
