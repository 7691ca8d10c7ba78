"""A court with a colonnade around it, open to the sky: halls where the sky is seen between columns alone."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Material, Mesh, Scene, Shape
from lightmeter.scenes.toml.placing import unit

SUMMARY = "Occlusion by the building: a colonnade around a court that is open to the sky, seen from its hall."
INNER, OUTER, HEIGHT = 3.0, 5.0, 3.2
"""Half the side of the court and of the building, and the height of the hall, metres."""
COLUMNS, RADIUS = 5, 0.18


def scene() -> Scene:
    """The hall runs round the court under a flat roof; the camera stands in a corner of it."""
    stone = Material("stone", (0.72, 0.68, 0.6), roughness=0.85)
    plaster = Material("plaster", (0.8, 0.78, 0.74), roughness=0.95, specular=0.5)
    floor = Material("floor", (0.45, 0.42, 0.38), roughness=0.4)

    def put(name: str, mesh: Mesh, at: tuple[float, float, float], material: Material) -> Shape:
        place = np.eye(4)
        place[:3, 3] = at
        return Shape(name, mesh, material, place)

    middle, wide = (INNER + OUTER) / 2, OUTER - INNER
    placed = [put("floor", shapes.plane(2 * OUTER + 0.2, 2 * OUTER + 0.2), (0, 0, 0), floor)]
    for side, sign in (("left", -1.0), ("right", 1.0)):
        placed += [
            put(
                f"{side} wall",
                shapes.box(0.2, HEIGHT + 0.2, 2 * OUTER + 0.4),
                (sign * (OUTER + 0.1), HEIGHT / 2, 0),
                plaster,
            ),
            put(f"{side} roof", shapes.box(wide, 0.3, 2 * OUTER + 0.2), (sign * middle, HEIGHT + 0.15, 0), plaster),
        ]
    for side, sign in (("back", -1.0), ("front", 1.0)):
        placed += [
            put(
                f"{side} wall",
                shapes.box(2 * OUTER + 0.4, HEIGHT + 0.2, 0.2),
                (0, HEIGHT / 2, sign * (OUTER + 0.1)),
                plaster,
            ),
            put(f"{side} roof", shapes.box(2 * INNER + 0.1, 0.3, wide), (0, HEIGHT + 0.15, sign * middle), plaster),
        ]
    shaft = shapes.cylinder(RADIUS, HEIGHT - 0.1, segments=96, rings=12)
    foot = shapes.box(0.5, 0.3, 0.5)
    along = np.linspace(-INNER, INNER, COLUMNS)
    around = {(float(x), float(z)) for x in along for z in along if max(abs(x), abs(z)) > INNER - 1e-6}
    for number, (x, z) in enumerate(sorted(around)):
        placed.append(put(f"column {number}", shaft, (x, 0.1 + HEIGHT / 2, z), stone))
        placed.append(put(f"foot {number}", foot, (x, 0.05, z), stone))
    return Scene(
        name="atrium",
        shapes=tuple(placed),
        camera=Camera(
            "visitor",
            look_at((-4.5, 1.65, 4.6), (-2.4, 1.5, -3.0)),
            yfov=float(np.radians(58.0)),
            near=0.1,
            far=40.0,
            exposure=0.6,
        ),
        lights=(DirectionalLight("sun", unit((0.45, -1.0, -0.35)), (2.0, 1.85, 1.6)),),
        environment=Environment((0.75, 0.9, 1.15)),
        summary=SUMMARY,
    )
