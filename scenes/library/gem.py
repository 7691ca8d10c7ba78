"""A diamond in a studio: what its many walls inside mirror is most of what is seen."""

import numpy as np

from lightmeter.scenes.environments import built_in
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.glass import glass
from lightmeter.scenes.model import Camera, Scene, Shape
from lightmeter.scenes.shapes.brilliant import brilliant

SUMMARY = "Refraction through back faces: a brilliant-cut diamond alone in a studio, its table towards the viewer."


def scene() -> Scene:
    """A stone of 1 m, so that lengths are easily read; it absorbs a little blue."""
    diamond = glass("diamond", 2.417, (0.98, 0.97, 0.92), 1.0)
    return Scene(
        name="gem",
        shapes=(Shape("stone", brilliant(0.5), diamond, np.eye(4)),),
        camera=Camera(
            "camera", look_at((0.35, 1.9, 1.25), (0.0, -0.12, 0.0)), yfov=float(np.radians(27.0)), near=0.5, far=6.0
        ),
        environment=built_in("studio"),
        summary=SUMMARY,
    )
