"""The passes of effects that only look up what was baked."""

from pathlib import Path
from typing import Any

from lightmeter.scenes.model import Environment

from ..effect import Knobs
from ..stage import Stage


class BakedPasses:
    """An effect's `Passes` derives from this and gives its textures, by their samplers' names, in `bake`.

    Attributes:
        baked: what `bake` gave; set before anything is drawn.
    """

    baked: dict[str, Any]

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        self.device, self.scene, self.knobs, self.folder = stage.device, stage.scene, knobs, folder

    @property
    def environment(self) -> Environment:
        """What surrounds the scene."""
        assert self.scene.environment is not None, "the effect is left out of scenes without one"
        return self.scene.environment

    def defines(self, _light: int | None) -> dict[str, object]:
        """Nothing beside the effect's own."""
        return {}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Nothing beside the effect's own."""
        return {}

    def textures(self, _light: int | None) -> dict[str, Any]:
        """What was baked."""
        return self.baked
