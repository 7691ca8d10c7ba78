"""The pass that gathers light over the screen, before it is averaged over like pixels."""

from pathlib import Path
from typing import Any

import numpy as np

from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...shaders import source
from ...stage import Stage
from . import defines


class Passes:
    """One image of irradiance over π."""

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        assert stage.scattered is not None, "the effect declares that it reads the lit frame"
        self._stage = stage
        self._scattered = stage.scattered.texture
        self._gathered = stage.device.target(stage.size)
        self._framebuffer = stage.device.framebuffer([self._gathered])
        matrix = stage.scene.camera.matrix
        right, up = (matrix[:3, axis] / np.linalg.norm(matrix[:3, axis]) for axis in (0, 1))
        values = {
            "viewer": stage.viewer,
            "camera_right": right,
            "camera_up": up,
            "reach": float(knobs["radius"]) * stage.size[1],
        }
        fragment = source("horizons.frag", stage.gbuffer.defines() | defines(knobs), folder)
        self._pass = FullscreenPass(stage.device, fragment, values)

    def draw(self, _light: int | None) -> None:
        """Gather what is lit so far."""
        gbuffer = self._stage.gbuffer
        textures = gbuffer.samplers | {"scattered_light": self._scattered}
        self._pass.draw(self._framebuffer, textures, values=gbuffer.place)

    def defines(self, _light: int | None) -> dict[str, object]:
        """Nothing beyond the effect's own."""
        return {}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Nothing beyond the effect's own."""
        return {}

    def textures(self, _light: int | None) -> dict[str, Any]:
        """What was gathered."""
        return {"gathered": self._gathered}
