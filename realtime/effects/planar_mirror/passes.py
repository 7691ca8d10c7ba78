"""Draws what each mirror shows."""

from dataclasses import replace
from typing import Any

import numpy as np

from ...effect import Knobs
from ...lit_views import LitViews
from ...projection import projection_matrix, view_matrix
from ...reflections.mirrors import FlatMirror, clipped_at, flat_mirrors, reflection
from ...shadows.views import corners_of
from ...stage import Stage

EXCHANGED = np.diag([-1.0, 1.0, 1.0, 1.0])
"""Left and right exchanged: a mirrored view of triangles turns them round, and this turns them back."""


class Passes:
    """A view for each mirror, drawn once a frame."""

    def __init__(self, stage: Stage, knobs: Knobs, _folder) -> None:
        self._stage = stage
        self._mirrors = flat_mirrors(stage.scene)[: int(knobs["mirrors"])]
        tile = tuple(max(1, round(side * float(knobs["scale"]))) for side in stage.size)
        self._views = []
        for mirror in self._mirrors:
            eye = reflection(mirror.plane) @ stage.viewer
            self._views.append(LitViews(stage, 1, (tile[0], tile[1]), eye, float(knobs["ambient"])))

    def draw(self, _light: int | None) -> None:
        """Draw every mirror's picture."""
        for mirror, view in zip(self._mirrors, self._views, strict=True):
            view.draw([self._matrix(mirror)], {mirror.shape})

    def _matrix(self, mirror: FlatMirror) -> np.ndarray:
        """World to the clip space of the mirrored camera; what lies behind the mirror is cut away."""
        stage, camera = self._stage, self._stage.scene.camera
        view = view_matrix(camera) @ reflection(mirror.plane)
        # In the mirrored camera's space the scene in front of the mirror lies beyond it.
        plane = mirror.plane @ np.linalg.inv(view)
        # Mirrored, the camera stands farther from the scene; the clipped view's far plane slopes, too.
        corners = np.column_stack([corners_of(stage.scene), np.ones(8)])
        farthest = replace(camera, far=max(camera.far, 10 * float(np.max(-(corners @ view[2])))))
        projection = projection_matrix(farthest, stage.size, stage.gbuffer.offset)
        return EXCHANGED @ clipped_at(projection, plane) @ view

    def defines(self, _light: int | None) -> dict[str, object]:
        """How many mirrors."""
        return {"MIRRORS": len(self._mirrors)}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Where the mirrors are."""
        low, high = self._stage.scene.bounds
        return {
            "mirror_planes": np.stack([mirror.plane for mirror in self._mirrors]),
            "image_size": np.array(self._stage.size),
            # float32 positions: some roundings of the largest coordinate.
            "tolerance": 32 * 2.0**-23 * float(np.abs([low, high]).max()),
        }

    def textures(self, _light: int | None) -> dict[str, Any]:
        """The mirrors' pictures."""
        return {"mirror_images": [view.texture for view in self._views]}
