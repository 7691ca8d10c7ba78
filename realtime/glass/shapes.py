"""Solids as they are from within: their tangent planes, in the faces of a cube about the middle."""

from typing import Any

import numpy as np

from ..geometry import Batch
from ..reflections.mirrors import box_of
from ..shaders import source
from ..shadows.views import cube_views
from ..stage import Stage
from ..uniforms import set_uniforms

MARGIN = 1e-4
"""Of the box's size: float32 positions on its faces lie inside."""


class SolidShape:
    """One solid's tangent planes: where each direction from its middle leaves it.

    Attributes:
        planes: texture of six faces, three beside each other: RGB the normal, out of the solid; A the plane's distance
            from the middle. Faces of a solid without shading normals are not interpolated: a facet is one plane.
        middle, low, high: (3,) world space; the box has a margin.
        views: (6, 4, 4) world to the faces' clip spaces.
    """

    def __init__(self, stage: Stage, shape: int, size: int) -> None:
        device = stage.device
        low, high = box_of(stage.scene.shapes[shape])
        margin = MARGIN * np.linalg.norm(high - low)
        self.middle, self.low, self.high = (low + high) / 2, low - margin, high + margin
        self.views = cube_views(stage.scene, self.middle, size, 0).matrices
        self.planes = device.target((3 * size, 2 * size))
        if stage.scene.shapes[shape].mesh.normals is not None:
            self.planes.filter = device.gl.LINEAR, device.gl.LINEAR
        self.planes.repeat_x = self.planes.repeat_y = False
        batch = next(batch for batch in stage.geometry.batches if batch.shape == shape)
        self._draw(stage, batch, size)

    def _draw(self, stage: Stage, batch: Batch, size: int) -> None:
        device = stage.device
        program = device.program(source("solid_planes.frag"), source("gbuffer.vert"))
        vertices = batch.vertices(device, program)
        framebuffer = device.framebuffer([self.planes], device.gl.depth_renderbuffer(self.planes.size))
        framebuffer.use()
        framebuffer.clear()
        device.gl.enable_only(device.gl.DEPTH_TEST)
        for face, view in enumerate(self.views):
            framebuffer.viewport = face % 3 * size, face // 3 * size, size, size
            set_uniforms(program, {"view_projection": view, "middle": self.middle})
            device.draw(vertices, batch.count)

    def uniforms(self) -> dict[str, Any]:
        """What `solid_planes.glsl` is told of it."""
        names = ("solid_middle", "solid_low", "solid_high")
        return dict(zip(names, (self.middle, self.low, self.high), strict=True)) | {"solid_views": self.views}
