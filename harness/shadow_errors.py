"""What kind of mistake each light's shadow makes, effect by effect."""

import numpy as np

from lightmeter.metrics.shadow_error import shadow_error
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.results import LightShadow
from lightmeter.sides import FramePoints, some_offsets
from lightmeter.stacking import mean_samples
from lightmeter.truth import Truth


def shadow_errors(renderer: Renderer, truth: Truth, at: FramePoints) -> tuple[LightShadow, ...]:
    """The split error of every visibility of a light, in the order they are drawn.

    Args:
        at: the frame's points, at which the oracles are known.
    """
    plan = renderer.plan
    # The sample nearest to the pixel's centre stands for the pixel.
    centres = at.captures[int(np.argmin(np.linalg.norm(some_offsets(renderer.offsets), axis=1)))].points
    found = []
    for step in plan.steps:
        light = step.light
        if "visibility" not in step.writes or light is None:
            continue
        seen = np.stack([capture.visibility[light] for capture in at.captures])
        batches = (at.batch((), n, at.spp, terms=("visibility",)) for n in range(truth.batches))
        exact = [(batch.direct[light], batch.shadowed[light]) for batch in batches]
        error = shadow_error(
            [mean_samples(b * seen) for b, _ in exact],
            [mean_samples(a) for _, a in exact],
            [mean_samples(b) for b, _ in exact],
            centres.shape,
            centres.position,
        )
        found.append(LightShadow(step.effect, plan.scene.all_lights[light].name, error.rmse, error.parts))
    return tuple(found)
