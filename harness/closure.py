"""Closure: the composition with every term exact, to be held against the reference."""

import numpy as np

from lightmeter.groundtruth.content import points_key
from lightmeter.groundtruth.oracles import coverage
from lightmeter.groundtruth.store import Series
from lightmeter.progress import Report, silent
from lightmeter.realtime.renderer import Renderer
from lightmeter.sides import MOST_SAMPLES
from lightmeter.stacking import stack_points
from lightmeter.truth import FAMILIES, Truth


def closure_batches(
    renderer: Renderer,
    truth: Truth,
    report: Report = silent,
    samples: int = MOST_SAMPLES,
    emission_spp: int = 32,
    spp: int | None = None,
) -> np.ndarray:
    """(K, H, W, 3) float32: images with every term exact, each at sub-pixel offsets of its own.

    Args:
        samples: sub-pixel offsets per batch, at most.
        emission_spp: samples per pixel of the control variate: the edge of a bright lamp holds most of what shared
            sub-pixel offsets leave uncertain, and what is seen to emit can be traced by itself.
        spp: the oracles' samples per point and offset; by default they get the reference's, shared by the offsets.
    """
    count, samples = truth.batches, min(truth.reference.spp, samples)
    spp = spp or max(1, truth.reference.spp // samples)
    # The centre's points stand for the rasteriser: another one, or other shaders, and nothing stale is recalled.
    series = Series.of(
        "closure",
        truth.scene,
        truth.size,
        truth.reference.spp,
        truth.seed,
        samples=(samples, emission_spp, spp),
        points=points_key(renderer.capture(terms=False).points),
    )
    offsets = coverage.evaluate(count, samples, seed=truth.seed + FAMILIES["closure"]) - 0.5

    def make(batch: int) -> np.ndarray:
        places = offsets[batch]
        seen = [renderer.capture(tuple(place), terms=False).points for place in places]
        exact = truth.batch(truth.exact_material(stack_points(seen)), batch, "closure", spp, keep=False)
        return (exact.composition() + truth.emission_variate(places, batch, emission_spp)).astype(np.float32)

    images = []
    for batch in range(count):
        report("closure", batch, count)
        if truth.store is None:
            images.append(make(batch))
        else:
            layers, _ = truth.store.recall(series, f"batch-{batch:04d}", lambda b=batch: {"": make(b)})
            images.append(layers[""])
    report("closure", count, count)
    return np.stack(images)
