"""What a pass finds on stage: the device, the scene on it, and the G-buffer."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from lightmeter.scenes.model import Scene

from .baking import Baking
from .device import Device
from .gbuffer import GBuffer
from .geometry import Geometry
from .graph import Plan
from .projection import viewer
from .scattered_light import ScatteredLight


@dataclass(frozen=True, eq=False)
class Stage:
    """Handed to every pass when it is made.

    Attributes:
        size: width and height in pixels.
        baking: what effects bake, shared by all stages of a renderer.
        plan: the whole frame's.
        scattered: the lit frame so far; None where no effect reads it.
        elsewhere: (4,) the viewer, as `projection.viewer` has it, where the G-buffer is not seen from the camera.
        mask: the depth buffer of what is lit: a pixel at depth 0 is left out. None: all pixels are lit.
    """

    device: Device
    scene: Scene
    geometry: Geometry
    gbuffer: GBuffer
    size: tuple[int, int]
    baking: Baking
    plan: Plan
    scattered: ScatteredLight | None = None
    elsewhere: np.ndarray | None = None
    mask: Any = None

    @property
    def viewer(self) -> np.ndarray:
        """(4,) what gives shaders the direction to the viewer."""
        return viewer(self.scene.camera) if self.elsewhere is None else self.elsewhere
