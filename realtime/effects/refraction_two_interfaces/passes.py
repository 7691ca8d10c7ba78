"""The environment's map, and the backs of the solids."""

from typing import Any

from ...effect import Knobs
from ...glass.around import SurroundedPasses
from ...glass.backs import SolidBacks
from ...stage import Stage


class Passes(SurroundedPasses):
    """Draws the backs for every sample of the frame."""

    per_sample = True

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        super().__init__(stage, knobs, folder)
        self._backs = SolidBacks(stage)

    def draw(self, _light: int | None) -> None:
        """The backs, as the G-buffer's sample sees them."""
        self._backs.draw()

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Where a point lies among the backs."""
        return super().uniforms(_light) | {"back_view": self._backs.view_projection}

    def textures(self, _light: int | None) -> dict[str, Any]:
        """The map and the backs."""
        return super().textures(_light) | self._backs.textures
