"""Spheres in rows and columns: metalness grows upwards, roughness to the right."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Shape, Vector

SIDE = 6
RADIUS = 0.42
"""Metres; the centres are 1 m apart."""


def sphere_grid(base_color: Vector = (0.8, 0.55, 0.35)) -> list[Shape]:
    """36 spheres in z = 0 around the origin; metallic 0, 0.2, …, 1 and roughness 0.1, 0.28, …, 1."""
    mesh = shapes.sphere(RADIUS, segments=64, rings=32)
    made = []
    for row, metallic in enumerate(np.linspace(0, 1, SIDE)):
        for column, roughness in enumerate(np.linspace(0.1, 1, SIDE)):
            name = f"metallic {metallic:.1f} roughness {roughness:.2f}"
            material = Material(name, base_color, metallic=float(metallic), roughness=float(roughness))
            matrix = np.eye(4)
            matrix[:2, 3] = column - (SIDE - 1) / 2, row - (SIDE - 1) / 2
            made.append(Shape(name, mesh, material, matrix))
    return made
