"""The screen that rays are marched over: the lit frame with ambient light, the pyramid of depths, the fallback."""

from typing import Any

import numpy as np

from lightmeter.scenes.projection import clip_from_camera

from ...discovery import effect
from ...effect import Knobs
from ...graph import Step
from ...lit_views import AMBIENT
from ...projection import view_matrix
from ...reflections.baked_cube import BakedCube
from ...reflections.cubes import LitCube, proxy
from ...shading import ShadingPass
from ...stage import Stage
from .depth_pyramid import DepthPyramid

CUBE_SIZE = 128
"""Texels along the faces of the fallback's cube map."""

AMBIENT_STEP = Step(AMBIENT, ("indirect",))


class Passes:
    """What is drawn once a frame, and what a fallback needs."""

    baked: LitCube

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        assert stage.scattered is not None, "the effect declares that it reads the lit frame"
        self._stage, self._knobs = stage, knobs
        camera = stage.scene.camera
        self._depth_plane = -view_matrix(camera)[2]
        self._pyramid = DepthPyramid(stage, self._depth_plane) if knobs["march"] == "hierarchical" else None
        self._ambient = None
        if float(knobs["ambient"]) > 0:
            self._ambient = ShadingPass(stage, effect(AMBIENT), {"indirect": knobs["ambient"]})
        self._cube = knobs["fallback"] == "cube"
        if self._cube:
            self.bake = BakedCube(stage, {"size": CUBE_SIZE, "ambient": knobs["ambient"]}, folder).bake

    def draw(self, _light: int | None) -> None:
        """Add ambient light to what is lit so far, and build the pyramid."""
        if self._ambient is not None and self._stage.scattered is not None:
            self._ambient.draw(AMBIENT_STEP, self._stage.scattered.framebuffer, {})
        if self._pyramid is not None:
            self._pyramid.draw()

    def defines(self, _light: int | None) -> dict[str, object]:
        """Sizes, and what a ray that meets nothing sees."""
        found: dict[str, object] = {"FALLBACK_CUBE": self._cube, "CUBES": 1 if self._cube else None}
        if self._pyramid is not None:
            found["LEVELS"] = len(self._pyramid.places)
        return found

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """How the screen lies in the world."""
        scene, size = self._stage.scene, self._stage.size
        values: dict[str, Any] = {
            "screen_from_world": clip_from_camera(scene.camera, size) @ view_matrix(scene.camera),
            "depth_plane": self._depth_plane,
            "screen_size": np.array(size),
            "nearest": scene.camera.near,
        }
        if self._pyramid is not None:
            values["level_places"] = self._pyramid.places
        return values | (self.baked.uniforms | proxy(scene) if self._cube else {})

    def textures(self, _light: int | None) -> dict[str, Any]:
        """The pyramid and the cube map, where there are any."""
        found: dict[str, Any] = {}
        if self._pyramid is not None:
            found["least_depths"] = self._pyramid.texture
        if self._cube:
            found["cube_images"] = [self.baked.image]
        return found
