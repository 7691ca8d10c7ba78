"""What lies over a material, or shapes its gloss: coats of growing roughness and factor, brushed metal,
felt."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Material, PointLight, Scene, Shape
from lightmeter.scenes.tangents import with_tangents
from lightmeter.scenes.toml.placing import unit

SUMMARY = "The layers of materials: clear coats over roughness and over factor, anisotropy, and sheen."
COLUMNS = 6
RADIUS = 0.42


def rows() -> list[list[Material]]:
    """The materials, row by row from the top."""
    growing = [float(t) for t in np.linspace(0, 1, COLUMNS)]
    lacquer = {"base_color": (0.55, 0.05, 0.03), "roughness": 0.6}
    steel = {"base_color": (0.75, 0.72, 0.68), "metallic": 1.0, "roughness": 0.3}
    felt = {"base_color": (0.05, 0.08, 0.2), "roughness": 0.9, "sheen_color": (0.7, 0.75, 0.9)}
    return [
        # A smoother coat would show a punctual light as a highlight far smaller than a pixel.
        [Material(f"coat roughness {0.1 + 0.6 * t:.2f}", **lacquer, clearcoat=1, clearcoat_roughness=0.1 + 0.6 * t)
         for t in growing],
        [Material(f"coat factor {0.1 + 0.9 * t:.2f}", **lacquer, clearcoat=0.1 + 0.9 * t, clearcoat_roughness=0.2)
         for t in growing],
        [Material(f"anisotropy {0.1 + 0.9 * t:.2f}", **steel, anisotropy=0.1 + 0.9 * t) for t in growing],
        [Material(f"sheen roughness {0.25 + 0.75 * t:.2f}", **felt, sheen_roughness=0.25 + 0.75 * t) for t in growing],
    ]  # fmt: skip


def scene() -> Scene:
    """Spheres in rows through a long lens, 30 m away, so that each is seen from the front."""
    mesh = with_tangents(shapes.sphere(RADIUS, segments=64, rings=32))
    made = []
    grid = rows()
    for row, materials in enumerate(grid):
        for column, material in enumerate(materials):
            matrix = np.eye(4)
            matrix[:2, 3] = column - (COLUMNS - 1) / 2, (len(grid) - 1) / 2 - row
            made.append(Shape(material.name, mesh, material, matrix))
    return Scene(
        name="material-layers",
        shapes=tuple(made),
        camera=Camera("long lens", look_at((0, 0, 30), (0, 0, 0)), yfov=float(np.radians(12.0)), near=25.0, far=35.0),
        lights=(
            PointLight("point", (-4.0, 3.0, 5.0), (40.0, 38.0, 34.0)),
            DirectionalLight("directional", unit((-0.7, -0.5, -0.6)), (1.2, 1.2, 1.3)),
        ),
        environment=Environment((0.25, 0.27, 0.3)),
        summary=SUMMARY,
    )
