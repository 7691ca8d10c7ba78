"""Lights what a G-buffer holds: each step's own passes, then its part of the composition, added to a radiance."""

from collections.abc import Callable, Sequence
from typing import Any

from .graph import Step
from .scattered_light import FrameScatteredLight
from .shading import VISIBILITIES, ShadingPass
from .stage import Stage

Action = tuple[str, str, Callable[[], None]]
"""(pass, effect, draw)."""


class Lighting:
    """The passes of some steps of a plan, in order.

    Args:
        radiance: the framebuffer that radiances are added to.
        passes: effect to its pass on the stage.
    """

    def __init__(self, stage: Stage, steps: Sequence[Step], radiance: Any, passes: dict[str, ShadingPass]) -> None:
        self._stage, self._steps, self._radiance, self.passes = stage, steps, radiance, passes
        drawn = [term for term in VISIBILITIES if any(term in step.writes for step in steps)]
        self._visibility = {term: stage.device.target(stage.size) for term in drawn}
        self._buffers = {
            term: stage.device.framebuffer([texture], stage.mask) for term, texture in self._visibility.items()
        }

    def actions(self) -> list[Action]:
        """What is drawn, one after another."""
        return [action for step in self._steps for action in self._step_actions(step)]

    def _step_actions(self, step: Step) -> list[Action]:
        shading, light = self.passes[step.effect], step.light
        name = step.effect
        if light is not None:
            name += f" · {self._stage.scene.all_lights[light].name}"
            if shading.part(step) is None:
                return []
        actions: list[Action] = []
        if "scattered" in step.reads:
            scattered = self._stage.scattered
            assert isinstance(scattered, FrameScatteredLight), "a frame that is being drawn"
            actions.append((f"{name} · lit frame", step.effect, scattered.take))
        if shading.has_map:
            actions.append((f"{name} · map", step.effect, lambda: shading.own.draw(light)))
        target = self._buffers.get(step.writes[0], self._radiance)
        actions.append((name, step.effect, lambda: shading.draw(step, target, self._visibility)))
        return actions
