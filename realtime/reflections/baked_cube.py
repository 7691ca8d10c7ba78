"""A cube map of the scene's middle, baked once."""

from typing import Any

from ..effect import Knobs
from ..stage import Stage
from .cubes import LitCube, around, middle


class BakedCube:
    """Passes of an effect that looks up one cube map which does not change."""

    baked: LitCube

    def __init__(self, stage: Stage, knobs: Knobs, _folder) -> None:
        self.stage, self._knobs = stage, knobs

    def bake(self) -> LitCube:
        """The cube map."""
        centre = middle(self.stage.scene)
        cube = LitCube(self.stage, centre, int(self._knobs["size"]), float(self._knobs["ambient"]))
        cube.draw(around(self.stage.scene, centre))
        return cube

    def defines(self, _light: int | None) -> dict[str, object]:
        """Nothing depends on the light."""
        return {}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Where the cube's faces look."""
        return self.baked.uniforms

    def textures(self, _light: int | None) -> dict[str, Any]:
        """The faces."""
        return {"cube_images": [self.baked.image]}
