"""Draws and averages the moments; the inequality is in variance_shadow_map.glsl."""

from ...effect import Knobs
from ...shadows.filtered import FilteredPasses
from ...stage import Stage


class Passes(FilteredPasses):
    """Maps of two moments."""

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        super().__init__(stage, knobs, folder, components=2)
