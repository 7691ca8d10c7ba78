"""Draws and averages the exponentials; the comparison is in exponential_shadow_map.glsl."""

from ...effect import Knobs
from ...shadows.filtered import FilteredPasses
from ...stage import Stage


class Passes(FilteredPasses):
    """Maps of one exponential."""

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        super().__init__(stage, knobs, folder, components=1, constants={"EXPONENT": float(knobs["exponent"])})
