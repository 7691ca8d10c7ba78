"""The lit scene seen from elsewhere than the camera: what cube maps, planar mirrors and probes capture."""

import math
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from .discovery import effect
from .effect import Effect, Knobs
from .gbuffer import GBuffer
from .graph import FACTORS, Plan, Step
from .lighting import Lighting
from .shading import ShadingPass
from .stage import Stage

AMBIENT = "constant_ambient"
"""What stands for the light between surfaces where a view of them is captured."""


class LitViews:
    """Views from one place, side by side in one G-buffer, which is lit at once by the effects of the frame's plan.

    They hold what surfaces scatter, as `ScatteredLight` does: no emission and no environment. Left out are effects that
    read the camera's screen (`environment_visibility` with passes of its own); light between surfaces is constant
    ambient light, whatever the frame has.

    Args:
        stage: the frame's.
        views: how many.
        tile: width and height of each in pixels.
        viewer: (4,) where they are seen from, as `projection.viewer` has it.
        ambient: the share of the lights' flux that arrives by way of other surfaces, as the knob of `constant_ambient`.

    Attributes:
        columns: views beside each other; they go row by row from the bottom left.
        texture: what is scattered to the viewer, RGB.
        position: the points seen, and 1, or 0 where there is none.
    """

    def __init__(
        self, stage: Stage, views: int, tile: tuple[int, int], viewer: np.ndarray, ambient: float = 0.0
    ) -> None:
        device, plan = stage.device, stage.plan
        self.columns = math.ceil(math.sqrt(views))
        size = self.columns * tile[0], math.ceil(views / self.columns) * tile[1]
        effects, steps = _captured(plan, ambient)
        channels = frozenset(channel for declared, _ in effects.values() for channel in declared.channels)
        self._gbuffer = GBuffer(device, stage.geometry, plan.scene, size, channels, None)
        self.texture = device.target(size)
        self.texture.filter = device.gl.LINEAR, device.gl.LINEAR
        self.texture.repeat_x = self.texture.repeat_y = False
        self._framebuffer = device.framebuffer([self.texture])
        here = Stage(
            device, plan.scene, stage.geometry, self._gbuffer, size, stage.baking, plan, elsewhere=np.array(viewer)
        )
        passes = {name: ShadingPass(here, declared, knobs) for name, (declared, knobs) in effects.items()}
        self._stage, self._lighting = here, Lighting(here, steps, self._framebuffer, passes)

    @property
    def position(self):
        """The texture of the points seen."""
        return self._gbuffer.textures["position"]

    @property
    def normal(self):
        """The texture of the normals seen: 0 on backs that have none; None where no light asks for them."""
        return self._gbuffer.textures.get("normal_roughness")

    def move(self, viewer: np.ndarray) -> None:
        """See from another place, with the same programs and textures."""
        assert self._stage.elsewhere is not None
        self._stage.elsewhere[:] = viewer
        for shading in self._lighting.passes.values():
            shading.forget_values()

    def draw(self, matrices: Sequence[np.ndarray], excluded: Collection[int] = ()) -> None:
        """Draw all views.

        Args:
            matrices: world to clip space, (4, 4) each.
            excluded: shapes that are not seen; they still throw shadows.
        """
        self._gbuffer.draw_tiles(matrices, self.columns, excluded)
        self._framebuffer.clear()
        for _, _, draw in self._lighting.actions():
            draw()


def _captured(plan: Plan, ambient: float) -> tuple[Mapping[str, tuple[Effect, Knobs]], tuple[Step, ...]]:
    """The effects and steps that light what is captured."""

    def screen_bound(step: Step) -> bool:
        declared = plan.effects[step.effect][0]
        return "environment_visibility" in step.writes and (declared.folder / "passes.py").is_file()

    lit = [step for step in plan.steps if step.light is not None or _of_environment(step)]
    lit = [step for step in lit if not screen_bound(step)]
    written = {term for step in lit for term in step.writes}
    steps = []
    for step in lit:
        writes = tuple(term for term in step.writes if term != "indirect")
        reads = tuple(term for term in step.reads if term in written or term not in FACTORS.values())
        steps.append(Step(step.effect, writes, reads, step.light))
    effects = {step.effect: plan.effects[step.effect] for step in steps}
    if ambient > 0:
        effects[AMBIENT] = effect(AMBIENT), {"indirect": ambient}
        steps.append(Step(AMBIENT, ("indirect",)))
    return effects, tuple(steps)


def _of_environment(step: Step) -> bool:
    return "environment" in step.writes or "environment_visibility" in step.writes
