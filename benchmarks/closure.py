"""The closure in a longer run: with every term exact, is the composition the path traced image?

    python benchmarks/closure.py [--goal 1e-4] [--minutes 10] [--scene NAME …] [--output docs/closure.md]

Batches are added, scene by scene, until the bias is known to the goal or the time is up; the result goes to
docs/closure.md. The tests hold the same to 5e-4 in a minute (tests/harness/test_closure.py).
"""

import argparse
import datetime
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from rich.console import Console

from lightmeter.closure import closure_batches
from lightmeter.device import fingerprint
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.registry import measure
from lightmeter.options import MIN_BATCHES, Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.significant import show_number
from lightmeter.scenes.framing import rolled
from lightmeter.scenes.load import load
from lightmeter.truth import Truth

TEXT = """\
# Closure

With every term exact, the composition at the G-buffer's points is the rendering equation, and must be the path traced
image. Both sides share the scene and the meaning of its materials and lights, nothing else: the reference knows
nothing of the G-buffer. What is left is printed as "unexplained" in every report; here it is measured until its 95 %
interval is at most ± {goal} of the image's mean. A wide interval proves nothing, and one scene in twenty misses 0 by
the meaning of 95 %.

Written by `python benchmarks/closure.py --goal {goal} --seed {seed}` on {date}.

| scene | size | spp | sub-pixel offsets | bias | ± | 0 within | nrmse | seconds |
| --- | --- | ---: | ---: | ---: | ---: | --- | ---: | ---: |
{rows}

The bias is signed, composition minus reference, as a fraction of the reference's mean. The nrmse is free of the noise
of both sides; 0 means that the images differ by less than that noise can tell.

Machine: {facts}.
"""


@dataclass(frozen=True)
class Plan:
    """What one round of 8 batches holds; rounds are added until the goal is met.

    Attributes:
        side: of the square image, in pixels.
        spp: samples per pixel of the reference.
        samples: sub-pixel offsets per batch.
        emission_spp: samples per pixel and batch of the emission's control variate.
        oracle_spp: samples per pixel and offset of every oracle.
    """

    side: int
    spp: int
    samples: int
    emission_spp: int
    oracle_spp: int


PLANS = {
    "control": Plan(64, 1024, 128, 32, 1),
    "metal-rough-grid": Plan(128, 8192, 32, 64, 32),
    "torus": Plan(64, 16384, 128, 256, 16),
    "cornell-box": Plan(128, 4096, 64, 1024, 2),
}
ROLL = 20.0
"""Degrees that cameras are rolled about their axis."""
SEEDS = 1 << 10
"""From a round to the next: some random numbers of a batch are named by the sum of the seed and the batch."""


@dataclass
class Sums:
    """Batches as they come, in bounded memory.

    The relative bias is a ratio of sums over pixels, so a batch's mean stands for the batch: a picture of one pixel.
    The nrmse needs whole pictures; the k-th batches of all rounds are averaged into the k-th of 8.
    """

    tested: list[np.ndarray]
    truth: list[np.ndarray]
    tested_mean: np.ndarray
    truth_mean: np.ndarray
    rounds: int = 0

    def bias(self) -> Measurement:
        """The relative bias from every batch."""
        return measure("relative_bias", np.concatenate(self.tested), np.concatenate(self.truth))

    def nrmse(self) -> Measurement:
        """The nrmse of the 8 averaged batches."""
        return measure("nrmse", self.tested_mean, self.truth_mean)

    def add(self, tested: np.ndarray, truth: np.ndarray) -> None:
        """Another round, (8, H, W, 3) each."""
        self.tested.append(tested.mean(axis=(1, 2), keepdims=True, dtype=np.float64))
        self.truth.append(truth.mean(axis=(1, 2), keepdims=True, dtype=np.float64))
        self.rounds += 1
        self.tested_mean += (tested - self.tested_mean) / self.rounds
        self.truth_mean += (truth - self.truth_mean) / self.rounds


@dataclass(frozen=True)
class Closed:
    """What was found for a scene."""

    scene: str
    plan: Plan
    rounds: int
    bias: Measurement
    nrmse: Measurement
    seconds: float

    @property
    def half_width(self) -> float:
        """Of the bias' 95 % interval."""
        return half_width(self.bias)


