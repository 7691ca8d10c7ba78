"""The hemisphere pass and its blur."""

from pathlib import Path

from ...ambient.passes import ScreenOcclusion
from ...effect import Knobs
from ...stage import Stage
from .kernel import kernel, rotations


class Passes(ScreenOcclusion):
    """Samples in a hemisphere at every pixel."""

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        samples = int(knobs["samples"])
        values = {"kernel": kernel(samples), "rotations": rotations()}
        super().__init__(stage, knobs, folder, "hemisphere.glsl", {"SAMPLES": samples}, values)
