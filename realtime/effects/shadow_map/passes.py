"""Draws the shadow maps; the comparison is in shadow_map.glsl."""

from typing import Any

from ...device import set_uniforms
from ...effect import Knobs
from ...gbuffer import material_uniforms, texture_declaration, usable_slots
from ...shaders import Source, source
from ...stage import Stage
from .views import ShadowViews, shadow_views

DEPTH_ONLY = "void main() {}\n"
MASKED = """#include "textures.glsl"
in vec2 uv0;
#ifdef HAS_TEXCOORD1
in vec2 uv1;
#endif
uniform vec4 base_color_factor;
uniform float alpha_cutoff;
DECLARATION
void main() {
    if (base_color_factor.a * look_up_base_color().a < alpha_cutoff) discard;
}
"""


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

    def defines(self, light: int) -> dict[str, object]:
        """What the comparison's shader is compiled with."""
        views = len(self.views(light).matrices)
        return {"VIEWS": views, "RESOLUTION": self._resolution, "FILTER_RADIUS": self._radius}

    def views(self, light: int) -> ShadowViews:
        """The light's views."""
        if light not in self._views:
            scene = self._stage.scene
            self._views[light] = shadow_views(scene, scene.all_lights[light], self._resolution)
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

    def bindings(self, light: int) -> tuple[dict[str, Any], dict[str, Any]]:
        """Uniforms and textures of the comparison."""
        views = self.views(light)
        uniforms = {
            "shadow_matrices": views.matrices,
            "shadow_light": views.position,
            "shadow_texel": views.texel,
        }
        return uniforms, {"shadow_map": self._map(views.is_cube)[1]}

    def _map(self, is_cube: bool):
        if is_cube not in self._maps:
            device, side = self._stage.device, self._resolution
            texture = device.depth((3 * side, 2 * side) if is_cube else (side, side))
            self._maps[is_cube] = device.framebuffer([], texture), texture
        return self._maps[is_cube]

    def _draw_shapes(self, matrix, excluded: int | None) -> None:
        device, geometry = self._stage.device, self._stage.geometry
        if self._program is None:
            self._program = device.program(source(DEPTH_ONLY), source("depth.vert", folder=self._folder))
            self._solid = geometry.solid.vertices(device, self._program)
        set_uniforms(self._program, {"view_projection": matrix})
        for first, count in geometry.solid.ranges(excluded):
            device.draw(self._solid, count, first)
        for batch in geometry.batches:
            if batch.material.alpha_mode == "mask" and batch.shape != excluded:
                self._draw_masked(batch, matrix)

    def _draw_masked(self, batch, matrix) -> None:
        device, geometry = self._stage.device, self._stage.geometry
        slot = next((s for s in usable_slots(batch) if s[0] == "base_color"), None)
        if batch.shape not in self._masked:
            defines = {"ALPHA_MASK": slot is not None, "HAS_TEXCOORD1": "texcoord1" in batch.has}
            text = DEPTH_ONLY if slot is None else MASKED
            fragment = source(text, defines).text.replace("DECLARATION", texture_declaration(slot) if slot else "")
            program = device.program(Source(fragment), source("depth.vert", defines, self._folder))
            self._masked[batch.shape] = program, batch.vertices(device, program)
        program, vertices = self._masked[batch.shape]
        set_uniforms(program, material_uniforms(batch.material) | {"view_projection": matrix})
        if slot:
            geometry.texture(batch.material.base_color_texture).use(0)
            program["base_color_texture"].value = 0
        device.draw(vertices, batch.count)
