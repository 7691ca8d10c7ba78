"""The environment's map, and the solids' tangent planes, baked once."""

from typing import Any

import numpy as np

from ...effect import Knobs
from ...glass.around import SurroundedPasses
from ...glass.shapes import SolidShape, largest_solids
from ...stage import Stage


class Passes(SurroundedPasses):
    """A cube map for each of the largest solids."""

    baked: list[SolidShape]

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        super().__init__(stage, knobs, folder)
        self._stage, self._size = stage, int(knobs["size"])
        self._solids = largest_solids(stage.scene, int(knobs["solids"]))

    def bake(self) -> list[SolidShape]:
        """The tangent planes; the smallest solid last, since of boxes that hold a point the last counts."""
        return [SolidShape(self._stage, shape, self._size) for shape in self._solids]

    def defines(self, light: int | None) -> dict[str, object]:
        """How many solids there are."""
        return super().defines(light) | {"SOLIDS": len(self._solids)}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Where they are."""
        told = [solid.uniforms() for solid in self.baked]
        found = {name: np.stack([one[name] for one in told]) for name in told[0]}
        return found | {"solid_views": np.concatenate([one["solid_views"] for one in told])}

    def textures(self, light: int | None) -> dict[str, Any]:
        """The map and the planes."""
        return super().textures(light) | {"solid_planes": [solid.planes for solid in self.baked]}
