"""Draws the shadow maps; the comparison is in shadow_map.glsl."""

from typing import Any

from ...effect import Knobs
from ...gbuffer import material_uniforms, texture_declaration, usable_slots
from ...geometry import Batch
from ...shaders import Source, source
from ...stage import Stage
from ...uniforms import bind, set_uniforms
from .views import ShadowViews, shadow_views

DEPTH_ONLY = "void main() {}\n"


class Passes:
    """The shadow maps of one frame: lights of a kind share one map, since they are drawn one after the other."""

    def __init__(self, stage: Stage, knobs: Knobs, folder) -> None:
        self._stage, self._folder = stage, folder
        self._resolution = int(knobs["resolution"])
        self._radius = 1 if knobs["filter"] == "pcf3" else 0
        self._maps: dict[bool, Any] = {}
        self._views: dict[int, ShadowViews] = {}
        self._program: Any = None
        self._masked: dict[int, Any] = {}
        self._programs: dict[tuple, Any] = {}

    def defines(self, light: int) -> dict[str, object]:
        """What the comparison's shader is compiled with."""
        views = len(self.views(light).matrices)
        return {"VIEWS": views, "RESOLUTION": self._resolution, "FILTER_RADIUS": self._radius}

    def views(self, light: int) -> ShadowViews:
        """The light's views."""
        if light not in self._views:
            scene = self._stage.scene
            # One texel more than the filter reaches, for rounding at the edge.
            border = self._radius + 1
            self._views[light] = shadow_views(scene, scene.all_lights[light], self._resolution, border)
        return self._views[light]

    def draw(self, light: int) -> None:
        """Fill the map of the light's kind."""
        views = self.views(light)
        framebuffer, _ = self._map(views.is_cube)
        device = self._stage.device
        framebuffer.viewport = (0, 0, *framebuffer.size)
        framebuffer.use()
        framebuffer.clear()
        device.gl.enable_only(device.gl.DEPTH_TEST)
        side = self._resolution
        for face, matrix in enumerate(views.matrices):
            framebuffer.viewport = (face % 3 * side, face // 3 * side, side, side)
            self._draw_shapes(matrix, views.excluded)

    def uniforms(self, light: int) -> dict[str, Any]:
        """What the comparison is told of the light's views."""
        views = self.views(light)
        return {"shadow_matrices": views.matrices, "shadow_light": views.position, "shadow_texel": views.texel}

    def textures(self, light: int) -> dict[str, Any]:
        """What the comparison reads."""
        return {"shadow_map": self._map(self.views(light).is_cube)[1]}

    def _map(self, is_cube: bool):
        if is_cube not in self._maps:
            device, side = self._stage.device, self._resolution
            texture = device.depth((3 * side, 2 * side) if is_cube else (side, side))
            self._maps[is_cube] = device.framebuffer([], texture), texture
        return self._maps[is_cube]

    def _draw_shapes(self, matrix, excluded: int | None) -> None:
        device, geometry = self._stage.device, self._stage.geometry
        if self._program is None:
            self._program = device.program(source(DEPTH_ONLY), source("gbuffer.vert"))
            self._solid = geometry.solid.vertices(device, self._program)
        set_uniforms(self._program, {"view_projection": matrix})
        for first, count in geometry.solid.ranges(excluded):
            device.draw(self._solid, count, first)
        for batch in geometry.batches:
            if batch.material.alpha_mode == "mask" and batch.shape != excluded:
                self._draw_masked(batch, matrix)

    def _draw_masked(self, batch: Batch, matrix) -> None:
        device, geometry = self._stage.device, self._stage.geometry
        if batch.shape not in self._masked:
            program = self._masked_program(batch)
            self._masked[batch.shape] = program, batch.vertices(device, program)
        program, vertices = self._masked[batch.shape]
        set_uniforms(program, material_uniforms(batch.material) | {"view_projection": matrix})
        bind(program, {f"{slot}_texture": geometry.texture(t) for slot, t in batch.material.textures.items()})
        device.draw(vertices, batch.count)

    def _masked_program(self, batch: Batch):
        """A program that leaves holes where the shape's alpha is below its cut-off, as the G-buffer's does."""
        slots = tuple(slot for slot in usable_slots(batch) if slot[0] == "base_color")
        key = batch.has, slots
        if key not in self._programs:
            defines: dict[str, object] = {f"HAS_{name.upper()}": True for name in batch.has}
            defines["TEXTURE_BASE_COLOR"] = bool(slots)
            fragment = source("masked.frag", defines, self._folder).text
            fragment = fragment.replace("TEXTURE_DECLARATIONS", "\n".join(map(texture_declaration, slots)))
            self._programs[key] = self._stage.device.program(Source(fragment), source("gbuffer.vert", defines))
        return self._programs[key]
