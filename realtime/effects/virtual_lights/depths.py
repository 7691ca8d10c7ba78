"""What each virtual light sees: a low depth map, wide open along its normal, in a tile of one texture."""

import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from ...shaders import source
from ...stage import Stage
from ...uniforms import bind, set_uniforms


class VirtualDepths:
    """The maps of all virtual lights. Masked shapes are not in them.

    Args:
        count: how many virtual lights.
        side: texels along a map's side.
        planes: near and far of the views, metres.

    Attributes:
        texture: the maps, row by row from the lower left, as square as can be.
    """

    def __init__(self, stage: Stage, folder: Path, count: int, side: int, planes: np.ndarray) -> None:
        self._stage, self._side, self._columns = stage, side, math.ceil(math.sqrt(count))
        size = self._columns * side, math.ceil(count / self._columns) * side
        self.texture = stage.device.depth(size)
        self._framebuffer = stage.device.framebuffer([], self.texture)
        self._program = stage.device.program(source("void main() {}\n"), source("depths.vert", folder=folder))
        set_uniforms(self._program, {"planes": planes})
        self._vertices = stage.geometry.solid.vertices(stage.device, self._program)
        self._pieces = stage.geometry.solid.ranges(range(len(stage.scene.shapes)))

    def draw(self, virtual_lights: dict[str, Any], which: Iterable[int]) -> None:
        """Draw the maps of some virtual lights, whose textures are given."""
        device, gl, side = self._stage.device, self._stage.device.gl, self._side
        self._framebuffer.use()
        gl.enable_only(gl.DEPTH_TEST)
        bind(self._program, virtual_lights)
        for light in which:
            column, row = light % self._columns * side, light // self._columns * side
            self._framebuffer.viewport = self._framebuffer.scissor = (column, row, side, side)
            self._framebuffer.clear()
            set_uniforms(self._program, {"light": light})
            for first, count in self._pieces:
                device.draw(self._vertices, count, first)
        self._framebuffer.scissor = None
