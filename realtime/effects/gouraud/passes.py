"""Lights the vertices as if they were the pixels of a small picture, then draws the shapes with that light."""

from dataclasses import replace
from typing import Any

from ...discovery import effect
from ...effect import Knobs
from ...gbuffer import CHANNELS, GBuffer
from ...geometry import Geometry
from ...graph import Step
from ...light_bounds import Rectangle
from ...projection import projection_matrix, view_matrix
from ...shaders import source
from ...shading import ShadingPass
from ...stage import Stage
from ...uniforms import bind, set_uniforms
from .vertices import vertex_points


class Passes:
    """Draws each light's picture: its light at the vertices, interpolated."""

    per_sample = True

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        device = stage.device
        self._stage, self._model = stage, str(knobs["model"])
        points, self._firsts = vertex_points(stage.scene)
        rows, width = points.shape.shape
        vertices = _as_pixels(stage, (width, rows))
        vertices.gbuffer.load(points)
        model = effect(self._model)
        self._lighting = VertexShading(vertices, model, model.settings({}), separate=True)
        self._lit = device.target((width, rows))
        self._lit_buffer = device.framebuffer([self._lit])
        self._picture = device.target(stage.size)
        self._picture_buffer = device.framebuffer([self._picture], device.gl.depth_renderbuffer(stage.size))
        self._program = device.program(
            source("lit_vertex.frag", folder=folder), source("lit_vertex.vert", folder=folder)
        )
        self._batches = [(batch, batch.vertices(device, self._program)) for batch in stage.geometry.batches]

    def draw(self, light: int) -> None:
        """Light the vertices, and draw the shapes where the G-buffer was sampled."""
        stage = self._stage
        gl, scene = stage.device.gl, stage.scene
        self._lit_buffer.clear()
        self._lighting.draw(Step(self._model, ("direct",), (), light), self._lit_buffer, {})
        self._picture_buffer.use()
        self._picture_buffer.clear()
        gl.enable_only(gl.DEPTH_TEST)
        matrix = projection_matrix(scene.camera, stage.size, stage.gbuffer.offset) @ view_matrix(scene.camera)
        bind(self._program, {"vertex_light": self._lit})
        for batch, vertices in self._batches:
            set_uniforms(self._program, {"view_projection": matrix, "first_vertex": self._firsts[batch.shape]})
            stage.device.draw(vertices, batch.count)

    def defines(self, _light: int) -> dict[str, object]:
        """None: the vertices are lit by the model's own shader."""
        return {}

    def uniforms(self, _light: int) -> dict[str, Any]:
        """None, likewise."""
        return {}

    def textures(self, _light: int) -> dict[str, Any]:
        """The picture of the light that was drawn last."""
        return {"interpolated_light": self._picture}


class VertexShading(ShadingPass):
    """An effect's shading of vertices: a light's range bounds none of them, as it bounds pixels."""

    def part(self, step: Step) -> Rectangle | None:
        """All vertices."""
        return 0, 0, *self._stage.size


def _as_pixels(stage: Stage, size: tuple[int, int]) -> Stage:
    """A stage whose G-buffer has a pixel for each vertex, and draws nothing."""
    device = stage.device
    geometry = Geometry(device, replace(stage.scene, shapes=()))
    scene = replace(stage.scene, environment=None)
    gbuffer = GBuffer(device, geometry, scene, size, frozenset(CHANNELS), device.target(size))
    return replace(stage, geometry=geometry, gbuffer=gbuffer, size=size)
