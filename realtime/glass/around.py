"""The environment as solids show it."""

from typing import Any

import numpy as np

from lightmeter.scenes.model import Light, Scene

from ..effect import Knobs
from ..environment_map import EnvironmentMap
from ..stage import Stage


def nothing_around(scene: Scene) -> str:
    """Why solids have nothing to show; "" where they have."""
    shines = scene.environment is not None and scene.environment.shines
    return "" if shines else "the scene has no environment for its solids to show"


def around_uniforms(scene: Scene, _knobs: Knobs, _light: Light | None) -> dict[str, Any]:
    """The environment's factor and rotation."""
    assert scene.environment is not None, "the effect is left out of scenes without one"
    return {
        "environment_radiance": np.array(scene.environment.radiance),
        "environment_rotation": scene.environment.rotation,
    }


class SurroundedPasses:
    """An effect's `Passes` derives from this: it holds the environment's map, where there is one."""

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        environment = stage.scene.environment
        assert environment is not None, "the effect is left out of scenes without one"
        self._map = None if environment.map is None else EnvironmentMap(stage.device, environment)

    def defines(self, _light: int | None) -> dict[str, object]:
        """Whether there is a map."""
        return {"SURROUNDED_BY_MAP": self._map is not None}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Nothing beside the effect's own."""
        return {}

    def textures(self, _light: int | None) -> dict[str, Any]:
        """The map."""
        return {} if self._map is None else dict(self._map.textures)
