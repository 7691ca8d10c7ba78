"""The points of each light, as textures."""

from typing import Any

import numpy as np

from lightmeter.scenes.emitters import shines_back
from lightmeter.scenes.model import Shape

from ...effect import Knobs
from ...stage import Stage
from .points import light_points


class Passes:
    """Nothing is drawn beforehand: the points of a light do not change."""

    def __init__(self, stage: Stage, knobs: Knobs, _folder) -> None:
        self._stage = stage
        self._samples, self._tile = int(knobs["samples"]), int(knobs["tile"])
        self._points: dict[int, Any] = {}

    def defines(self, _light: int) -> dict[str, object]:
        """Sizes of the table of points."""
        return {"SAMPLES": self._samples, "TILE": self._tile}

    def uniforms(self, light: int) -> dict[str, Any]:
        """Whether the light has two sides."""
        return {"two_sided": shines_back(self._shape(light))}

    def textures(self, light: int) -> dict[str, Any]:
        """The light's points."""
        if light not in self._points:
            points = light_points(self._shape(light), self._samples, self._tile**2)
            self._points[light] = self._stage.device.table(np.pad(points, ((0, 0), (0, 0), (0, 1))))
        return {"light_points": self._points[light]}

    def _shape(self, light: int) -> Shape:
        scene = self._stage.scene
        return scene.shapes[scene.all_lights[light].shape]
