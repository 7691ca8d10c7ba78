"""The passes that shadow techniques share: a light's views are drawn into the tiles of one depth map."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..effect import EffectError, Knobs
from ..light_bounds import Rectangle
from ..stage import Stage
from .casters import DEPTH_ONLY, Casters
from .seen import SeenSolid, looked_up, seen_solid
from .views import ShadowViews, shadow_views


@dataclass(frozen=True, eq=False)
class ShadowMap:
    """A map and what it is drawn with.

    Attributes:
        framebuffer: it is drawn into this one.
        texture: what the technique's shader reads.
    """

    framebuffer: Any
    texture: Any


class ShadowPasses:
    """The shadow maps of one frame: lights with as many views share one map, since they are drawn one after the other.

    Of a map just that is drawn which the frame's points look up; the rest is whatever it was.

    Attributes:
        near_by: whether a point looks up what lies within the reach of where it is on the map, and nothing else.

    Args:
        knobs: the technique's; `resolution` and `faces` are read here.
        folder: the technique's own.
        reach: texels around a point that its filter reads, moves of the point along its normal included.
        kept: see `Casters`.
    """

    near_by = True

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path, reach: int, kept: str = DEPTH_ONLY) -> None:
        self.stage, self.knobs, self.name = stage, knobs, folder.name
        self.resolution = int(knobs["resolution"])
        # One texel more than the filter reaches, for rounding at the edge.
        self.border = reach + 1
        if 4 * self.border > self.resolution:
            raise EffectError(
                f"{self.name}: a filter that reaches {reach} texels leaves too little of a map of {self.resolution}; "
                f"take a resolution of {4 * self.border} or more"
            )
        self._casters = Casters(stage, str(knobs["faces"]), kept, folder)
        self._maps: dict[tuple[int, int], ShadowMap] = {}
        self._views: dict[int, ShadowViews] = {}
        self._parts: dict[int, list[Rectangle | None]] = {}
        self._solid: SeenSolid | None = None

    def views(self, light: int) -> ShadowViews:
        """The light's views."""
        if light not in self._views:
            self._views[light] = self.look(light)
        return self._views[light]

    def look(self, light: int) -> ShadowViews:
        """Where the light's maps look from."""
        scene = self.stage.scene
        return shadow_views(scene, scene.all_lights[light], self.resolution, self.border)

    def parts(self, light: int) -> list[Rectangle | None]:
        """The part of each of the light's views that is looked up, in its own texels; None where nothing is.

        Points that are stored in few bits may lie elsewhere than the camera sees, and others are seen from elsewhere:
        then all is.
        """
        if light not in self._parts:
            views = self.views(light)
            if self.near_by and self.stage.elsewhere is None and not self.stage.plan.stored():
                self._solid = self._solid or seen_solid(self.stage.scene, self.stage.size)
                self._parts[light] = looked_up(self._solid, views, self.resolution, self.border)
            else:
                self._parts[light] = [(0, 0, self.resolution, self.resolution)] * len(views.matrices)
        return self._parts[light]

    def defines(self, light: int) -> dict[str, object]:
        """What the technique's shader is compiled with."""
        views = self.views(light)
        columns, _ = views.tiles
        return {"VIEWS": len(views.matrices), "COLUMNS": columns, "RESOLUTION": self.resolution}

    def draw(self, light: int) -> None:
        """Fill the map that the light's views go to."""
        views = self.views(light)
        columns, _ = views.tiles
        framebuffer, side = self.map(views).framebuffer, self.resolution
        framebuffer.use()
        gl = self.stage.device.gl
        gl.enable_only(gl.DEPTH_TEST)
        values = self.uniforms(light)
        for view, (matrix, part) in enumerate(zip(views.matrices, self.parts(light), strict=True)):
            if part is None:
                continue
            across, up = view % columns * side, view // columns * side
            framebuffer.viewport = (across, up, side, side)
            framebuffer.scissor = (across + part[0], up + part[1], *part[2:])
            self.clear(framebuffer)
            self._casters.draw(values | {"view_projection": matrix}, views.excluded)
        framebuffer.scissor = None

    def clear(self, framebuffer: Any) -> None:
        """Let the map show nothing."""
        framebuffer.clear()

    def uniforms(self, light: int) -> dict[str, Any]:
        """What shaders are told of the light's views."""
        views = self.views(light)
        return {"shadow_matrices": views.matrices, "shadow_light": views.position, "shadow_texels": views.texels}

    def textures(self, light: int) -> dict[str, Any]:
        """What the technique's shader reads."""
        return {"shadow_map": self.map(self.views(light)).texture}

    def map(self, views: ShadowViews) -> ShadowMap:
        """The map for so many views."""
        if views.tiles not in self._maps:
            columns, rows = views.tiles
            size = columns * self.resolution, rows * self.resolution
            most = self.stage.device.gl.info["GL_MAX_TEXTURE_SIZE"]
            if max(size) > most:
                raise EffectError(
                    f"{self.name}: {columns} × {rows} views of {self.resolution} texels exceed the {most} of this "
                    f"device's largest texture; take a resolution of {most // columns} or less"
                )
            self._maps[views.tiles] = self.make_map(size)
        return self._maps[views.tiles]

    def make_map(self, size: tuple[int, int]) -> ShadowMap:
        """A map of width and height."""
        texture = self.stage.device.depth(size)
        return ShadowMap(self.stage.device.framebuffer([], texture), texture)
