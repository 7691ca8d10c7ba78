"""The vertices of all shapes as surface points, in rows, so that they can be lit as pixels are."""

import numpy as np

from lightmeter.scenes.model import Camera, Scene, Shape
from lightmeter.scenes.points import SurfacePoints

from ...geometry import vertex_arrays
from ...projection import viewer

WIDTH = 1024
"""Vertices in a row."""


def vertex_points(scene: Scene) -> tuple[SurfacePoints, dict[int, int]]:
    """(rows, WIDTH) points, with the materials' constants; and each shape's first one, counted row by row.

    The vertices of a shape are in the order of `vertex_arrays`.
    """
    firsts: dict[int, int] = {}
    parts: list[dict[str, np.ndarray]] = []
    total = 0
    for index, shape in enumerate(scene.shapes):
        if not len(shape.mesh.triangles):
            continue
        part = _points(shape, index, scene.camera)
        firsts[index] = total
        total += len(part["position"])
        parts.append(part)
    rows = max(1, -(-total // WIDTH))
    filled = {}
    for name, array in parts[0].items():
        values = np.concatenate([part[name] for part in parts])
        rest = np.full((rows * WIDTH - total, *array.shape[1:]), -1 if name == "shape" else 0, values.dtype)
        filled[name] = np.concatenate([values, rest]).reshape(rows, WIDTH, *array.shape[1:])
    return SurfacePoints(**filled), firsts


def _points(shape: Shape, index: int, camera: Camera) -> dict[str, np.ndarray]:
    """The arrays of `SurfacePoints`, (N, …), for one shape's vertices."""
    arrays, _ = vertex_arrays(shape.world, tangents=False, texcoords=False)
    position, normal, material = arrays["position"], arrays["normal"], shape.material
    count, eye = len(position), viewer(camera)
    view = eye[:3] - eye[3] * position.astype(np.float64)
    view /= np.maximum(np.linalg.norm(view, axis=1, keepdims=True), 1e-300)
    if material.double_sided:
        normal = np.where(np.sum(normal * view, axis=1, keepdims=True) < 0, -normal, normal)
    color = np.tile(np.float32(material.base_color), (count, 1))
    if "color" in arrays:
        color = color * arrays["color"][:, :3]
    scalars = {
        "metallic": material.metallic,
        "roughness": material.roughness,
        "specular": material.specular,
        "occlusion": 1.0,
    }
    return {
        "position": position,
        "normal": normal.astype(np.float32),
        "view": view.astype(np.float32),
        "base_color": color.astype(np.float32),
        "emission": np.zeros((count, 3), np.float32),
        "shape": np.full(count, index, np.int32),
        "triangle": np.zeros(count, np.int32),
    } | {name: np.full(count, value, np.float32) for name, value in scalars.items()}
