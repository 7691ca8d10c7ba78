"""Pictures that passes draw, and look up between the pixels."""

from typing import Any

from ..device import Device

Size = tuple[int, int]


class Canvas:
    """A texture of four floats, and the framebuffer that draws it."""

    def __init__(self, device: Device, size: Size) -> None:
        self.size = size
        self.texture: Any = device.target(size)
        self.framebuffer: Any = device.framebuffer([self.texture])
        interpolate(device, self.texture)


class Codes:
    """A texture of code values in 8 bits, and the framebuffer that draws it."""

    def __init__(self, device: Device, size: Size) -> None:
        self.texture: Any = device.target(size, dtype="f1")
        self.framebuffer: Any = device.framebuffer([self.texture])


def interpolate(device: Device, texture: Any) -> None:
    """Have `texture` look a picture up bilinearly, and beyond its edge as at it."""
    texture.filter = device.gl.LINEAR, device.gl.LINEAR
    texture.repeat_x = texture.repeat_y = False


def part_of(size: Size, divisor: int) -> Size:
    """A size in blocks of so many pixels; the last may reach over the edge."""
    return -(-size[0] // divisor), -(-size[1] // divisor)
