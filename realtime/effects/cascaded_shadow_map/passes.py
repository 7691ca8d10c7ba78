"""Draws the cascades; the choice among them and the comparison are in cascaded_shadow_map.glsl."""

from typing import Any

from ...shadows.comparing import ComparedPasses
from ...shadows.views import ShadowViews
from .cascades import Cascades, cascades


class Passes(ComparedPasses):
    """Maps of depths for slices of the camera's field."""

    def __init__(self, stage, knobs, folder) -> None:
        super().__init__(stage, knobs, folder)
        self._cascades: dict[int, Cascades] = {}

    def look(self, light: int) -> ShadowViews:
        """Where the cascades look."""
        scene, count, logarithmic = self.stage.scene, int(self.knobs["cascades"]), float(self.knobs["logarithmic"])
        self._cascades[light] = cascades(
            scene, scene.all_lights[light], self.stage.size, self.resolution, self.border, count, logarithmic
        )
        return self._cascades[light].views

    def uniforms(self, light: int) -> dict[str, Any]:
        """What the shader is told."""
        values = super().uniforms(light)
        found = self._cascades[light]
        return values | {"cascade_depth": found.depth, "cascade_ends": found.ends}
