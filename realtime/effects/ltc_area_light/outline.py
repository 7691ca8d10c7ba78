"""What stands for an emissive shape: polygons, or a sphere's outline."""

import math
from dataclasses import dataclass

import numpy as np

from lightmeter.scenes.emitters import emitter, shines_back
from lightmeter.scenes.facets import facets
from lightmeter.scenes.luminaires import Disk, Sphere, recognise
from lightmeter.scenes.model import AreaLight, Scene


@dataclass(frozen=True, eq=False)
class Outline:
    """Polygons of even radiance.

    Attributes:
        centre: (3,) float64, world space, metres.
        corners: (n, 4) float64: offsets from the centre, anticlockwise seen from the front; 1 at a polygon's last.
        sphere_radius: metres; 0 unless the corners are the one outline of a sphere, in units of its radius.
    """

    centre: np.ndarray
    corners: np.ndarray
    sphere_radius: float = 0.0


def outline(scene: Scene, light: AreaLight, most: int, rim: int) -> Outline:
    """The polygons of an emissive shape.

    Args:
        most: corners of all its flat pieces together; a shape with more is taken for the sphere that sends as much.
        rim: corners that a disk's or a sphere's circle gets.
    """
    mesh, facts = scene.shapes[light.shape].world, emitter(scene, light)
    known = recognise(mesh)
    if isinstance(known, Sphere):
        return _sphere(known.centre, known.radius, rim)
    polygons = facets(mesh)
    if isinstance(known, Disk) and len(polygons[0]) > rim:
        return Outline(known.centre, _closed(known.radius * circle(rim) @ known.axes))
    if sum(map(len, polygons)) > most:
        sides = 2 if shines_back(scene.shapes[light.shape]) else 1
        return _sphere(facts.centre, math.sqrt(sides * facts.area / (4 * math.pi)), rim)
    return Outline(facts.centre, np.concatenate([_closed(polygon - facts.centre) for polygon in polygons]))


def circle(rim: int) -> np.ndarray:
    """(rim, 3): a regular polygon with the unit circle's area, anticlockwise around z."""
    turn = 2 * np.pi * np.arange(rim) / rim
    radius = math.sqrt(2 * math.pi / (rim * math.sin(2 * math.pi / rim)))
    return radius * np.stack([np.cos(turn), np.sin(turn), np.zeros(rim)], axis=1)


def _sphere(centre: np.ndarray, radius: float, rim: int) -> Outline:
    return Outline(centre, _closed(circle(rim)), radius)


def _closed(corners: np.ndarray) -> np.ndarray:
    return np.column_stack([corners, np.arange(len(corners)) == len(corners) - 1])
