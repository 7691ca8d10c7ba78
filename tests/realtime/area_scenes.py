"""Small scenes with one area light, and what an effect gives in them."""

import numpy as np

from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Material, Mesh, Scene, Shape

from .small_scenes import camera, renderer, scene_of

RADIANCE = (3.0, 2.0, 1.0)
GLOW = Material("glow", (0.0, 0.0, 0.0), specular=0.0, emissive=RADIANCE)
ABOVE = camera((0.0, 3.0, 3.0), (0.0, 0.0, 0.0), yfov=0.7)


def turned(towards, at) -> np.ndarray:
    """A matrix that brings a mesh that faces +Z to `at`, and turns it towards a point."""
    matrix = np.array(look_at(at, towards, (0.3, 1.0, 0.2)))
    matrix[:3, 0] *= -1
    matrix[:3, 2] *= -1
    return matrix


def lit_floor(material: Material, light: Mesh, matrix: np.ndarray, glow: Material = GLOW, view=ABOVE) -> Scene:
    """A floor of some material under an area light; the camera looks at it from above."""
    return scene_of(Shape("floor", shapes.plane(4, 4), material), Shape("light", light, glow, matrix), view=view)


def direct_of(device, scene: Scene, effect: str, size=(24, 16), **knobs):
    """The floor's points, flattened, and the light's radiance reflected there, (n, 3)."""
    choice = Choice(use=(effect,), settings={effect: knobs}, without=("shadow_map",))
    seen = renderer(device, scene, size, choice).capture()
    floor = seen.points.shape == 0
    return seen.points.at(floor), seen.direct[0][floor].astype(np.float64)
