"""A long row of posts towards the horizon."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Material, Scene, Shape
from lightmeter.scenes.toml.placing import unit

SUMMARY = "Shadows near and far: an avenue of posts, from two metres before the camera to ninety, under a sun."
LENGTH, STEP = 90.0, 3.0


def scene() -> Scene:
    """Posts of 2.5 m, 10 cm wide, in two rows 4 m apart; the camera stands between them at a man's height."""
    ground = Material("ground", (0.45, 0.45, 0.42), roughness=0.9, specular=0.0)
    wood = Material("wood", (0.4, 0.28, 0.18), roughness=0.8, specular=0.0)
    post = shapes.box(0.1, 2.5, 0.1)
    placed = []
    for row, z in enumerate(np.arange(2.0, LENGTH, STEP)):
        for side in (-1.0, 1.0):
            place = np.eye(4)
            place[:3, 3] = 2.0 * side, 1.25, -z
            placed.append(Shape(f"post {row}{'LR'[side > 0]}", post, wood, place))
    place = np.eye(4)
    place[2, 3] = -LENGTH / 2
    return Scene(
        name="avenue",
        shapes=(Shape("ground", shapes.plane(40.0, LENGTH + 10.0), ground, place), *placed),
        camera=Camera(
            "walker", look_at((0.0, 1.7, 1.0), (0.0, 0.6, -6.0)), yfov=float(np.radians(50.0)), near=0.1, far=200.0
        ),
        lights=(DirectionalLight("sun", unit((-1.0, -0.9, 0.5)), (2.6, 2.5, 2.3)),),
        environment=Environment((0.12, 0.15, 0.2)),
        summary=SUMMARY,
    )
