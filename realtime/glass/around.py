"""What solids show: the environment, and the surfaces around them."""

from typing import Any

import numpy as np

from lightmeter.scenes.model import Light, Scene

from ..effect import Knob, Knobs
from ..environment_map import EnvironmentMap
from ..reflections.cubes import LitCube
from ..reflections.knobs import AMBIENT
from ..reflections.mirrors import box_of
from ..stage import Stage

AROUND = Knob(
    "around",
    "scene",
    "What is seen: the environment alone, or before it the surfaces around, in a cube map about the largest solid, "
    "baked once; what they emit is not in it.",
    choices=("environment", "scene"),
    sweep=("environment", "scene"),
)
AROUND_KNOBS = (AROUND, AMBIENT)
AROUND_SIZE = 256
"""Side of each face of that cube map."""


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


def largest_solids(scene: Scene, count: int) -> tuple[int, ...]:
    """The shapes that bound dielectric solids, the largest boxes first."""
    solids = [i for i, shape in enumerate(scene.shapes) if shape.material.is_glass and len(shape.mesh.triangles)]

    def diagonal(index: int) -> float:
        low, high = box_of(scene.shapes[index])
        return float(np.linalg.norm(high - low))

    return tuple(sorted(solids, key=diagonal, reverse=True)[:count])


class SurroundedPasses:
    """An effect's `Passes` derives from this: it holds the environment's map and the surfaces around, if any.

    Attributes:
        baked: what `bake` gave; here the surfaces around, None where none are looked at.
    """

    baked: Any

    def __init__(self, stage: Stage, knobs: Knobs, _folder) -> None:
        scene, environment = stage.scene, stage.scene.environment
        assert environment is not None, "the effect is left out of scenes without one"
        self._stage, self._knobs = stage, knobs
        self._map = None if environment.map is None else EnvironmentMap(stage.device, environment)
        opaque = any(not shape.material.is_glass and len(shape.mesh.triangles) for shape in scene.shapes)
        self._sees_surfaces = opaque and knobs["around"] == "scene"

    def bake(self) -> Any:
        """The surfaces around the largest solid, as they are lit."""
        return self._surfaces()

    def _surfaces(self) -> LitCube | None:
        scene = self._stage.scene
        if not self._sees_surfaces:
            return None
        low, high = box_of(scene.shapes[largest_solids(scene, 1)[0]])
        cube = LitCube(self._stage, (low + high) / 2, AROUND_SIZE, float(self._knobs["ambient"]))
        cube.draw(set(largest_solids(scene, len(scene.shapes))))
        return cube

    @property
    def _around(self) -> LitCube | None:
        return self.baked

    def defines(self, _light: int | None) -> dict[str, object]:
        """Whether there is a map, and whether surfaces are looked at."""
        return {"SURROUNDED_BY_MAP": self._map is not None, "SURROUNDED_BY_SCENE": self._sees_surfaces}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Where the cube map looks from."""
        return {} if self._around is None else self._around.uniforms

    def textures(self, _light: int | None) -> dict[str, Any]:
        """The map, and the surfaces."""
        found = {} if self._map is None else dict(self._map.textures)
        if self._around is not None:
            found |= {"cube_images": [self._around.image], "around_places": self._around.places}
        return found