def half_width(measurement: Measurement) -> float:
    """Half the length of the interval."""
    return (measurement.high - measurement.low) / 2


def rounds(name: str, device: Device, seed: int) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Rounds of 8 batches of the composition and of the reference, each with seeds of its own."""
    plan, scene = PLANS[name], load(name)
    # Edges along the pixels' rows would gain or lose whole rows where vertices are snapped to 1/256 of a pixel.
    scene = replace(scene, camera=rolled(scene.camera, ROLL))
    size = plan.side, plan.side
    renderer = Renderer(device, compile_plan(scene, effects()), size)
    while True:
        truth = Truth(scene, size, Budget(plan.spp), seed)
        images = closure_batches(
            renderer, truth, samples=plan.samples, emission_spp=plan.emission_spp, spp=plan.oracle_spp
        )
        yield images, truth.reference.batches
        seed += SEEDS


def close(name: str, device: Device, goal: float, seconds: float, seed: int, console: Console) -> Closed:
    """Adds rounds until the half-width is at most `goal` or `seconds` have passed."""
    side = PLANS[name].side
    empty = np.zeros((MIN_BATCHES, side, side, 3))
    sums, start = Sums([], [], empty, empty.copy()), time.perf_counter()
    for tested, truth in rounds(name, device, seed):
        sums.add(tested, truth)
        bias, spent = sums.bias(), time.perf_counter() - start
        half = half_width(bias)
        # Half-widths fall with the root of the number of rounds.
        left = max(0.0, (half / goal) ** 2 - 1) * spent
        console.print(
            f"{name}: {bias.value:+.2e} ± {half:.2e} after {spent:.0f} s, about {left:.0f} s left", style="dim"
        )
        if half <= goal or spent * (1 + 1 / sums.rounds) > seconds:
            return Closed(name, PLANS[name], sums.rounds, bias, sums.nrmse(), spent)
    raise AssertionError("rounds never end")


def document(closed: list[Closed], goal: float, seed: int, machine: dict) -> str:
    """The result as Markdown."""
    facts = ", ".join(f"{name} {value}" for name, value in machine.items() if value is not None)
    return TEXT.format(
        goal=f"{goal:g}",
        seed=seed,
        date=f"{datetime.date.today():%Y-%m-%d}",
        rows="\n".join(row(one, goal) for one in closed),
        facts=facts,
    )


def row(closed: Closed, goal: float) -> str:
    """A scene's row of the table."""
    plan = closed.plan
    cells = (
        closed.scene,
        f"{plan.side}²",
        closed.rounds * plan.spp,
        closed.rounds * MIN_BATCHES * plan.samples,
        f"{closed.bias.value:+.1e}",
        f"{closed.half_width:.1e}",
        verdict(closed, goal),
        show_number(closed.nrmse.value),
        f"{closed.seconds:.0f}",
    )
    return f"| {' | '.join(map(str, cells))} |"


def verdict(closed: Closed, goal: float) -> str:
    """Whether the interval holds 0, and whether it is narrow enough to say so."""
    held = "yes" if closed.bias.low <= 0 <= closed.bias.high else "**no**"
    return held if closed.half_width <= goal else f"{held}, too wide"


def main() -> None:
    """Run, print, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--goal", type=float, default=1e-4, metavar="X", help="half-width of the bias (%(default)s)")
    parser.add_argument("--minutes", type=float, default=10, metavar="M", help="at most, per scene (%(default)s)")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="first seed (%(default)s)")
    parser.add_argument("--scene", nargs="+", choices=PLANS, default=list(PLANS), help="default: all")
    parser.add_argument("--output", type=Path, metavar="FILE", help="write the table here, such as docs/closure.md")
    options = parser.parse_args()
    console, device = Console(), Device()
    closed = [close(name, device, options.goal, options.minutes * 60, options.seed, console) for name in options.scene]
    text = document(closed, options.goal, options.seed, fingerprint(device.renderer, device.version))
    console.print(text, markup=False, highlight=False, soft_wrap=True)
    if options.output:
        options.output.parent.mkdir(parents=True, exist_ok=True)
        options.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
