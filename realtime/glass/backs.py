"""The backs of solids as the camera sees them: where rays leave, for techniques that refract twice."""

from typing import Any

from ..projection import projection_matrix, view_matrix
from ..shaders import source
from ..stage import Stage
from ..uniforms import set_uniforms


class SolidBacks:
    """The normals and positions of the faces of solids that are turned away, the farthest of each pixel.

    Attributes:
        normal: RGB the normal, out of the solid; A 1 where there is a back.
        position: world space.
    """

    def __init__(self, stage: Stage) -> None:
        device = stage.device
        self._stage = stage
        self.normal, self.position = (device.target(stage.size) for _ in range(2))
        device.counts["textures"] += 1
        depth = device.gl.depth_renderbuffer(stage.size)
        self._framebuffer = device.framebuffer([self.normal, self.position], depth)
        self._program = device.program(source("solid_backs.frag"), source("gbuffer.vert"))
        self._draws = [
            (batch.vertices(device, self._program), batch.count)
            for batch in stage.geometry.batches
            if batch.material.is_glass
        ]

    def draw(self) -> None:
        """Draw them as the G-buffer's sample sees them."""
        gl, stage = self._stage.device.gl, self._stage
        camera = stage.scene.camera
        self._framebuffer.use()
        self._framebuffer.clear(depth=0.0)
        gl.enable_only(gl.DEPTH_TEST)
        gl.depth_func = ">"
        matrix = projection_matrix(camera, stage.size, stage.gbuffer.offset) @ view_matrix(camera)
        set_uniforms(self._program, {"view_projection": matrix})
        for vertices, count in self._draws:
            stage.device.draw(vertices, count)
        gl.depth_func = "<"

    @property
    def textures(self) -> dict[str, Any]:
        """By the names that shaders read them by."""
        return {"back_normal": self.normal, "back_position": self.position}

    @property
    def view_projection(self):
        """(4, 4) float64: world to where a point lies in them."""
        camera = self._stage.scene.camera
        return projection_matrix(camera, self._stage.size) @ view_matrix(camera)
