"""Passes of maps that are filtered before they are looked up: moments, exponentials."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..effect import Knobs
from ..shaders import source
from ..stage import Stage
from ..uniforms import bind, set_uniforms
from .passes import ShadowMap, ShadowPasses


class FilteredPasses(ShadowPasses):
    """Maps of a function of the depth, averaged over a square.

    The technique's folder holds `kept.glsl` with `vec4 kept(float depth, vec2 slope)`: what is stored of a depth 0…1
    that changes by `slope` from texel to texel. Of depth 1 it must give ones: that is what an empty map shows.

    Args:
        components: how many numbers of `kept` there are.
        constants: what `kept.glsl` and the technique's shader are compiled with.
    """

    def __init__(
        self, stage: Stage, knobs: Knobs, folder: Path, components: int, constants: Mapping[str, float] | None = None
    ) -> None:
        self._components, self._radius, self._constants = components, int(knobs["blur"]), dict(constants or {})
        defines = "".join(f"#define {name} {value!r}\n" for name, value in self._constants.items())
        # The hardware's filter reads one texel more; and a point moved along its normal may lie as far aside.
        reach = self._radius + 1 + math.ceil(float(knobs["normal_offset"]))
        super().__init__(stage, knobs, folder, reach, kept=f'{defines}#include "shadow_keep.glsl"\n')
        self._targets: dict[ShadowMap, tuple[Any, ShadowMap]] = {}
        self._mean: Any = None

    def defines(self, light: int) -> dict[str, object]:
        """What the technique's shader is compiled with."""
        return super().defines(light) | self._constants | {"MEAN_RADIUS": self._radius}

    def uniforms(self, light: int) -> dict[str, Any]:
        """What the casters' and the technique's shader are told."""
        return super().uniforms(light) | {"shadow_range": self.views(light).depths}

    def clear(self, framebuffer: Any) -> None:
        """Let the map show the greatest depth."""
        framebuffer.clear(1.0, 1.0, 1.0, 1.0)

    def make_map(self, size: tuple[int, int]) -> ShadowMap:
        """A map of width and height, filtered by the hardware when it is read."""
        device = self.stage.device
        texture = device.target(size, self._components)
        texture.filter = (device.gl.LINEAR, device.gl.LINEAR)
        return ShadowMap(device.framebuffer([texture], device.depth(size)), texture)

    def draw(self, light: int) -> None:
        """Fill the map that the light's views go to, and average it."""
        super().draw(light)
        if self._radius:
            here = self.map(self.views(light))
            plain, between = self._mean_targets(here)
            self._average(here.texture, between.framebuffer, (1, 0))
            self._average(between.texture, plain, (0, 1))

    def _mean_targets(self, here: ShadowMap) -> tuple[Any, ShadowMap]:
        """The map without its depth buffer, and where it is between rows and columns."""
        if here not in self._targets:
            device = self.stage.device
            texture = device.target(here.texture.size, self._components)
            between = ShadowMap(device.framebuffer([texture]), texture)
            self._targets[here] = device.framebuffer([here.texture]), between
        return self._targets[here]

    def _average(self, image: Any, target: Any, along: tuple[int, int]) -> None:
        device = self.stage.device
        if self._mean is None:
            program = device.program(source("shadow_mean.frag", {"MEAN_RADIUS": self._radius}))
            self._mean = program, device.fullscreen(program)
        program, vertices = self._mean
        width, height = target.size
        edge = self._radius
        target.viewport = (edge, edge, width - 2 * edge, height - 2 * edge)
        target.use()
        device.gl.enable_only(device.gl.NOTHING)
        set_uniforms(program, {"along": along})
        bind(program, {"image": image})
        device.draw(vertices, 3)
