"""What a pass finds on stage: the device, the scene on it, and the G-buffer."""

from dataclasses import dataclass

from lightmeter.scenes.model import Scene

from .baking import Baking
from .device import Device
from .gbuffer import GBuffer
from .geometry import Geometry


@dataclass(frozen=True, eq=False)
class Stage:
    """Handed to every pass when it is made.

    Attributes:
        size: width and height in pixels.
        baking: what effects bake, shared by all stages of a renderer.
    """

    device: Device
    scene: Scene
    geometry: Geometry
    gbuffer: GBuffer
    size: tuple[int, int]
    baking: Baking
