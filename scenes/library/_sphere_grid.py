"""Spheres in rows and columns: metalness grows upwards, roughness to the right."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Shape, Vector

SIDE = 6
BASE_COLOR: Vector = (0.8, 0.55, 0.35)


def sphere_grid(radius: float) -> list[Shape]:
    """36 spheres in z = 0, 1 m apart, around the origin; metallic 0, 0.2, …, 1, roughness 0.2, 0.36, …, 1.

    Smoother ones would show punctual lights as highlights far smaller than a pixel, which no number of samples that a
    closure test can afford would settle.

    Args:
        radius: metres.
    """
    mesh = shapes.sphere(radius, segments=64, rings=32)
    made = []
    for row, metallic in enumerate(np.linspace(0, 1, SIDE)):
        for column, roughness in enumerate(np.linspace(0.2, 1, SIDE)):
            name = f"metallic {metallic:.1f} roughness {roughness:.2f}"
            material = Material(name, BASE_COLOR, metallic=float(metallic), roughness=float(roughness))
            matrix = np.eye(4)
            matrix[:2, 3] = column - (SIDE - 1) / 2, row - (SIDE - 1) / 2
            made.append(Shape(name, mesh, material, matrix))
    return made
