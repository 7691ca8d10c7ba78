"""The horizons' pass and its blur."""

from pathlib import Path

from ...ambient.passes import ScreenOcclusion
from ...effect import Knobs
from ...stage import Stage


class Passes(ScreenOcclusion):
    """Horizons at every pixel."""

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        numbers = {name.upper(): int(knobs[name]) for name in ("slices", "steps")}
        super().__init__(stage, knobs, folder, "horizons.glsl", numbers)
