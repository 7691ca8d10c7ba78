"""The rays of the lights whose ends become virtual lights: where on a light's maps each looks, and what it carries."""

import math
from dataclasses import dataclass, replace

import numpy as np

from lightmeter.scenes.emitters import flux, shines_back
from lightmeter.scenes.model import AreaLight, DirectionalLight, PointLight, PunctualLight, Scene, SpotLight
from lightmeter.scenes.optics.frames import basis
from lightmeter.scenes.optics.lights import spot_attenuation

from ...shadows.views import CUBE_FACES, ShadowViews, shadow_views
from ..many_sample_light.points import light_points

GOLDEN = (math.sqrt(5) - 1) / 2


@dataclass(frozen=True, eq=False)
class Rays:
    """Rays that start at one place.

    Attributes:
        views: of the reflective shadow map that they are looked up in.
        texels: (n, 2) whole numbers, columns and rows over all the views' tiles, from the lower left.
        powers: (n, 3) W of each, before its range dims it.
        inverse_range_square: 1/m²; 0 without a range.
    """

    views: ShadowViews
    texels: np.ndarray
    powers: np.ndarray
    inverse_range_square: float = 0.0


def light_rays(scene: Scene, count: int, resolution: int, emitter_points: int) -> list[Rays]:
    """About so many rays from all lights, shared out by flux; each light that sends any has at least one.

    Args:
        resolution: texels along a side of a view.
        emitter_points: places on an emissive surface where its rays start.
    """
    fluxes = [float(np.sum(flux(scene, light))) for light in scene.all_lights]
    total = sum(fluxes)
    found: list[Rays] = []
    for light, share in zip(scene.all_lights, fluxes, strict=True):
        if share > 0:
            number = max(1, round(count * share / total))
            if isinstance(light, AreaLight):
                found += _from_surface(scene, light, number, resolution, emitter_points)
            else:
                found.append(_from_punctual(scene, light, number, resolution))
    return found


def spread(count: int, shift: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """(n,) and (n,) in 0…1: a lattice whose points lie evenly (the golden ratio's; Fibonacci on a sphere)."""
    index = np.arange(count)
    return (index + 0.5) / count, (index * GOLDEN + shift) % 1


def _from_punctual(scene: Scene, light: PunctualLight, count: int, resolution: int) -> Rays:
    views = shadow_views(scene, light, resolution, border=0)
    x, y = spread(count)
    if isinstance(light, DirectionalLight):
        # Evenly over the map: its matrix says which area, across the rays, one unit of clip space is.
        across = 4 / np.prod(np.linalg.norm(views.matrices[0, :2, :3], axis=1))
        texels = np.stack([x, y], axis=1) * resolution
        return Rays(views, texels.astype(int), np.tile(np.array(light.irradiance) * (across / count), (count, 1)))
    lowest = math.cos(light.outer) if isinstance(light, SpotLight) else -1.0
    cosines = 1 - (1 - lowest) * x
    axis = np.array(light.direction if isinstance(light, SpotLight) else (0.0, 0.0, 1.0), dtype=np.float64)
    powers = np.array(light.intensity) * np.full((count, 1), 2 * math.pi * (1 - lowest) / count)
    if isinstance(light, SpotLight):
        powers *= np.asarray(spot_attenuation(cosines, light.inner, light.outer))[:, None]
    directions = _about(axis / np.linalg.norm(axis), cosines, y)
    inverse = 0.0 if light.range is None else 1 / light.range**2
    return Rays(views, texels_of(views, directions, resolution), powers, inverse)


def _from_surface(scene: Scene, light: AreaLight, count: int, resolution: int, places: int) -> list[Rays]:
    """Cosine-distributed rays from places on an emissive surface; from both sides where it has two."""
    shape = scene.shapes[light.shape]
    sides = (1, -1) if shines_back(shape) else (1,)
    places = min(places, count)
    points = light_points(shape, places, sets=1).reshape(places, 3, 3)
    starts = [(p, side * n, radiance) for side in sides for p, n, radiance in points]
    found = []
    for number, (position, normal, radiance) in enumerate(starts):
        rays = max(1, (count * (number + 1)) // len(starts) - (count * number) // len(starts))
        lamp = PointLight(light.name, tuple(map(float, position)), (1.0, 1.0, 1.0))
        views = replace(shadow_views(scene, lamp, resolution, border=0), excluded=light.shape)
        x, y = spread(rays, shift=number * GOLDEN**2)
        directions = _about(normal, np.sqrt(1 - x), y)
        # A patch of the surface that sends radiance L has π·L·area for its flux.
        powers = np.tile(radiance * (math.pi / rays), (rays, 1))
        found.append(Rays(views, texels_of(views, directions, resolution), powers))
    return found


def _about(axis: np.ndarray, cosines: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """(n, 3) unit directions at angles from an axis, turned about it."""
    s, t = (np.array(v, dtype=np.float64) for v in basis(axis, lambda *xyz: xyz))
    sines, angles = np.sqrt(np.maximum(1 - cosines**2, 0)), 2 * np.pi * turns
    around = np.cos(angles)[:, None] * s + np.sin(angles)[:, None] * t
    return cosines[:, None] * axis + sines[:, None] * around


def texels_of(views: ShadowViews, directions: np.ndarray, resolution: int) -> np.ndarray:
    """(n, 2) where on the tiles of a light with a position rays in some directions (n, 3) lie."""
    if len(views.matrices) == 1:
        view = np.zeros(len(directions), int)
    else:
        view = np.argmax(directions @ np.array([face for face, _ in CUBE_FACES], float).T, axis=1)
    ends = np.append(views.position[:3] + directions, np.ones((len(directions), 1)), axis=1)
    clip = np.einsum("nij,nj->ni", views.matrices[view], ends)
    within = np.clip((clip[:, :2] / clip[:, 3:] + 1) / 2 * resolution, 0, resolution - 1).astype(int)
    columns, _ = views.tiles
    return within + resolution * np.stack([view % columns, view // columns], axis=1)
