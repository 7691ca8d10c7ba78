"""Bakes the open shares into vertices, and draws them."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ...effect import Knobs
from ...gbuffer import material_uniforms, texture_declaration, usable_slots
from ...geometry import Batch
from ...shaders import Source, source
from ...stage import Stage
from ...uniforms import bind, set_uniforms
from .dividing import baked_arrays
from .sky import Sky

KEPT = "in float vertex_open;\nout vec4 found;\nvoid keep() { found = vec4(vertex_open); }\n"
HANDED_ON = "in float open_share;\nout float vertex_open;\nvoid main() {\n    vertex_open = open_share;"


class Passes:
    """One more draw of the scene, of nothing but what was baked.

    Attributes:
        baked: a batch per shape, with the vertices that were baked into; set once `bake` was called.
    """

    baked: tuple[Batch, ...]

    def __init__(self, stage: Stage, knobs: Knobs, _folder: Path) -> None:
        self._stage, self._knobs = stage, knobs
        device = stage.device
        self._found = device.target(stage.size)
        self._framebuffer = device.framebuffer([self._found], device.depth(stage.size))
        self._programs: dict[tuple, Any] = {}
        self._vertices: dict[int, tuple[Any, Any]] = {}

    def bake(self) -> tuple[Batch, ...]:
        """The shapes with an attribute more, `open_share`."""
        sky = Sky(self._stage, int(self._knobs["map"]))
        shapes = [self._stage.scene.shapes[batch.shape] for batch in self._stage.geometry.batches]
        spacing = float(self._knobs["spacing"])
        divided = [baked_arrays(shape.world, spacing, bool(shape.material.textures)) for shape in shapes]
        positions, normals = (
            np.concatenate([np.zeros((0, 3)), *(arrays[name] for arrays, _ in divided)]).astype(np.float64)
            for name in ("position", "normal")
        )
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        positions += float(self._knobs["bias"]) * sky.texel * normals
        shares = sky.open_shares(positions, normals, int(self._knobs["directions"])).astype(np.float32)
        ends = np.cumsum([len(arrays["position"]) for arrays, _ in divided])
        each = np.split(shares, ends[:-1])
        return tuple(
            self._batch(batch, arrays | {"open_share": share[:, None]}, indices)
            for batch, (arrays, indices), share in zip(self._stage.geometry.batches, divided, each, strict=True)
        )

    def _batch(self, batch: Batch, arrays: dict[str, np.ndarray], indices: np.ndarray | None) -> Batch:
        gl = self._stage.device.gl
        buffers = {
            name: (f"{array.shape[1]}f", gl.buffer(np.ascontiguousarray(array).tobytes()))
            for name, array in arrays.items()
        }
        elements = None if indices is None else gl.buffer(indices.astype(np.uint32).tobytes())
        count = len(arrays["position"]) if indices is None else indices.size
        return replace(batch, buffers=buffers, indices=elements, count=count)

    def defines(self, _light: int | None) -> dict[str, object]:
        """Nothing but what the knobs say."""
        return {}

    def uniforms(self, _light: int | None) -> dict[str, Any]:
        """Nothing."""
        return {}

    def textures(self, _light: int | None) -> dict[str, Any]:
        """The open shares, at every pixel."""
        return {"baked_buffer": self._found}

    def draw(self, _light: int | None) -> None:
        """Draw what was baked, at the sub-pixel offset of the G-buffer."""
        device, geometry = self._stage.device, self._stage.geometry
        self._framebuffer.use()
        self._framebuffer.clear(1.0, 1.0, 1.0, 1.0)
        device.gl.enable_only(device.gl.DEPTH_TEST)
        seen_from = {"view_projection": self._stage.gbuffer.view_projection}
        for batch in self.baked:
            if batch.shape not in self._vertices:
                program = self._program(batch)
                self._vertices[batch.shape] = program, batch.vertices(device, program)
            program, vertices = self._vertices[batch.shape]
            set_uniforms(program, material_uniforms(batch.material) | seen_from)
            bind(program, {f"{slot}_texture": geometry.texture(t) for slot, t in batch.material.textures.items()})
            device.draw(vertices, batch.count)

    def _program(self, batch: Batch):
        """A program that interpolates the shares, with holes where a masked shape has them."""
        masked = batch.material.alpha_mode == "mask"
        slots = tuple(slot for slot in usable_slots(batch) if masked and slot[0] == "base_color")
        key = masked, batch.has, slots
        if key not in self._programs:
            defines: dict[str, object] = {f"HAS_{name.upper()}": masked for name in batch.has}
            fragment = source(
                "shadow_caster.frag", defines | {"MASKED": masked, "TEXTURE_BASE_COLOR": bool(slots)}
            ).text
            fragment = fragment.replace("TEXTURE_DECLARATIONS", "\n".join(map(texture_declaration, slots)))
            vertex = source("gbuffer.vert", defines).text.replace("void main() {", HANDED_ON)
            program = self._stage.device.program(Source(fragment.replace("KEPT", KEPT)), Source(vertex))
            self._programs[key] = program
        return self._programs[key]
