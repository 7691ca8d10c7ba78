"""What a stiff case is, and the plain room that most of them are made from."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Material, Mesh, PointLight, Scene, Shape

GREY = Material("grey", (0.5, 0.5, 0.5), roughness=0.8)


@dataclass(frozen=True)
class StiffCase:
    """A scene at the edge of what arithmetic or sampling can do.

    Attributes:
        what: what makes it stiff, one clause.
        scene: makes it.
        size: (width, height) at which it is rendered.
        like: the case that must look the same, since only its coordinates differ; "": none.
        refused: a part of the message with which both sides refuse the scene; "": it is rendered.
        scale: how many times as large it is as that case.
        settings: (effect, knob, value) in place of defaults, where these would cost much and show nothing.
    """

    what: str
    scene: Callable[[], Scene]
    size: tuple[int, int] = (24, 24)
    like: str = ""
    refused: str = ""
    scale: float = 1.0
    settings: tuple[tuple[str, str, float], ...] = ()


def room(*more: Shape, ball: Material = GREY, lights=None, environment=None, max_depth: int = 4) -> Scene:
    """A ball on a floor, a point light and a sun, 4 m before the camera; two or three shapes are all it takes.

    Args:
        more: further shapes.
        lights: in place of the two.
        environment: None: a dim one; its radiance 0: none.
    """
    usual = (
        PointLight("lamp", (1.0, 2.5, 1.0), (6.0, 5.5, 5.0)),
        DirectionalLight("sun", (-0.6, -0.64, -0.48), (1.0, 0.95, 0.9)),
    )
    around = Environment((0.3, 0.35, 0.4)) if environment is None else environment
    return Scene(
        name="stiff",
        shapes=(floor(), at("ball", shapes.sphere(0.5, 24), (0.0, 0.5, 0.0), ball), *more),
        camera=viewer(),
        lights=usual if lights is None else tuple(lights),
        environment=around if around.shines else None,
        max_depth=max_depth,
    )


def floor() -> Shape:
    """Six metres of grey."""
    return Shape("floor", shapes.plane(6.0, 6.0), GREY)


def viewer(near: float = 0.1, far: float = 100.0) -> Camera:
    """From the front and a little above."""
    return Camera("camera", look_at((0.0, 1.5, 4.0), (0.0, 0.4, 0.0)), yfov=float(np.radians(35.0)), near=near, far=far)


def at(name: str, mesh: Mesh, position: tuple[float, float, float], material: Material = GREY) -> Shape:
    """A mesh at a place."""
    matrix = np.eye(4)
    matrix[:3, 3] = position
    return Shape(name, mesh, material, matrix)
