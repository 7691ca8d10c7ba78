"""An emissive surface's power, centre and direction."""

import math
from dataclasses import dataclass

import numpy as np

from .facets import is_closed
from .features import is_flat
from .model import AreaLight, DirectionalLight, Light, Scene, Shape, SpotLight


@dataclass(frozen=True, eq=False)
class Emitter:
    """What an emissive shape is, seen from far away.

    Attributes:
        power: (3,) float64, W.
        radiance: (3,) float64, the mean over its surface, W/(sr·m²).
        area: m².
        centre: (3,) float64, the centroid by area, world space.
        normal: (3,) float64 unit mean direction of the fronts; zero where they cancel.
        flat: whether it is one flat piece, so that it has a horizon.
        double_sided: whether it emits from both sides.
    """

    power: np.ndarray
    radiance: np.ndarray
    area: float
    centre: np.ndarray
    normal: np.ndarray
    flat: bool
    double_sided: bool


def emitter(scene: Scene, light: AreaLight) -> Emitter:
    """The facts of an emissive shape; an emissive texture counts with the mean of its texels."""
    shape = scene.shapes[light.shape]
    mesh = shape.world
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    faces = np.cross(b - a, c - a) / 2
    areas = np.linalg.norm(faces, axis=1)
    area = float(areas.sum())
    radiance = np.array(light.radiance, dtype=np.float64)
    if shape.material.emissive_texture is not None:
        from .optics.texture import linear_texels

        radiance *= linear_texels(shape.material.emissive_texture)[..., :3].mean(axis=(0, 1))
    sides = 2 if shape.material.double_sided else 1
    mean = faces.sum(axis=0)
    length = np.linalg.norm(mean)
    return Emitter(
        # A Lambertian emitter of radiance L and area A sends π·A·L from each side.
        power=math.pi * area * radiance * sides,
        radiance=radiance,
        area=area,
        centre=((a + b + c) / 3 * areas[:, None]).sum(axis=0) / max(area, 1e-300),
        normal=mean / length if length > 1e-9 * area else np.zeros(3),
        flat=is_flat(shape),
        double_sided=shape.material.double_sided,
    )


def shines_back(shape: Shape) -> bool:
    """Whether light from the shape's back is seen outside: it is double-sided, and no solid that keeps it within."""
    return shape.material.double_sided and not is_closed(shape.world)


def flux(scene: Scene, light: Light) -> np.ndarray:
    """(3,) float64 W: what a light sends out; a directional one, what it sends through the scene's bounding box."""
    if isinstance(light, AreaLight):
        return emitter(scene, light).power
    if isinstance(light, DirectionalLight):
        low, high = scene.bounds
        x, y, z = high - low
        projected = float(np.abs(light.direction) @ np.array([y * z, x * z, x * y]))
        return projected * np.array(light.irradiance, dtype=np.float64)
    solid_angle = 4 * math.pi
    if isinstance(light, SpotLight):
        # The falloff is the square of a ramp in the cosine: its integral over the rim is a third of the rim's.
        inner, outer = math.cos(light.inner), math.cos(light.outer)
        solid_angle = 2 * math.pi * ((1 - inner) + (inner - outer) / 3)
    return solid_angle * np.array(light.intensity, dtype=np.float64)


def surface_area(scene: Scene) -> float:
    """m², one side of every triangle."""
    total = 0.0
    for shape in scene.shapes:
        mesh = shape.world
        a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
        total += float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2
    return total


def enclosure(scene: Scene) -> float:
    """How much the surfaces face the middle of the scene, 0 (an open plane, a lone object) to 1 (inside a sphere).

    The mean over the area of the cosine between the front and the direction to the middle of the bounding box: a
    room faces it, a convex body faces away. Light that is sent within an enclosure comes back; in the open it is lost.
    """
    middle = (scene.bounds[0] + scene.bounds[1]) / 2
    facing = total = 0.0
    for shape in scene.shapes:
        mesh = shape.world
        a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
        normals, inwards = np.cross(b - a, c - a), middle - (a + b + c) / 3
        length = np.maximum(np.linalg.norm(inwards, axis=1), 1e-300)
        facing += float(np.sum(normals * inwards / length[:, None]))
        total += float(np.linalg.norm(normals, axis=1).sum())
    return max(0.0, facing / max(total, 1e-300))
