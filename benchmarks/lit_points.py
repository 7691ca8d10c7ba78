"""Points at which a surface is lit and seen from any two directions, for effects and oracles to be held against.

Viewer and lamp stand still, 1 m to the left and to the right of the origin. From the point that is cot(ψ/2) behind it
they are seen ψ apart, with the half vector along +Z: so a point's place chooses the angle between light and viewer, and
its normal all the rest. Positions and normals are free, since a renderer shades points that it is given.
"""

from dataclasses import dataclass

import numpy as np

from lightmeter.groundtruth.oracles import direct
from lightmeter.groundtruth.world import World
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.effect import KnobValue
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Material, PointLight, Scene, Shape
from lightmeter.scenes.points import SurfacePoints

CAMERA = Camera("left", look_at((-1, 0, 0), (0, 0, -1)), yfov=1.0)
LAMP = PointLight("right", (1.0, 0.0, 0.0), (1.0, 1.0, 1.0))
WIDTH = 512


@dataclass(frozen=True, eq=False)
class Configurations:
    """Directions and material at N points; f·(n·l) is found for each.

    Attributes:
        normal: (N, 3) unit, in the frame whose Z is the half vector and whose X leads from viewer to light.
        apart: (N,) ψ, the angle between light and viewer, above 0 and below π.
        roughness: (N,).
    """

    normal: np.ndarray
    apart: np.ndarray
    roughness: np.ndarray

    @property
    def view(self) -> np.ndarray:
        """(N, 3) direction to the viewer."""
        half = self.apart / 2
        return np.stack([-np.sin(half), 0 * half, np.cos(half)], axis=-1)

    @property
    def light(self) -> np.ndarray:
        """(N, 3) direction to the light."""
        return self.view * (-1, 1, 1)

    @classmethod
    def of(cls, normal: np.ndarray, view: np.ndarray, light: np.ndarray, roughness: np.ndarray) -> "Configurations":
        """From directions (N, 3) in any one frame."""
        half = view + light
        half /= np.linalg.norm(half, axis=-1, keepdims=True)
        across = light - view
        length = np.linalg.norm(across, axis=-1, keepdims=True)
        across = np.where(length > 0, across / np.maximum(length, 1e-300), np.roll(half, 1, axis=-1))
        along = np.cross(half, across)
        turned = np.stack([np.sum(normal * axis, axis=-1) for axis in (across, along, half)], axis=-1)
        return cls(turned, 2 * np.arcsin(np.clip(length[..., 0] / 2, 1e-7, 1)), roughness)

    def points(self, base_color: float, metallic: float) -> SurfacePoints:
        """As points of an image, `WIDTH` wide; what fills up the last row is seen nowhere."""
        count = len(self.apart)
        rows = -(-count // WIDTH)

        def image(values: np.ndarray, dtype=np.float32) -> np.ndarray:
            out = np.zeros((rows * WIDTH, *values.shape[1:]), dtype)
            out[:count] = values
            return out.reshape(rows, WIDTH, *values.shape[1:])

        place = np.zeros((count, 3))
        place[:, 2] = -1 / np.tan(self.apart / 2)
        ones = np.ones(count)
        nowhere = np.full((rows, WIDTH), -1, np.int32)
        nowhere.ravel()[:count] = 0
        return SurfacePoints(
            position=image(place),
            normal=image(self.normal),
            view=image(self.view),
            base_color=image(np.full((count, 3), base_color)),
            metallic=image(metallic * ones),
            roughness=image(self.roughness),
            specular=image(ones),
            occlusion=image(ones),
            emission=image(np.zeros((count, 3))),
            shape=nowhere,
            triangle=nowhere,
        )

    def reflected(self, image: np.ndarray) -> np.ndarray:
        """(N,) f·(n·l) from a picture of the points, its green: the lamp sends sin²(ψ/2) W/m² there."""
        return image[..., 1].ravel()[: len(self.apart)].astype(np.float64) / np.sin(self.apart / 2) ** 2


def stage() -> Scene:
    """Two cards whose materials differ in everything, so that the renderer takes nothing for constant."""
    card = shapes.rectangle(1.0, 1.0)
    one, other = Material("one"), Material("other", (0.5, 0.5, 0.5), metallic=0.5, roughness=0.5, specular=0.5)
    return Scene("points", (Shape("one", card, one), Shape("other", card, other)), CAMERA, (LAMP,))


def truth(world: World, at: Configurations, base_color: float, metallic: float) -> np.ndarray:
    """(N,) f·(n·l) of the scene's material, by the oracle of `direct`."""
    return at.reflected(direct.evaluate(world, at.points(base_color, metallic), 0))


def shaded(
    device: Device, at: Configurations, base_color: float, metallic: float, effect: str, knobs: dict[str, KnobValue]
) -> np.ndarray:
    """(N,) f·(n·l) by an effect's own GLSL."""
    points = at.points(base_color, metallic)
    choice = Choice(only=(effect,), settings={effect: knobs})
    renderer = Renderer(device, compile_plan(stage(), effects(), choice), points.shape.shape[::-1])
    return at.reflected(renderer.shade(points).direct[0])
