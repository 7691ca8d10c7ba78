"""Weighted sums of images on the device."""

from .device import Device
from .shaders import source


class Averager:
    """Adds an image, weighted, to another: the accumulation buffer of Haeberli & Akeley (1990)."""

    def __init__(self, device: Device) -> None:
        self._device = device
        text = """uniform sampler2D image;
uniform float weight;
out vec4 result;
void main() { result = weight * texelFetch(image, ivec2(gl_FragCoord.xy), 0); }
"""
        self._program = device.program(source(text))
        self._vertices = device.fullscreen(self._program)

    def add(self, image, target, weight: float) -> None:
        """Add `weight` times `image`, a texture, to the framebuffer `target`."""
        target.use()
        self._device.gl.enable_only(self._device.gl.BLEND)
        self._device.gl.blend_func = self._device.gl.ONE, self._device.gl.ONE
        image.use(0)
        self._program["weight"].value = weight
        self._device.draw(self._vertices, 3)
