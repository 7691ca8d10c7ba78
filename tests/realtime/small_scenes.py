"""Small scenes for the tests, and what it takes to render them."""

import numpy as np

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Environment, Image, Material, Mesh, PointLight, Scene, Shape

WHITE = Material("white", (1.0, 1.0, 1.0), specular=0.0)
LAMP = PointLight("lamp", (0.3, 0.7, 2.0), (5.0, 5.0, 5.0))


def camera(position=(0.0, 0.0, 3.0), target=(0.0, 0.0, 0.0), **given) -> Camera:
    """A camera; orthographic, 1 m above and below its middle, unless told otherwise."""
    lens = {"ymag": 1.0} if "yfov" not in given and "ymag" not in given else {}
    return Camera("test", look_at(position, target), **({"near": 0.1, "far": 20.0} | lens | given))


def facing(material: Material, width: float = 2.0, height: float = 2.0, matrix=None) -> Shape:
    """A rectangle in z = 0 that faces +Z."""
    return Shape("card", shapes.rectangle(width, height), material, np.eye(4) if matrix is None else matrix)


def moved(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    """A translation."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def card(corners, material: Material = WHITE, **given) -> Shape:
    """One triangle."""
    return Shape("triangle", Mesh(np.array(corners, np.float32), np.array([[0, 1, 2]]), **given), material)


def scene_of(*placed: Shape, view: Camera | None = None, lights=(), radiance=None, **given) -> Scene:
    """A scene of these shapes."""
    environment = None if radiance is None else Environment(radiance)
    return Scene("test", placed, view or camera(), tuple(lights), environment, **given)


def image(texels, dtype=np.uint8) -> Image:
    """An image from nested lists of pixels; plain numbers are grey."""
    values = np.array(texels, dtype)
    return Image(values if values.ndim == 3 else values[..., None], "test")


def renderer(device, scene: Scene, size=(32, 32), choice: Choice | None = None) -> Renderer:
    """A renderer of the scene under a choice of effects."""
    return Renderer(device, compile_plan(scene, effects(), choice), size)


def points(device, scene: Scene, size=(32, 32), offset=(0.0, 0.0)):
    """The surface points."""
    return renderer(device, scene, size).capture(offset, terms=False).points
