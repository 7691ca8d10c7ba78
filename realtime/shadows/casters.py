"""Draws what stands in a light's way, as the light sees it."""

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from ..gbuffer import material_uniforms, texture_declaration, usable_slots
from ..geometry import Batch
from ..shaders import Source, source
from ..stage import Stage
from ..uniforms import bind, set_uniforms

DEPTH_ONLY = "void keep() {}\n"
CULLED = {"front": "back", "back": "front"}


class Casters:
    """Every shape, drawn into the framebuffer in use.

    Args:
        faces: "both", or only those that face the light ("front") or away from it ("back"). A double-sided shape is
            drawn whole.
        kept: GLSL that defines `void keep()`: what a fragment writes besides its depth.
        folder: where `kept` finds what it includes.
    """

    def __init__(self, stage: Stage, faces: str = "both", kept: str = DEPTH_ONLY, folder: Path | None = None) -> None:
        self._stage, self._culled = stage, CULLED.get(faces)
        self._kept, self._folder = kept, folder
        shapes = enumerate(stage.scene.shapes)
        self._whole = {i for i, shape in shapes if self._culled is None or shape.material.double_sided}
        self._solid: Any = None
        self._masked: dict[int, Any] = {}
        self._programs: dict[tuple, Any] = {}

    def draw(self, values: Mapping[str, Any], excluded: int | None) -> None:
        """Draw all but the excluded shape.

        Args:
            values: uniforms: the matrix `view_projection`, and what `kept` reads.
        """
        shapes = set(range(len(self._stage.scene.shapes))) - {excluded}
        self._draw_shapes(shapes & self._whole, values)
        if self._culled is not None:
            gl = self._stage.device.gl
            gl.enable_only(gl.DEPTH_TEST | gl.CULL_FACE)
            gl.cull_face = self._culled
            self._draw_shapes(shapes - self._whole, values)
            gl.enable_only(gl.DEPTH_TEST)

    def _draw_shapes(self, shapes: Collection[int], values: Mapping[str, Any]) -> None:
        geometry = self._stage.geometry
        if self._solid is None:
            program = self._program({}, ())
            self._solid = program, geometry.solid.vertices(self._stage.device, program)
        program, vertices = self._solid
        set_uniforms(program, dict(values))
        for first, count in geometry.solid.ranges(shapes):
            self._stage.device.draw(vertices, count, first)
        for batch in geometry.batches:
            if batch.material.alpha_mode == "mask" and batch.shape in shapes:
                self._draw_masked(batch, values)

    def _draw_masked(self, batch: Batch, values: Mapping[str, Any]) -> None:
        device, geometry = self._stage.device, self._stage.geometry
        if batch.shape not in self._masked:
            slots = tuple(slot for slot in usable_slots(batch) if slot[0] == "base_color")
            defines: dict[str, object] = {f"HAS_{name.upper()}": True for name in batch.has}
            program = self._program(defines | {"MASKED": True, "TEXTURE_BASE_COLOR": bool(slots)}, slots)
            self._masked[batch.shape] = program, batch.vertices(device, program)
        program, vertices = self._masked[batch.shape]
        set_uniforms(program, material_uniforms(batch.material) | dict(values))
        bind(program, {f"{slot}_texture": geometry.texture(t) for slot, t in batch.material.textures.items()})
        device.draw(vertices, batch.count)

    def _program(self, defines: dict[str, object], slots: tuple):
        """A program that keeps what it is told to, with holes where a masked shape's alpha is below its cut-off."""
        key = tuple(sorted(defines)), slots
        if key not in self._programs:
            fragment = source("shadow_caster.frag", defines).text
            kept = source(self._kept, folder=self._folder).text.removeprefix("#version 410\n")
            fragment = fragment.replace("TEXTURE_DECLARATIONS", "\n".join(map(texture_declaration, slots)))
            fragment = fragment.replace("KEPT", kept)
            self._programs[key] = self._stage.device.program(Source(fragment), source("gbuffer.vert", defines))
        return self._programs[key]
