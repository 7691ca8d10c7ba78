"""The display chain on the device, from the scene-linear image to code values and filters of these."""

from collections.abc import Callable
from importlib import import_module

import numpy as np

from .device import Device
from .effect import Effect, Knobs
from .fullscreen import FullscreenPass
from .graph import Plan, Step
from .lighting import Action
from .shaders import Source, source
from .stage import Stage

POINTWISE = ("tone", "encode")
"""The terms that need nothing of an image but the pixel itself. The others have passes of their own."""


class DisplayChain:
    """The passes of a plan's display steps, in order."""

    def __init__(self, stage: Stage, plan: Plan) -> None:
        self._stage, self._plan = stage, plan
        self._steps = [step for step in plan.steps if step.of_display]
        self._own = {step: self._made(step) for step in self._steps if step.writes[0] not in POINTWISE}
        pointwise = [step for step in self._steps if step.writes[0] in POINTWISE]
        is_metered = any(step.writes == ("exposure",) for step in self._steps)
        self._pointwise = {
            step: PointwisePass(stage.device, *plan.effects[step.effect], step.writes[0], is_metered and place == 0)
            for place, step in enumerate(pointwise)
        }
        self._targets = {}
        for step in pointwise:
            texture = stage.device.target(stage.size, dtype="f1" if step.writes[0] == "encode" else "f4")
            self._targets[step] = stage.device.framebuffer([texture]), texture

    def _made(self, step: Step):
        effect, knobs = self._plan.effects[step.effect]
        module = import_module(f"{__package__}.effects.{effect.name}.passes")
        return module.Passes(self._stage, knobs, effect.folder)

    @property
    def encoded(self):
        """The texture of code values, filtered where an effect filters them; None where no effect encodes."""
        filtered = [own.image for step, own in self._own.items() if step.writes == ("coverage",)]
        if filtered:
            return filtered[-1]
        return next((self._targets[step][1] for step in self._targets if step.writes == ("encode",)), None)

    def actions(self, image) -> list[Action]:
        """What is drawn, one after another, of `image`, a texture of scene-linear radiance."""
        actions: list[Action] = []
        camera = self._plan.scene.camera
        scale, metered = camera.exposure_scale(), None
        for step in self._steps:
            if step in self._own:
                own = self._own[step]
                actions.append((step.effect, step.effect, lambda own=own, image=image: own.draw(image)))
                if step.writes == ("exposure",):
                    assert camera.metering is not None
                    scale, metered = camera.exposure_scale() * camera.metering.grey, own.average
                else:
                    image = own.image
                continue
            made, (framebuffer, texture) = self._pointwise[step], self._targets[step]
            draw = lambda p=made, i=image, f=framebuffer, s=scale, m=metered: p.draw(i, f, s, m)  # noqa: E731
            actions.append((step.effect, step.effect, draw))
            image, scale, metered = texture, 1.0, None
        return actions


class PointwisePass:
    """Applies one effect for tone or encode to a whole image.

    Args:
        is_metered: the exposure is what a texture says.
    """

    def __init__(self, device: Device, effect: Effect, knobs: Knobs, term: str, is_metered: bool) -> None:
        defines = {"FUNCTION": term, "METERED": is_metered, **effect.defines(knobs)}
        fragment = source("display.frag", defines).text
        body = source(f"{effect.name}.glsl", folder=effect.folder).text.removeprefix("#version 410\n")
        self._pass = FullscreenPass(device, Source(fragment.replace("EFFECT", body)), dict(knobs))

    def draw(self, image, target, scale: float, average=None) -> None:
        """Draw `image`, a texture, times `scale` and over the average that was metered, into a framebuffer."""
        textures = {"image": image} if average is None else {"image": image, "metered": average}
        self._pass.draw(target, textures, values={"exposure_scale": scale})


def display_transform(plan: Plan, frame: np.ndarray | None = None) -> Callable[[np.ndarray], np.ndarray]:
    """The frame's display transform as a function: (…, 3) scene-linear to code values 0…1, not yet quantised.

    Glare and filters of code values are no part of it: what they do to a pixel depends on others.

    Args:
        frame: (H, W, 3) the frame's radiance. A camera that meters meters this, by its exact rule, for whatever is
            shown: so both sides of a comparison are shown alike.
    """
    camera = plan.scene.camera
    metered = camera.metering is not None and frame is not None and plan.effect_of("exposure")
    scale = camera.exposure_scale(camera.metering.average(frame) if metered else None)
    stages = [(twin(plan, term), plan.effects[name][1]) for term in POINTWISE if (name := plan.effect_of(term))]

    def transform(image: np.ndarray) -> np.ndarray:
        out = np.asarray(image) * np.asarray(scale, dtype=image.dtype)
        for function, knobs in stages:
            out = function(out, knobs)
        return np.clip(out, 0.0, 1.0)

    return transform


def twin(plan: Plan, term: str) -> Callable[..., np.ndarray]:
    """The NumPy twin of the plan's (first) effect for a display term."""
    name = plan.effect_of(term)
    assert name is not None
    return twin_of(name, term)


def twin_of(effect: str, term: str) -> Callable[..., np.ndarray]:
    """An effect's NumPy twin: tone, encode, glare and coverage (of code values) of (image, knobs), exposure of (image,
    knobs, metering).
    """
    return getattr(import_module(f"{__package__}.effects.{effect}.twin"), term)
