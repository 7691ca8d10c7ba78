"""The display chain as arithmetic on an image: every effect of it by its twin, or exactly by its oracle."""

from collections.abc import Collection

import numpy as np

from lightmeter.realtime.display import POINTWISE, twin_of
from lightmeter.realtime.graph import Plan, Step
from lightmeter.realtime.pictures.codes import written
from lightmeter.scenes.model import Camera


def display_steps(plan: Plan) -> list[Step]:
    """The steps that follow the scene-linear image, in order."""
    return [step for step in plan.steps if step.of_display]


class Chained:
    """An image on its way through a plan's display chain. What was made of it is kept: many ways share their beginning.

    Args:
        image: (H, W, 3) scene-linear.
    """

    def __init__(self, plan: Plan, image: np.ndarray) -> None:
        self._plan, self._image = plan, np.asarray(image)
        self._steps = display_steps(plan)
        self._metered = any(step.writes == ("exposure",) for step in self._steps)
        self._first_pointwise = next((step for step in self._steps if step.writes[0] in POINTWISE), None)
        self._kept: dict[tuple[int, frozenset[str]], np.ndarray] = {}

    def before(self, step: Step, exact: Collection[str]) -> np.ndarray:
        """What the step is given, with these effects exact."""
        return self._after(self._steps.index(step) - 1, frozenset(exact))

    def after(self, step: Step, exact: Collection[str]) -> np.ndarray:
        """What the step makes of it."""
        return self._after(self._steps.index(step), frozenset(exact))

    def whole(self, exact: Collection[str]) -> np.ndarray:
        """(H, W, 3) float32 code values at the end, clipped to 0…1."""
        return np.clip(self._after(len(self._steps) - 1, frozenset(exact)), 0.0, 1.0).astype(np.float32)

    def _after(self, place: int, exact: frozenset[str]) -> np.ndarray:
        if place < 0:
            return self._image
        exact &= {step.effect for step in self._steps[: place + 1]}
        if (place, exact) not in self._kept:
            step = self._steps[place]
            image = self._after(place - 1, exact)
            if not self._metered and step == self._first_pointwise:
                image = image * self._plan.scene.camera.exposure_scale()
            self._kept[place, exact] = self._step(step, image, step.effect in exact)
        return self._kept[place, exact]

    def _step(self, step: Step, image: np.ndarray, exact: bool) -> np.ndarray:
        (term,) = step.writes
        camera, (effect, knobs) = self._plan.scene.camera, self._plan.effects[step.effect]
        if not exact and term == "exposure":
            assert camera.metering is not None
            return image * camera.exposure_scale(twin_of(effect.name, term)(image, knobs, camera.metering))
        if not exact and term == "encode":
            return written(twin_of(effect.name, term)(image, knobs), knobs)
        if not exact and term == "coverage":
            return written(twin_of(effect.name, term)(image, knobs), {"dither": "none"})
        if not exact:
            return twin_of(effect.name, term)(image, knobs)
        return _exactly(term, image, camera, effect.part)


def _exactly(term: str, image: np.ndarray, camera: Camera, part: str) -> np.ndarray:
    """A display term by its oracle, and no other is imported.

    A part of glare has no truth: diffraction has no reflections in a lens. An image without aliasing needs no filter.
    """
    if term == "coverage" or part:
        return image
    if term == "glare":
        from lightmeter.groundtruth.oracles import glare

        return glare.evaluate(image, camera)
    if term == "exposure":
        from lightmeter.groundtruth.oracles import exposure

        return exposure.evaluate(image, camera)
    if term == "tone":
        from lightmeter.groundtruth.oracles import tone

        return tone.evaluate(image.astype(np.float32), camera.view)
    from lightmeter.groundtruth.oracles import encode

    return encode.evaluate(image.astype(np.float32))
