"""The passes of virtual lights: reflective shadow maps, where their rays end, a second bounce, and who sees whom."""

import math
from pathlib import Path
from typing import Any

import numpy as np

from ...effect import EffectError, Knobs
from ...fullscreen import FullscreenPass
from ...gbuffer import GBuffer
from ...shaders import source
from ...stage import Stage
from . import defines, uniforms
from .depths import VirtualDepths
from .rays import light_rays
from .surface_points import surface_points

COLUMNS = ("virtual_position", "virtual_normal", "virtual_power")
CHANNELS = frozenset({"position", "normal", "base_color", "metallic"})
"""Of a reflective shadow map."""


class Table:
    """Virtual lights as textures, a column each, and the framebuffer that fills them."""

    def __init__(self, stage: Stage, count: int) -> None:
        self.textures = {name: stage.device.target((count, 1)) for name in COLUMNS}
        self.framebuffer = stage.device.framebuffer(self.textures.values())


class Passes:
    """Everything is drawn anew for each frame, as lights and surfaces may have moved."""

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        self._stage, self._folder = stage, folder
        self._values = dict(knobs) | uniforms(stage.scene, knobs, None)
        self._resolution = int(knobs["resolution"])
        self._rays = light_rays(stage.scene, int(knobs["lights"]), self._resolution, int(knobs["emitter_points"]))
        self._first = sum(len(rays.texels) for rays in self._rays)
        points = surface_points(stage.scene, self._first) if knobs["bounces"] == 2 else np.zeros((3, 0, 3))
        self._count = self._first + points.shape[1]
        sizes = {"LIGHTS": self._count, "FIRST": self._first, "MAP_COLUMNS": math.ceil(math.sqrt(self._count))}
        self._defines = defines(knobs) | sizes
        self._check_sizes(int(knobs["map_size"]) if knobs["visibility"] == "maps" else 0)
        self._lights = self._placed = Table(stage, self._first)
        self._place = self._make_place()
        self._scatter = None
        if points.shape[1]:
            self._lights = Table(stage, self._count)
            self._scatter = self._pass("scatter.frag")
            self._points = stage.device.table(np.pad(points, ((0, 0), (0, 0), (0, 1))))
        self._depths = None
        if knobs["visibility"] == "maps":
            self._depths = VirtualDepths(stage, folder, self._count, int(knobs["map_size"]), self._values["planes"])
        self._gather = None
        if int(knobs["tile"]) > 1:
            self._interleaved = stage.device.target(stage.size)
            self._interleaved_buffer = stage.device.framebuffer([self._interleaved])
            self._gather = self._pass("gather.frag", stage.gbuffer.defines())

    def draw(self, _light: None) -> None:
        """Place the virtual lights, let them see the scene, and share them out among pixels, as far as asked for."""
        self._draw_places()
        if self._depths is not None:
            self._depths.draw(self._placed.textures, range(self._first))
        if self._scatter is not None:
            textures = self._placed.textures | self._seen() | {"surface_points": self._points}
            self._scatter.draw(self._lights.framebuffer, textures)
            if self._depths is not None:
                self._depths.draw(self._lights.textures, range(self._first, self._count))
        if self._gather is not None:
            gbuffer = self._stage.gbuffer
            textures = self._lights.textures | self._seen() | gbuffer.samplers
            self._gather.draw(self._interleaved_buffer, textures, values=gbuffer.place)

    def defines(self, _light: None) -> dict[str, object]:
        """How many there are."""
        return self._defines

    def uniforms(self, _light: None) -> dict[str, Any]:
        """Nothing beyond the effect's own."""
        return {}

    def textures(self, _light: None) -> dict[str, Any]:
        """The virtual lights, and what is looked up beside them."""
        if self._gather is not None:
            return {"interleaved": self._interleaved}
        return self._lights.textures | self._seen()

    def _seen(self) -> dict[str, Any]:
        return {} if self._depths is None else {"virtual_depths": self._depths.texture}

    def _pass(self, name: str, surface: dict[str, object] | None = None) -> FullscreenPass:
        fragment = source(name, self._defines | (surface or {}), self._folder)
        return FullscreenPass(self._stage.device, fragment, self._values | {"viewer": self._stage.viewer})

    def _make_place(self) -> FullscreenPass:
        """The pass that places virtual lights, the maps that it reads, and the rays it reads them at."""
        stage = self._stage
        self._maps = {}  # as many tiles as a light has views
        for columns, rows in {rays.views.tiles for rays in self._rays}:
            size = columns * self._resolution, rows * self._resolution
            self._maps[columns, rows] = GBuffer(stage.device, stage.geometry, stage.scene, size, CHANNELS, None)
        table = np.zeros((2, self._first, 4))
        table[0, :, :2] = np.concatenate([rays.texels for rays in self._rays])
        table[1, :, :3] = np.concatenate([rays.powers for rays in self._rays])
        self._ray_table = stage.device.table(table)
        return self._pass("place.frag", next(iter(self._maps.values())).defines())

    def _draw_places(self) -> None:
        start = 0
        for rays in self._rays:
            views, seen = rays.views, self._maps[rays.views.tiles]
            seen.draw_tiles(views.matrices, views.tiles[0], () if views.excluded is None else (views.excluded,))
            textures = seen.samplers | {"rays": self._ray_table}
            values = {"viewer": views.position, "inverse_range_square": rays.inverse_range_square}
            self._place.draw(self._placed.framebuffer, textures, (start, 0, len(rays.texels), 1), values)
            start += len(rays.texels)

    def _check_sizes(self, map_size: int) -> None:
        most = self._stage.device.gl.info["GL_MAX_TEXTURE_SIZE"]
        wanted = {
            "resolution": 3 * self._resolution,
            "map_size": map_size * int(self._defines["MAP_COLUMNS"]),
            "lights": self._count,
        }
        for knob, size in wanted.items():
            if size > most:
                raise EffectError(
                    f"virtual_lights.{knob}: a texture of {size} texels exceeds the {most} of this device's largest; "
                    "take fewer"
                )
