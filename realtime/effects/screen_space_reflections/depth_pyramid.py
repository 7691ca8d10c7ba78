"""The least depths of what the camera sees, over ever larger squares of pixels (Uludag 2014)."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from ...shaders import source
from ...stage import Stage
from ...uniforms import Uniforms, bind, set_uniforms

MOST_LEVELS = 8
"""Squares of 128 pixels; a shader reads no more textures at once than this and a few."""

NEAREST = """#include "surface.glsl"
uniform vec4 depth_plane;
out float least;
void main() {
    vec4 position = fetch_place(ivec2(gl_FragCoord.xy));
    least = position.w > 0.0 ? dot(depth_plane, vec4(position.xyz, 1.0)) : 3.4e38;
}
"""
COARSER = """uniform sampler2D finer;
out float least;
void main() {
    ivec2 last = textureSize(finer, 0) - 1, from = 2 * ivec2(gl_FragCoord.xy);
    float low = min(texelFetch(finer, from, 0).x, texelFetch(finer, min(from + ivec2(1, 0), last), 0).x);
    float high = min(texelFetch(finer, min(from + ivec2(0, 1), last), 0).x,
                     texelFetch(finer, min(from + 1, last), 0).x);
    least = min(low, high);
}
"""
BESIDE = """uniform sampler2D levels[LEVELS];
uniform ivec4 level_places[LEVELS];
out float least;
void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    least = 0.0;
    for (int i = 0; i < LEVELS; ++i) {
        ivec2 place = texel - level_places[i].xy;
        if (all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, level_places[i].zw)))
            least = texelFetch(levels[i], place, 0).x;
    }
}
"""


class DepthPyramid:
    """All levels in one texture, since the level that a ray reads differs from pixel to pixel.

    Attributes:
        places: (levels, 4) left, bottom, width and height of each in texels.
        texture: the levels, the finest at the left, the others above each other beside it.
    """

    def __init__(self, stage: Stage, depth_plane: np.ndarray) -> None:
        device = stage.device
        self._stage = stage
        width, height = stage.size
        sizes = [(width, height)]
        while max(sizes[-1]) > 1 and len(sizes) < MOST_LEVELS:
            sizes.append((-(-sizes[-1][0] // 2), -(-sizes[-1][1] // 2)))
        heights = np.cumsum([0, *(size[1] for size in sizes[1:])])
        self.places = np.array([(0, 0, *sizes[0]), *((width, heights[i], *s) for i, s in enumerate(sizes[1:]))])
        self._levels = [device.target(size, 1) for size in sizes]
        self._targets = [device.framebuffer([level]) for level in self._levels]
        beside = sizes[1][0] if len(sizes) > 1 else 0
        self.texture = device.target((width + beside, max(height, int(heights[-1]))), 1)
        self._target = device.framebuffer([self.texture])
        defines = stage.gbuffer.defines() | {"LEVELS": len(sizes)}
        self._passes = []
        for text in (NEAREST, COARSER, BESIDE):
            program = device.program(source(text, defines))
            values = Uniforms(program, {"depth_plane": depth_plane, "level_places": self.places})
            self._passes.append((program, device.fullscreen(program), values))

    def draw(self) -> None:
        """Build it from the G-buffer."""
        gbuffer = self._stage.gbuffer
        self._draw(0, self._targets[0], gbuffer.samplers, gbuffer.place)
        for finer, target in zip(self._levels, self._targets[1:], strict=False):
            self._draw(1, target, {"finer": finer})
        self._draw(2, self._target, {"levels": self._levels})

    def _draw(
        self, which: int, target: Any, textures: dict[str, Any], changing: Mapping[str, Any] = MappingProxyType({})
    ) -> None:
        program, vertices, values = self._passes[which]
        device = self._stage.device
        target.use()
        device.gl.enable_only(device.gl.NOTHING)
        values.write()
        set_uniforms(program, dict(changing))
        bind(program, textures)
        device.draw(vertices, 3)
