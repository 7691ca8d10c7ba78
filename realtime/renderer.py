"""Executes a plan: the frame as it is shown, its time, and the terms one by one for the measurement."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from lightmeter.scenes.points import SurfacePoints
from lightmeter.scenes.terms import TERMS

from .averager import Averager
from .device import Device
from .display import DISPLAY_TERMS, DisplayPass
from .gbuffer import CHANNELS, GBuffer
from .geometry import Geometry
from .graph import Plan, Step
from .projection import viewer
from .shading import VISIBILITIES, ShadingPass
from .stage import Stage
from .timing import Clock, Recording, Times, summarise

CENTRE = np.zeros((1, 2))


@dataclass(frozen=True, eq=False)
class Frame:
    """What the real-time side made.

    Attributes:
        radiance: (H, W, 3) float32 scene-linear, row 0 at the top.
        display: (H, W, 3) uint8 code values, or None where no effect encodes.
    """

    radiance: np.ndarray
    display: np.ndarray | None


@dataclass(frozen=True, eq=False)
class Capture:
    """The terms at one set of surface points, each (H, W, 3) float32.

    Attributes:
        direct: light to unshadowed radiance, for lights that an effect handles.
        visibility: light to visibility, likewise.
        frame: term to buffer: environment, environment_visibility, indirect.
    """

    points: SurfacePoints
    direct: dict[int, np.ndarray]
    visibility: dict[int, np.ndarray]
    frame: dict[str, np.ndarray]


class Renderer:
    """Renders one plan at one size. Everything is compiled and uploaded once, here."""

    def __init__(self, device: Device, plan: Plan, size: tuple[int, int]) -> None:
        self.device, self.plan, self.size = device, plan, size
        filtering = plan.effect_of("material")
        self._geometry = Geometry(device, plan.scene, plan.effects[filtering][1] if filtering else None)
        self._radiance = device.target(size)
        self._radiance_buffer = device.framebuffer([self._radiance])
        gbuffer = GBuffer(device, self._geometry, plan.scene, size, plan.channels, self._radiance)
        self._stage = Stage(device, plan.scene, self._geometry, gbuffer, size)
        self._passes = self._make_passes(self._stage, separate=False)
        self._visibility = {
            term: device.target(size) for term in VISIBILITIES if any(term in step.writes for step in plan.steps)
        }
        self._buffers = {term: device.framebuffer([texture]) for term, texture in self._visibility.items()}
        self._display = {
            step.writes[0]: (DisplayPass(device, *plan.effects[step.effect], step.writes[0]), step.effect)
            for step in plan.steps
            if step.writes[0] in DISPLAY_TERMS
        }
        self._display_targets: dict[str, Any] = {}
        for term in self._display:
            texture = device.target(size, dtype="f1" if term == "encode" else "f4")
            self._display_targets[term] = device.framebuffer([texture]), texture
        coverage = plan.effect_of("coverage")
        self.offsets = CENTRE
        if coverage is not None:
            effect, knobs = plan.effects[coverage]
            self.offsets = effect.offsets(knobs) if effect.offsets else CENTRE
        self._coverage = coverage or ""
        self._held: dict[str, int] = {}  # effect to the light whose map its pass for captures holds
        self._sum = self._accumulator() if len(self.offsets) > 1 else None

    def _make_passes(self, stage: Stage, separate: bool) -> dict[str, ShadingPass]:
        names = {step.effect for step in self.plan.steps if step.writes[0] not in DISPLAY_TERMS}
        return {name: ShadingPass(stage, *self.plan.effects[name], separate) for name in names}

    def _accumulator(self):
        texture = self.device.target(self.size)
        return self.device.framebuffer([texture]), texture, Averager(self.device)

    def _scene_actions(self, offset: tuple[float, float]) -> list[tuple[str, str, Callable[[], None]]]:
        """(pass, effect, draw) of one sample of the frame, up to its radiance."""

        actions: list[tuple[str, str, Callable[[], None]]] = [
            ("gbuffer", "", lambda: self._stage.gbuffer.draw(offset)),
        ]
        for step in self.plan.steps:
            if step.writes[0] not in DISPLAY_TERMS:
                actions += self._step_actions(step)
        return actions

    def _step_actions(self, step: Step) -> list[tuple[str, str, Callable[[], None]]]:
        shading = self._passes[step.effect]
        name = step.effect
        if step.light is not None:
            name += f" · {self.plan.scene.all_lights[step.light].name}"
        actions = []
        own = shading.own
        light = step.light
        if light is not None and shading.part(step) is None:
            return []
        if shading.has_map and light is not None:
            actions.append((f"{name} · map", step.effect, lambda: own.draw(light)))
        term = step.writes[0]
        target = self._buffers.get(term, self._radiance_buffer)
        actions.append((name, step.effect, lambda: shading.draw(step, target, self._visibility)))
        return actions

    def _display_actions(self) -> list[tuple[str, str, Callable[[], None]]]:
        actions = []
        image = self._sum[1] if self._sum else self._radiance
        scale = 2.0**self.plan.scene.camera.exposure
        for term, (display, effect) in self._display.items():
            framebuffer, texture = self._display_targets[term]
            actions.append(
                (effect, effect, lambda d=display, i=image, f=framebuffer, s=scale: d.draw(i, f, s)),
            )
            image, scale = texture, 1.0
        return actions

    def draw(self) -> None:
        """Draw the frame once."""
        if self._sum:
            self._sum[0].clear()
        for offset in self.offsets:
            for _, _, action in self._scene_actions(tuple(offset)):
                action()
            if self._sum:
                self._accumulate()
        for _, _, action in self._display_actions():
            action()

    def _accumulate(self) -> None:
        assert self._sum
        framebuffer, _, averager = self._sum
        averager.add(self._radiance, framebuffer, 1.0 / len(self.offsets))

    def render(self) -> Frame:
        """The frame as images."""
        self.draw()
        radiance = self.device.read(self._sum[1] if self._sum else self._radiance)[..., :3]
        encoded = self._display_targets.get("encode")
        return Frame(radiance, self.device.read(encoded[1])[..., :3] if encoded else None)

    def measure(self, frames: int = 20, warm_up: int = 3) -> Times:
        """The frame's and every pass's time: the median over `frames` frames after `warm_up`."""
        return summarise([self.record(frames, warm_up)])

    def record(self, frames: int, warm_up: int) -> Recording:
        """Single times of `frames` frames after `warm_up`: in each round the whole frame, then its passes one by one.

        So a round's times were taken under the same conditions, and their ratio is a paired one.
        """
        clock = Clock(self.device)
        for _ in range(warm_up):
            self.draw()
        whole: list[float] = []
        actions = self._scene_actions(tuple(self.offsets[0])) + self._display_actions()
        passes: list[tuple[str, str, list[float]]] = [(name, effect, []) for name, effect, _ in actions]
        for _ in range(frames):
            whole.append(clock.measure(self.draw))
            for (_, _, times), (_, _, action) in zip(passes, actions, strict=True):
                times.append(clock.measure(action))
        return Recording(whole, passes, self._coverage if self._sum else "", clock.method, clock.disagreement)

    def capture(self, offset: tuple[float, float] = (0.0, 0.0), terms: bool = True) -> Capture:
        """The surface points at a sub-pixel offset, and (where `terms`) every effect's buffer at them."""
        gbuffer, _ = self._capture_stage
        gbuffer.draw(offset)
        points = self._points(gbuffer)
        return self._shaded(points) if terms else Capture(points, {}, {}, {})

    def shade(self, points: SurfacePoints) -> Capture:
        """Every effect's buffer at given points, such as a capture's with other parameters."""
        self._capture_stage[0].load(points)
        return self._shaded(points)

    def _shaded(self, points: SurfacePoints) -> Capture:
        """Every effect's buffer at the points that the G-buffer holds."""
        _, passes = self._capture_stage
        direct, visibility, frame = {}, {}, {}
        for step in self.plan.steps:
            if step.writes[0] in DISPLAY_TERMS:
                continue
            values = self._separate(passes[step.effect], step)
            if step.light is None:
                frame |= values
            else:
                (direct if "direct" in step.writes else visibility)[step.light] = values[step.writes[0]]
        return Capture(points, direct, visibility, frame)

    @property
    def _capture_stage(self):
        if not hasattr(self, "_captured"):
            channels = frozenset(CHANNELS)
            radiance = self.device.target(self.size)
            gbuffer = GBuffer(
                self.device, self._geometry, self.plan.scene, self.size, channels, radiance, identity=True
            )
            stage = Stage(self.device, self.plan.scene, self._geometry, gbuffer, self.size)
            self._captured = gbuffer, self._make_passes(stage, separate=True)
        return self._captured

    def _separate(self, shading: ShadingPass, step: Step) -> dict[str, np.ndarray]:
        """What a step writes, each term by itself; a visibility is 1 and a radiance 0 where nothing is drawn."""
        textures = [self.device.target(self.size) for _ in step.writes]
        target = self.device.framebuffer(textures)
        neutral = TERMS[step.writes[0]].neutral  # where a light does not reach, nothing is drawn
        target.clear(neutral, neutral, neutral)
        if shading.has_map and step.light is not None and self._held.get(step.effect) != step.light:
            # A light's map does not depend on where in the pixel the scene is sampled.
            shading.own.draw(step.light)
            self._held[step.effect] = step.light
        shading.draw(step, target, {})
        return {
            term: self.device.read(texture)[..., :3].copy() for term, texture in zip(step.writes, textures, strict=True)
        }

    def _points(self, gbuffer: GBuffer) -> SurfacePoints:
        position = gbuffer.channel("position")
        hit = self.device.read(gbuffer.textures["position"])[..., 3] > 0
        identity = self.device.read(gbuffer.textures["identity"]).astype(np.int32)
        eye = viewer(self.plan.scene.camera)
        view = (eye[:3] - eye[3] * position.astype(np.float64)).astype(np.float64)
        view /= np.maximum(np.linalg.norm(view, axis=-1, keepdims=True), 1e-300)
        return SurfacePoints(
            **{name: gbuffer.channel(name) for name in gbuffer.channels},
            view=np.broadcast_to(view, position.shape).astype(np.float32),
            emission=self.device.read(gbuffer.radiance)[..., :3].copy(),
            shape=np.where(hit, identity[..., 0], -1).astype(np.int32),
            triangle=np.where(hit, identity[..., 1] + 4096 * identity[..., 2], -1).astype(np.int32),
        )
