"""The grid before a wall that takes its shadow."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.library._sphere_grid import sphere_grid
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Material, Scene, Shape
from lightmeter.scenes.toml.placing import unit

SUMMARY = "Material and shadow together: the grid of spheres before a wall under a sun."


def scene() -> Scene:
    """The 6 × 6 grid half a metre before a grey wall; a sun from the upper left, a constant environment."""
    place = np.eye(4)
    place[2, 3] = -0.45
    wall = Shape("wall", shapes.rectangle(12.0, 12.0), Material("wall", (0.5, 0.5, 0.5), roughness=0.9), place)
    return Scene(
        name="grid-sun",
        shapes=(*sphere_grid(radius=0.3), wall),
        camera=Camera("long lens", look_at((0, 0, 30), (0, 0, 0)), yfov=float(np.radians(12.0)), near=25.0, far=35.0),
        lights=(DirectionalLight("sun", unit((0.55, -0.6, -0.75)), (2.4, 2.25, 2.0)),),
        environment=Environment((0.25, 0.28, 0.33)),
        summary=SUMMARY,
    )
