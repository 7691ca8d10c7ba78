"""The material's whole range under every kind of punctual light, in front of nothing."""

import numpy as np

from lightmeter.scenes.framing import look_at
from lightmeter.scenes.library._sphere_grid import sphere_grid
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, PointLight, Scene, SpotLight
from lightmeter.scenes.toml.placing import unit

SUMMARY = "The material model: metalness × roughness under a point, a spot and a directional light."


def scene() -> Scene:
    """A 6 × 6 grid through a long lens, 30 m away, so that every sphere is seen from the front."""
    position = (1.0, -2.0, 6.0)
    return Scene(
        name="metal-rough-grid",
        shapes=tuple(sphere_grid(radius=0.42)),
        camera=Camera("long lens", look_at((0, 0, 30), (0, 0, 0)), yfov=float(np.radians(12.0)), near=25.0, far=35.0),
        lights=(
            PointLight("point", (-4.0, 3.0, 5.0), (28.0, 24.0, 18.0)),
            SpotLight(
                name="spot",
                position=position,
                direction=unit(np.subtract((1.0, 0.0, 0.0), position)),
                intensity=(20.0, 30.0, 45.0),
                inner=float(np.radians(12.0)),
                outer=float(np.radians(24.0)),
            ),
            DirectionalLight("directional", unit((-0.7, -0.5, -0.6)), (1.2, 1.2, 1.2)),
        ),
        environment=Environment((0.25, 0.27, 0.3)),
        summary=SUMMARY,
    )
