"""Draws the shadow maps; the comparison is in shadow_map.glsl."""

import math
from typing import Any

from ...effect import Knobs
from ...shadows import comparing
from ...shadows.passes import ShadowPasses
from ...stage import Stage


class Passes(ShadowPasses):
    """Depth maps, compared."""

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        super().__init__(stage, knobs, folder, comparing.reach(knobs) + math.ceil(float(knobs["normal_offset"])))

    def defines(self, light: int) -> dict[str, object]:
        """What the comparison is compiled with."""
        return super().defines(light) | comparing.defines(self.knobs)

    def uniforms(self, light: int) -> dict[str, Any]:
        """What the comparison is told."""
        return super().uniforms(light) | comparing.uniforms(self.knobs)
