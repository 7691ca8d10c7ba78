"""Cube maps drawn into the tiles of one texture; `cube_atlas.glsl` has the layout."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..device import Device
from ..shaders import source
from ..uniforms import Uniforms, bind, set_uniforms


def first_row(level: int, side: int) -> int:
    """The row that a level's tiles start in, as in the GLSL."""
    return 2 * (side - (side >> level)) + 2 * level


def bake_atlas(
    device: Device,
    side: int,
    levels: int,
    baked: str,
    defines: Mapping[str, object],
    uniforms: Mapping[str, Any],
    textures: Mapping[str, Any],
    folder: Path | None = None,
):
    """A texture with every level of a cube map, filtered linearly by the hardware.

    Args:
        side: of the finest faces, a power of two.
        baked: GLSL with `vec3 baked(vec3 direction, int level)`.
    """
    texture = device.target((6 * (side + 2), first_row(levels, side)))
    texture.filter = (device.gl.LINEAR, device.gl.LINEAR)
    target = device.framebuffer([texture])
    text = source("cube_atlas.frag").text.removeprefix("#version 410\n").replace("BAKED", baked)
    program = device.program(source(text, {"SIDE": side} | dict(defines), folder))
    vertices = device.fullscreen(program)
    Uniforms(program, dict(uniforms)).write()
    bind(program, dict(textures))
    target.use()
    device.gl.enable_only(device.gl.NOTHING)
    for level in range(levels):
        target.viewport = (0, first_row(level, side), 6 * ((side >> level) + 2), (side >> level) + 2)
        set_uniforms(program, {"level": level, "least_angle": 4 * np.pi / (6 * (side >> level) ** 2)})
        device.draw(vertices, 3)
    return texture


def faces_of(device: Device, atlas: Any, side: int) -> np.ndarray:
    """(6, side, side, 4) float32: the finest level's faces, without their borders, rows as OpenGL takes them."""
    rows = device.read(atlas)[::-1][: side + 2].reshape(side + 2, 6, side + 2, 4)
    return np.ascontiguousarray(rows[1:-1, :, 1:-1].swapaxes(0, 1))
