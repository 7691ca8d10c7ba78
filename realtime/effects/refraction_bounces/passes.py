"""What is around, and the solids' tangent planes, baked once."""

from typing import Any

import numpy as np

from ...effect import Knobs
from ...glass.around import SurroundedPasses, largest_solids
from ...glass.shapes import SolidShape
from ...reflections.cubes import LitCube
from ...stage import Stage


class Passes(SurroundedPasses):
    """A cube map of tangent planes for each of the largest solids."""

    baked: tuple[LitCube | None, list[SolidShape]]

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        super().__init__(stage, knobs, folder)
        self._solids = largest_solids(stage.scene, int(knobs["solids"]))

    def bake(self) -> tuple[LitCube | None, list[SolidShape]]:
        """What is around; the planes, the smallest solid last, since of boxes that hold a point the last counts."""
        size = int(self._knobs["size"])
        return self._surfaces(), [SolidShape(self._stage, shape, size) for shape in self._solids]

    @property
    def _around(self) -> LitCube | None:
        return self.baked[0]

    def defines(self, light: int | None) -> dict[str, object]:
        """How many solids there are."""
        return super().defines(light) | {"SOLIDS": len(self._solids)}

    def uniforms(self, light: int | None) -> dict[str, Any]:
        """Where they are."""
        told = [solid.uniforms() for solid in self.baked[1]]
        found = {name: np.stack([one[name] for one in told]) for name in told[0]}
        views = {"solid_views": np.concatenate([one["solid_views"] for one in told])}
        return super().uniforms(light) | found | views

    def textures(self, light: int | None) -> dict[str, Any]:
        """The planes."""
        return super().textures(light) | {"solid_planes": [solid.planes for solid in self.baked[1]]}
