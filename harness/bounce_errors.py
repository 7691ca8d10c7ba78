"""How much of the light that other surfaces scatter an effect recovers, bounce by bounce."""

import numpy as np

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.recovery import recovery
from lightmeter.realtime.graph import Plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.results import BounceShare
from lightmeter.sides import FramePoints
from lightmeter.stacking import mean_samples
from lightmeter.truth import Truth

BOUNCES = (1, 2, None)
"""Truths that an effect is held against: light scattered once by other surfaces, at most twice, as often as it is."""


def bounce_errors(renderer: Renderer, truth: Truth, at: FramePoints) -> tuple[BounceShare, ...]:
    """An effect that is for `indirect` alone, against paths that end after so many bounces, and against all.

    Args:
        at: the frame's points, at which the oracles are known.
    """
    effect = effect_for_bounces(renderer.plan)
    return () if effect is None else against_bounces(effect, truth, at)


def effect_for_bounces(plan: Plan) -> str | None:
    """The effect that declares `indirect` and nothing else; None where the frame has none."""
    return next((name for name, (effect, _) in plan.effects.items() if effect.terms == ("indirect",)), None)


def against_bounces(effect: str, truth: Truth, at: FramePoints) -> tuple[BounceShare, ...]:
    """What an effect gives of `indirect` against each number of bounces that the scene's paths have."""
    drawn = at.seen(()).truth  # on the surface that the frame has
    longest = truth.scene.max_depth
    tested = mean_samples(np.stack([capture.frame["indirect"] for capture in at.captures]))
    found = []
    for bounces in BOUNCES:
        # A path of depth 2 is direct light: each bounce of other surfaces is one more.
        if bounces is not None and 0 <= longest <= bounces + 2:
            continue
        exact = drawn if bounces is None else drawn.to_depth(bounces + 2)
        batches = [exact.batch(at.points, n, "frame", at.spp, terms=("indirect",)) for n in range(truth.batches)]
        truths = [mean_samples(batch.indirect) for batch in batches if batch.indirect is not None]
        error = recovery(Comparison([tested], truths))
        found.append(BounceShare(effect, bounces, **vars(error)))
    return tuple(found)
