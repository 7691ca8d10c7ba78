"""A full-screen pass that an effect draws for itself."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from .device import Device
from .light_bounds import Rectangle
from .shaders import Source
from .uniforms import Uniforms, bind, set_uniforms


class FullscreenPass:
    """One program over a whole framebuffer, or a part of it.

    Args:
        values: uniforms that stay.
    """

    def __init__(self, device: Device, fragment: Source, values: dict[str, Any]) -> None:
        self._device, self._program = device, device.program(fragment)
        self._uniforms = Uniforms(self._program, values)
        self._vertices = device.fullscreen(self._program)

    def draw(
        self,
        framebuffer: Any,
        textures: dict[str, Any],
        part: Rectangle | None = None,
        values: Mapping[str, Any] = MappingProxyType({}),
    ) -> None:
        """Draw; what was there is replaced.

        Args:
            textures: by the samplers' names.
            part: left, bottom, width and height of what is drawn; None: all of it.
            values: uniforms of this draw.
        """
        framebuffer.scissor = part
        framebuffer.use()
        self._device.gl.enable_only(self._device.gl.NOTHING)
        self._uniforms.write()
        set_uniforms(self._program, dict(values))
        bind(self._program, textures)
        self._device.draw(self._vertices, 3)
        framebuffer.scissor = None
