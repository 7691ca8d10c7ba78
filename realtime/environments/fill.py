"""A texture that one full-screen pass fills once."""

from collections.abc import Mapping
from typing import Any

from ..device import Device
from ..shaders import Source
from ..uniforms import Uniforms, bind


def fill(
    device: Device, shader: Source, size: tuple[int, int], uniforms: Mapping[str, Any], textures: Mapping[str, Any]
):
    """A texture of width and height, float, every texel drawn by the fragment shader."""
    texture = device.target(size)
    program = device.program(shader)
    Uniforms(program, dict(uniforms)).write()
    bind(program, dict(textures))
    device.framebuffer([texture]).use()
    device.gl.enable_only(device.gl.NOTHING)
    device.draw(device.fullscreen(program), 3)
    return texture
