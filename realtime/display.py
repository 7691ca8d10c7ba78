"""The display chain: tone and encode, on the device for the frame, and as NumPy twins for any image."""

from collections.abc import Callable
from importlib import import_module

import numpy as np

from .device import Device
from .effect import Effect, Knobs
from .graph import Plan
from .shaders import Source, source
from .uniforms import bind, set_uniforms

DISPLAY_TERMS = ("tone", "encode")


class DisplayPass:
    """Applies one display effect to a whole image."""

    def __init__(self, device: Device, effect: Effect, knobs: Knobs, term: str) -> None:
        self._device, self._knobs = device, knobs
        fragment = source("display.frag", {"FUNCTION": term}).text
        body = source(f"{effect.name}.glsl", folder=effect.folder).text.removeprefix("#version 410\n")
        self._program = device.program(Source(fragment.replace("EFFECT", body)))
        self._vertices = device.fullscreen(self._program)

    def draw(self, image, target, scale: float) -> None:
        """Draw `image`, a texture, times `scale` into the framebuffer `target`."""
        target.use()
        self._device.gl.enable_only(self._device.gl.NOTHING)
        set_uniforms(self._program, {**self._knobs, "exposure_scale": scale})
        bind(self._program, {"image": image})
        self._device.draw(self._vertices, 3)


def display_transform(plan: Plan) -> Callable[[np.ndarray], np.ndarray]:
    """The frame's display transform as a function: (…, 3) scene-linear to code values 0…1, not yet quantised."""
    exposure = 2.0**plan.scene.camera.exposure
    stages = [(twin(plan, term), plan.effects[name][1]) for term in DISPLAY_TERMS if (name := plan.effect_of(term))]

    def transform(image: np.ndarray) -> np.ndarray:
        out = np.asarray(image) * np.asarray(exposure, dtype=image.dtype)
        for function, knobs in stages:
            out = function(out, knobs)
        return np.clip(out, 0.0, 1.0)

    return transform


def twin(plan: Plan, term: str) -> Callable[[np.ndarray, Knobs], np.ndarray]:
    """The NumPy twin of the plan's effect for `term`, tone or encode."""
    name = plan.effect_of(term)
    module = import_module(f"{__package__}.effects.{name}.twin")
    return getattr(module, term)
