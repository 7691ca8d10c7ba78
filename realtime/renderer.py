"""Executes a plan: the frame as it is shown, its time, and the terms one by one for the measurement."""

from collections.abc import Collection
from dataclasses import dataclass, field, replace

import numpy as np

from lightmeter.scenes.points import SurfacePoints
from lightmeter.scenes.terms import TERMS

from .baking import Baking
from .device import Device
from .display import DisplayChain
from .gathering import gatherer
from .gbuffer import CHANNELS, GBuffer
from .geometry import Geometry
from .graph import Plan, Step
from .lighting import Action, Lighting
from .projection import viewer
from .scattered_light import FrameScatteredLight, ScatteredLight
from .shading import ShadingPass
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
        verdicts: effect to the number of what became of each pixel (H, W), for effects that declare some.
    """

    points: SurfacePoints
    direct: dict[int, np.ndarray]
    visibility: dict[int, np.ndarray]
    frame: dict[str, np.ndarray]
    verdicts: dict[str, np.ndarray] = field(default_factory=dict)


class Renderer:
    """Renders one plan at one size. Everything is compiled, uploaded and baked once, here.

    Attributes:
        baking: what the plan's effects baked, and in what time; given, what another renderer of the plan baked.
    """

    def __init__(self, device: Device, plan: Plan, size: tuple[int, int], baking: Baking | None = None) -> None:
        self.device, self.plan, self.size = device, plan, size
        filtering = plan.effect_of("material")
        self._geometry = Geometry(device, plan.scene, plan.effects[filtering][1] if filtering else None)
        self._radiance = device.target(size)
        masks = plan.sampler is not None and plan.effects[plan.sampler][0].masks
        # What reads the lit frame reads it in other pixels too, and none may be left out.
        mask = device.gl.depth_renderbuffer(size) if masks and not plan.reads_scattered else None
        self._radiance_buffer = device.framebuffer([self._radiance], mask)
        self._unmasked = None if mask is None else device.framebuffer([], mask)
        gbuffer = GBuffer(device, self._geometry, plan.scene, size, plan.channels, self._radiance, stored=plan.stored())
        self.baking = baking or Baking(device)
        self._scattered = (
            FrameScatteredLight(device, size, self._radiance_buffer, gbuffer.shines) if plan.reads_scattered else None
        )
        given = device, plan.scene, self._geometry, gbuffer, size, self.baking, plan, self._scattered
        self._stage = Stage(*given, mask=mask)
        self._passes = self._make_passes(self._stage, separate=False)
        scene_steps = [step for step in plan.steps if not step.of_display]
        self._lighting = Lighting(self._stage, scene_steps, self._radiance_buffer, self._passes)
        self._display = DisplayChain(self._stage, plan)
        coverage = plan.sampler
        self.offsets = CENTRE
        if coverage is not None:
            effect, knobs = plan.effects[coverage]
            self.offsets = effect.offsets(knobs) if effect.offsets else CENTRE
        self._coverage = coverage or ""
        self._is_temporal = coverage is not None and plan.effects[coverage][0].stage == "radiance"
        self._formats: dict[tuple, GBuffer] = {}
        self._held: dict[str, int | None] = {}  # effect to the light whose map its pass for captures holds
        self._gatherer = gatherer(self._stage, plan, len(self.offsets))

    def _make_passes(self, stage: Stage, separate: bool) -> dict[str, ShadingPass]:
        names = {step.effect for step in self.plan.steps if not step.of_display}
        return {name: ShadingPass(stage, *self.plan.effects[name], separate) for name in names}

    def _scene_actions(self, offset: tuple[float, float]) -> list[Action]:
        """(pass, effect, draw) of one sample of the frame, up to its radiance."""
        return [("gbuffer", "", lambda: self._draw_gbuffer(offset)), *self._lighting.actions()]

    def _draw_gbuffer(self, offset: tuple[float, float]) -> None:
        self._stage.gbuffer.draw(offset)
        if self._scattered is not None:
            self._scattered.remember_emission()

    @property
    def _finished(self):
        """The texture of the finished scene-linear image."""
        return self._gatherer.texture if self._gatherer else self._radiance

    def draw(self) -> None:
        """Draw the frame once; where it has a history, that too."""
        self._unmask()
        if self._gatherer:
            self._gatherer.clear()
        self._draw_samples(self.offsets)

    def _unmask(self) -> None:
        """Light every pixel again."""
        if self._unmasked:
            self._unmasked.clear(depth=1.0)

    def _draw_samples(self, offsets: np.ndarray) -> None:
        """Draw samples of the scene, gather them, and show what they come to."""
        for offset in offsets:
            for _, _, action in self._scene_actions(tuple(offset)):
                action()
            if self._gatherer:
                self._gatherer.add(self._radiance)
        for _, _, action in self._display.actions(self._finished):
            action()

    def render(self) -> Frame:
        """The frame as images."""
        self.draw()
        radiance = self.device.read(self._finished)[..., :3]
        encoded = self._display.encoded
        return Frame(radiance, None if encoded is None else self.device.read(encoded)[..., :3])

    def _draw_next(self, offsets: np.ndarray) -> None:
        """The next frame: one more sample where there is a history, else all of them anew."""
        if self._is_temporal:
            self._draw_samples(offsets)
        else:
            self.draw()

    def measure(self, frames: int = 20, warm_up: int = 3) -> Times:
        """The frame's and every pass's time: the median over `frames` frames after `warm_up`."""
        return summarise([self.record(frames, warm_up)])

    def record(self, frames: int, warm_up: int, only: str | None = None) -> Recording:
        """Single times of `frames` frames after `warm_up`: in each round the whole frame, then its passes one by one.

        So a round's times were taken under the same conditions, and their ratio is a paired one. Of a frame with a
        history it is what the next frame takes.

        Args:
            only: the effect whose passes are wanted beside the whole; None: everyone's, and what sampling costs.
        """
        clock = Clock(self.device)
        offsets = self.offsets[:1] if self._is_temporal else self.offsets
        for _ in range(warm_up):
            self.draw()
        whole: list[float] = []
        actions = self._scene_actions(tuple(offsets[0]))
        if self._is_temporal:
            actions.append((self._coverage, self._coverage, lambda: self._gatherer.add(self._radiance)))
        actions += self._display.actions(self._finished)
        actions = [action for action in actions if only in (None, action[1])]
        passes: list[tuple[str, str, list[float]]] = [(name, effect, []) for name, effect, _ in actions]
        for _ in range(frames):
            whole.append(clock.measure(lambda: self._draw_next(offsets)))
            self._unmask()
            for (_, _, times), (_, _, action) in zip(passes, actions, strict=True):
                times.append(clock.measure(action))
        # What further samples cost is what the passes leave of the whole: with some of them only, nobody knows.
        sampling = self._coverage if len(offsets) > 1 and only is None else ""
        return Recording(whole, passes, sampling, clock.method, clock.disagreement)

    def capture(
        self, offset: tuple[float, float] = (0.0, 0.0), terms: bool = True, exact: Collection[str] = ()
    ) -> Capture:
        """The surface points at a sub-pixel offset, and (where `terms`) every effect's buffer at them.

        Args:
            exact: effects whose formats are not used: what they store is kept in floats.
        """
        gbuffer = self._capture_stage[0].gbuffer
        gbuffer.draw(offset)
        points = self._stored(self._points(gbuffer), exact)
        return self._shaded(points) if terms else Capture(points, {}, {}, {})

    def stored(self, points: SurfacePoints, offset: tuple[float, float], exact: Collection[str] = ()) -> SurfacePoints:
        """Given points as the frame's G-buffer would give them back, had it been sampled at that offset."""
        if not self.plan.stored(exact):
            return points
        self._capture_stage[0].gbuffer.load(points, offset)
        return self._stored(points, exact)

    def _stored(self, points: SurfacePoints, exact: Collection[str]) -> SurfacePoints:
        """The points that the G-buffer for captures holds, once they were stored in the frame's formats."""
        stored = self.plan.stored(exact)
        if not stored:
            return points
        floats, key = self._capture_stage[0].gbuffer, tuple(stored.items())
        if key not in self._formats:
            arguments = self.device, self._geometry, self.plan.scene, self.size, frozenset(CHANNELS), floats.radiance
            self._formats[key] = GBuffer(*arguments, stored=stored)
        self._formats[key].store(floats)
        floats.store(self._formats[key])
        return replace(points, **self._channels(floats))

    def shade(self, points: SurfacePoints, offset: tuple[float, float] | None = None) -> Capture:
        """Every effect's buffer at given points, such as a capture's at that offset with other parameters."""
        self._capture_stage[0].gbuffer.load(points, offset)
        return self._shaded(points)

    def _shaded(self, points: SurfacePoints) -> Capture:
        """Every effect's buffer at the points that the G-buffer holds."""
        stage, passes = self._capture_stage
        direct, visibility, frame, verdicts = {}, {}, {}, {}
        for step in self.plan.steps:
            if step.of_display:
                continue
            if "scattered" in step.reads:
                assert stage.scattered is not None
                stage.scattered.hold(_scattered(direct, visibility, frame, points))
            values, verdict = self._separate(passes[step.effect], step)
            if self.plan.effects[step.effect][0].verdicts:
                verdicts[step.effect] = verdict
            if step.light is None:
                frame |= values
            else:
                (direct if "direct" in step.writes else visibility)[step.light] = values[step.writes[0]]
        return Capture(points, direct, visibility, frame, verdicts)

    @property
    def _capture_stage(self):
        if not hasattr(self, "_captured"):
            channels = frozenset(CHANNELS)
            radiance = self.device.target(self.size)
            gbuffer = GBuffer(
                self.device, self._geometry, self.plan.scene, self.size, channels, radiance, identity=True
            )
            scattered = ScatteredLight(self.device, self.size) if self.plan.reads_scattered else None
            stage = Stage(
                self.device, self.plan.scene, self._geometry, gbuffer, self.size, self.baking, self.plan, scattered
            )
            self._captured = stage, self._make_passes(stage, separate=True)
        return self._captured

    def _separate(self, shading: ShadingPass, step: Step) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """What a step writes, each term by itself, and its verdicts; where nothing is drawn a term is neutral."""
        textures = [self.device.target(self.size) for _ in step.writes]
        target = self.device.framebuffer(textures)
        neutral = TERMS[step.writes[0]].neutral  # where a light does not reach, nothing is drawn
        target.clear(neutral, neutral, neutral)
        stale = step.light is None or shading.is_per_sample or self._held.get(step.effect) != step.light
        if shading.has_map and stale:
            # A light's map does not depend on where in the pixel the scene is sampled; what the frame has may.
            shading.own.draw(step.light)
            if step.light is not None:
                self._held[step.effect] = step.light
        shading.draw(step, target, {})
        images = {term: self.device.read(texture) for term, texture in zip(step.writes, textures, strict=True)}
        verdict = images[step.writes[0]][..., 3].astype(np.int32)
        return {term: image[..., :3].copy() for term, image in images.items()}, verdict

    def _channels(self, gbuffer: GBuffer) -> dict[str, np.ndarray]:
        """The channels, and the direction to the viewer from where the points lie."""
        channels = {name: gbuffer.channel(name) for name in gbuffer.channels}
        position = channels["position"]
        eye = viewer(self.plan.scene.camera)
        view = (eye[:3] - eye[3] * position.astype(np.float64)).astype(np.float64)
        view /= np.maximum(np.linalg.norm(view, axis=-1, keepdims=True), 1e-300)
        return channels | {"view": np.broadcast_to(view, position.shape).astype(np.float32)}

    def _points(self, gbuffer: GBuffer) -> SurfacePoints:
        hit = self.device.read(gbuffer.textures["position"])[..., 3] > 0
        identity = self.device.read(gbuffer.textures["identity"]).astype(np.int32)
        return SurfacePoints(
            **self._channels(gbuffer),
            emission=self.device.read(gbuffer.radiance)[..., :3].copy(),
            shape=np.where(hit, identity[..., 0], -1).astype(np.int32),
            triangle=np.where(hit, identity[..., 1] + 4096 * identity[..., 2], -1).astype(np.int32),
        )


def _scattered(direct, visibility, frame, points: SurfacePoints) -> np.ndarray:
    """(H, W, 3): the lit frame so far, as the effects themselves have it: direct light and the environment's."""
    total = np.zeros(points.position.shape, np.float32)
    for light, radiance in direct.items():
        total += radiance * visibility.get(light, 1.0)
    return total + frame.get("environment", 0.0) * frame.get("environment_visibility", 1.0)
