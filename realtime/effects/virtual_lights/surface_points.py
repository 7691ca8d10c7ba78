"""Points all over the scene's surfaces, where light is scattered a second time."""

import numpy as np

from lightmeter.scenes.emitters import shines_back, surface_area
from lightmeter.scenes.model import Scene, Shape
from lightmeter.scenes.optics.texture import look_up

from ...points_on_meshes import points_on_mesh

GOLDEN = 0.6180339887498949


def surface_points(scene: Scene, count: int) -> np.ndarray:
    """(3, n, 3) float64, n about `count`: positions, normals, diffuse reflectance times the area a point stands for.

    Evenly by area; each shape has at least one. What has two sides has every other point on its back.
    """
    total = max(surface_area(scene), 1e-300)
    found = [np.zeros((3, 0, 3))]
    for shape in scene.shapes:
        area = surface_area(Scene("one shape", (shape,), scene.camera))
        if area > 0:
            found.append(_on_shape(shape, max(1, round(count * area / total))))
    return np.concatenate(found, axis=1)


def _on_shape(shape: Shape, count: int) -> np.ndarray:
    mesh, index = shape.world, np.arange(count)
    triangle, b1, b2, area, normals = points_on_mesh(mesh, (index + 0.5) / count, (index + 0.5) * GOLDEN % 1)
    weights = np.stack([1 - b1 - b2, b1, b2], axis=1)[..., None]
    corners = mesh.triangles[triangle]
    positions = np.sum(weights * mesh.positions[corners], axis=1)
    normal = normals[triangle]
    share = area / count
    if shines_back(shape):
        normal, share = normal * np.where(index % 2, -1.0, 1.0)[:, None], 2 * share
    return np.stack([positions, normal, share * _diffuse(shape, corners, weights)])


def _diffuse(shape: Shape, corners: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """(n, 3) the base's diffuse reflectance, with its textures; 0 in a mask's holes."""
    material, mesh = shape.material, shape.world

    def texel(texture) -> np.ndarray:
        return look_up(texture, *np.sum(weights * mesh.texcoords[texture.texcoord][corners], axis=1).T).T

    base = np.broadcast_to(np.append(material.base_color, material.alpha), (len(corners), 4)).astype(np.float64)
    if mesh.colors is not None:
        base = base * np.sum(weights * mesh.colors[corners], axis=1)
    if (texture := material.textures.get("base_color")) is not None:
        base = base * texel(texture)
    metallic = np.full((len(corners), 1), material.metallic)
    if (texture := material.textures.get("metallic_roughness")) is not None:
        metallic = metallic * texel(texture)[:, 2:3]
    there = base[:, 3:] >= material.alpha_cutoff if material.alpha_mode == "mask" else True
    return np.where(there, base[:, :3] * (1 - metallic), 0.0)
