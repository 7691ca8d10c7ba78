"""Closure: with every term exact, the composition at the G-buffer's points is the path traced image.

The interval of the bias must contain 0 and be narrow: a wide one proves nothing. The budgets below buy half-widths
under 5e-4 of the mean (`pytest -m slow`), and a quarter of them, which every run spends, about 1e-3;
`benchmarks/closure.py` buys 1e-4 and takes correspondingly longer. A right program misses 0 in one of twenty runs by the meaning of a 95 % interval: seeds
are fixed, so that it is decided once.
"""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.closure import closure_batches
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import measure
from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.framing import rolled
from lightmeter.scenes.load import load
from lightmeter.truth import Truth

HALF_WIDTHS = {1: 5e-4, 4: 1.25e-3}
"""Of the mean, by the part of a budget that is spent. A quarter gives twice the width, which 16 batches tell within
1/√(2·15) = 18 %."""

BATCHES = 16

ROLL = 20.0
"""Degrees that cameras are rolled about their axis.

A rasteriser snaps vertices to a grid of sub-pixels (llvmpipe: 1/256 of a pixel), and an edge that runs along the
pixels' rows then gains or loses a whole row of them at once. For the Cornell box's lamp that is 0.8 % of the mean in
one of a few hundred G-buffers: of mean 0, but with tails too heavy for an interval from 16 batches. Rolled, an edge
crosses the rows, and one pixel changes at a time.
"""

BUDGETS = {  # side of the image, samples per pixel, and how closure_batches spends its own
    "control": (64, 256, {"samples": 32}),
    "metal-rough-grid": (128, 3584, {"samples": 64, "spp": 2}),
    "torus": (64, 8192, {"samples": 128, "emission_spp": 128}),
    "cornell-box": (64, 8192, {"samples": 128, "emission_spp": 1024, "spp": 2}),
}


def closure(name: str, part: int = 1, seed: int = 0):
    """Composition and reference, K batches each, for one `part`-th of the budget."""
    side, spp, spending = BUDGETS[name]
    spp, spending = spp // part, {key: max(1, value // part) for key, value in spending.items()}
    scene = load(name)
    scene = replace(scene, camera=rolled(scene.camera, ROLL))
    truth = Truth(scene, (side, side), Budget(spp, least=BATCHES), seed)
    renderer = Renderer(Device(), compile_plan(scene, effects()), (side, side))
    return closure_batches(renderer, truth, **spending), truth.reference.batches


@pytest.mark.parametrize("part", [4, pytest.param(1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", BUDGETS)
def test_every_term_exact_gives_the_reference(name, part):
    images, batches = closure(name, part)
    bias = measure("relative_bias", images, batches)
    assert (bias.high - bias.low) / 2 <= HALF_WIDTHS[part]
    assert bias.low <= 0 <= bias.high


def test_a_bias_is_seen():
    """A composition that is 0.2 % too bright does not close: the interval is narrow enough to tell."""
    images, batches = closure("control")
    bias = Comparison(images * np.float32(1.002), batches)
    assert measure("relative_bias", bias.tested_batches, bias.reference).low > 0
