"""Draws the depth maps; blockers and penumbrae are in pcss.glsl."""

from typing import Any

from ...effect import Knobs
from ...shadows.passes import ShadowPasses
from ...stage import Stage


class Passes(ShadowPasses):
    """Cubes of depth maps, seen from emissive surfaces' centres; a point looks up all that may block it."""

    near_by = False

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        # Every comparison finds its own face of the cube: nothing reads across a face's edge.
        super().__init__(stage, knobs, folder, reach=0)

    def defines(self, light: int) -> dict[str, object]:
        """What the shader is compiled with."""
        samples = {name.upper(): int(self.knobs[name]) for name in ("samples", "search_samples")}
        return super().defines(light) | samples | {"BETWEEN": self.knobs["blockers"] == "between"}

    def uniforms(self, light: int) -> dict[str, Any]:
        """What the shader is told."""
        return super().uniforms(light) | {"shadow_planes": self.views(light).planes}
