"""Draws a cube map about each object."""

from typing import Any

import numpy as np

from ...effect import Knobs
from ...reflections.cubes import LitCube
from ...reflections.mirrors import box_of, mirroring_shapes
from ...stage import Stage

MARGIN = 1e-4
"""Of the box's size: float32 positions on its faces lie inside."""


class Passes:
    """Cube maps of the largest smooth shapes; the smallest box that holds a point counts."""

    def __init__(self, stage: Stage, knobs: Knobs, _folder) -> None:
        scene = stage.scene
        self._shapes = mirroring_shapes(scene)[: int(knobs["cubes"])]
        self._boxes = [box_of(scene.shapes[shape]) for shape in self._shapes]
        size, ambient = int(knobs["size"]), float(knobs["ambient"])
        self._cubes = [LitCube(stage, (low + high) / 2, size, ambient) for low, high in self._boxes]

    def draw(self, _light: int | None) -> None:
        """Draw all of them, each without its own object."""
        for shape, cube in zip(self._shapes, self._cubes, strict=True):
            cube.draw({shape})

    def defines(self, _light: int | None) -> dict[str, object]:
        """How many there are."""
        return {"CUBES": len(self._cubes)}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Where the cubes' faces look, and whose they are."""
        views = [cube.uniforms for cube in self._cubes]
        low, high = (np.stack(corners) for corners in zip(*self._boxes, strict=True))
        margin = MARGIN * np.linalg.norm(high - low, axis=1, keepdims=True)
        return {
            "cube_views": np.concatenate([view["cube_views"] for view in views]),
            "cube_centres": np.concatenate([view["cube_centres"] for view in views]),
            "object_low": low - margin,
            "object_high": high + margin,
        }

    def textures(self, _light: int | None) -> dict[str, Any]:
        """The faces."""
        return {"cube_images": [cube.image for cube in self._cubes]}
