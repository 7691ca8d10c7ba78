"""What becomes of the rays that effects march, and what that costs."""

import numpy as np

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.mse import rmse
from lightmeter.metrics.objects import by_object
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.results import RayError, RayPart
from lightmeter.sides import FramePoints, contribution, some_offsets
from lightmeter.stacking import mean_samples
from lightmeter.truth import Truth


def ray_errors(renderer: Renderer, truth: Truth, at: FramePoints) -> tuple[RayError, ...]:
    """The squared error of every effect with verdicts, split by them.

    Args:
        at: the frame's points, at which the oracles are known. The sample nearest to the pixel's centre stands for it.
    """
    plan = renderer.plan
    centre = at.captures[int(np.argmin(np.linalg.norm(some_offsets(renderer.offsets), axis=1)))]
    found = []
    for name, verdicts in centre.verdicts.items():
        tested, exact = [], []
        for number in range(truth.batches):
            batch = truth.batch(at.points, number, "frame", at.spp, terms=plan.terms_of(name))
            for images, image in zip((tested, exact), contribution(plan, name, at.captures, batch), strict=True):
                images.append(mean_samples(image))
        comparison = Comparison(tested, exact)
        shares = by_object(comparison, np.where(centre.points.hit, verdicts, -1))
        nothing = RayPart(0, Measurement(0.0, how="no pixel"))
        parts = {
            verdict: RayPart(shares[number].pixels, shares[number].share) if number in shares else nothing
            for number, verdict in enumerate(plan.effects[name][0].verdicts)
        }
        found.append(RayError(name, rmse(comparison), parts))
    return tuple(found)
