"""Closure on the truth's side alone: the oracles composed at ray-cast points are the reference.

The harness does the same with a rasterised G-buffer. Here a hole in the oracles (a term counted twice, a wrong side)
shows without any rasteriser. Sub-pixel offsets are shared by all pixels, as a rasteriser's are, and `seen_emission`
takes away the noise that this puts into bright lights' edges.
"""

import numpy as np
import pytest
from scipy import stats

from lightmeter.groundtruth.oracles import coverage, environment_visibility, indirect, visibility
from lightmeter.groundtruth.primary import seen_emission, surface_points
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.world import World
from lightmeter.scenes.load import load

from .noise import assert_same_mean, blocks


def composed(world: World, size, spp: int, batch: int, offsets: np.ndarray, steady: np.ndarray) -> np.ndarray:
    total = np.zeros((size[1], size[0], 3))
    for j, offset in enumerate(offsets):
        points = surface_points(world, size, offset)
        image = points.emission.astype(float) - seen_emission(world, size, offset) + steady
        how = {"spp": spp, "seed": j, "batch": batch}
        for light in range(len(world.scene.all_lights)):
            image += visibility.evaluate(world, points, light, **how)[0]
        image += environment_visibility.evaluate(world, points, **how)[0]
        image += indirect.evaluate(world, points, **how)
        total += image / len(offsets)
    return total


@pytest.mark.parametrize(
    ("name", "frames", "spp", "reference_spp", "half_width"),
    [
        ("control", 8, 2, 64, 3e-4),
        ("torus", 12, 2, 64, 2.5e-3),
        ("cornell-box", 4, 16, 64, 2.5e-3),
        pytest.param("torus", 24, 4, 256, 1e-3, marks=pytest.mark.slow),
        pytest.param("cornell-box", 8, 32, 256, 1e-3, marks=pytest.mark.slow),
    ],
)
def test_the_composition_of_all_oracles_is_the_reference(name, frames, spp, reference_spp, half_width):
    """The mean's bias is 0 within its 95 % interval, widened to a false alarm in 10⁴; the interval must be narrow."""
    world, size, count = World.of(load(name)), (64, 64), 12
    steady = seen_emission(world, size, spp=1024)
    offsets = coverage.evaluate(count, frames, seed=3)
    ours = np.stack([composed(world, size, spp, b, offsets[b], steady) for b in range(count)])
    truth = np.stack([render_batch(world, size, reference_spp, 1, b) for b in range(count)])
    a, b = ours.mean(axis=(1, 2, 3)), truth.mean(axis=(1, 2, 3), dtype=float)
    error = np.sqrt(a.var(ddof=1) / count + b.var(ddof=1) / count)
    bias, width = (a.mean() - b.mean()) / b.mean(), stats.t.ppf(0.975, count - 1) * error / b.mean()
    print(f"{name}: bias {bias:.2e} ± {width:.2e} of the mean")
    assert width <= half_width
    assert_same_mean(a, b)
    assert_same_mean(blocks(ours, 16), blocks(truth, 16))
