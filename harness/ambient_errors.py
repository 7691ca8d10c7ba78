"""How far ambient visibility is from the term, and from the classical ambient occlusion that techniques aim at."""

import math

import numpy as np

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import measure_all
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.results import AmbientError
from lightmeter.sides import FramePoints
from lightmeter.stacking import mean_samples
from lightmeter.truth import Truth

METRICS = ("rmse", "relative_bias")


def ambient_errors(renderer: Renderer, truth: Truth, at: FramePoints) -> tuple[AmbientError, ...]:
    """The error of the environment's visibility against the term, and against occlusion within its radius or any.

    All are stated in radiance, weighted with the exact unoccluded environment, so that they compare: had the term been
    another, this would be the error.

    Args:
        at: the frame's points, at which the oracles are known.
    """
    plan = renderer.plan
    drawn = at.seen(()).truth  # on the surface that the frame has
    steps = [step for step in plan.steps if "environment_visibility" in step.writes]
    if not steps:
        return ()
    name = steps[0].effect
    seen = np.stack([capture.frame["environment_visibility"] for capture in at.captures])
    wanted = ("environment", "environment_visibility")
    batches = [at.batch((), n, at.spp, terms=wanted) for n in range(truth.batches)]
    tested = [mean_samples(batch.environment * seen) for batch in batches]

    def error(kind: str, radius: float | None, exact: list[np.ndarray]) -> AmbientError:
        return AmbientError(name, kind, radius, measure_all(METRICS, Comparison(tested, exact)))

    def occlusion(radius: float) -> list[np.ndarray]:
        shares = (drawn.ambient_occlusion(at.points, radius, n, at.spp) for n in range(truth.batches))
        return [mean_samples(b.environment * s[..., None]) for b, s in zip(batches, shares, strict=True)]

    found = [error("term", None, [mean_samples(batch.environment_shadowed) for batch in batches])]
    radius = plan.effects[name][1].get("radius")
    if radius is not None:
        found.append(error("occlusion", float(radius), occlusion(float(radius))))
    return (*found, error("occlusion", None, occlusion(math.inf)))
