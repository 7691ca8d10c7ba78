"""The baked probes as a texture."""

from pathlib import Path
from typing import Any

import numpy as np

from ...effect import Knobs
from ...stage import Stage
from .baking import bake_probes


class Passes:
    """Nothing is drawn for each frame: light and surfaces are those of the time of baking."""

    baked: np.ndarray

    def __init__(self, stage: Stage, knobs: Knobs, _folder: Path) -> None:
        self._stage, self._knobs = stage, knobs
        self._texture: Any = None

    def bake(self) -> np.ndarray:
        """What the probes hold; see `baking`."""
        return bake_probes(self._stage, self._knobs)

    def defines(self, _light: int | None) -> dict[str, object]:
        """Nothing beyond the effect's own."""
        return {}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Nothing beyond the effect's own."""
        return {}

    def textures(self, _light: int | None) -> dict[str, Any]:
        """A column for each probe, a row for each axis."""
        if self._texture is None:
            self._texture = self._stage.device.table(self.baked)
        return {"probes": self._texture}
