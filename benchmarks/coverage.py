"""How often intervals and bounds hold the truth: 95 % of the time, as they say?

    python benchmarks/coverage.py [--trials 2000] [--bound-trials 100] [--pool 1024] [--scene NAME …]

A pool of 1-spp batches of a real scene stands for its path tracer: batches are drawn from it with replacement, so the
truth is exactly the pool's mean. The result goes to docs/coverage.md; the tests hold a smaller version
(tests/metrics/test_coverage.py).
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # a process per core instead; before NumPy is imported

import argparse
import datetime
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from rich.console import Console
from scipy.stats import binom

from lightmeter.device import fingerprint
from lightmeter.groundtruth.batches import reference
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.moments import Moments
from lightmeter.metrics.registry import METRICS, measure, measure_all
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.significant import show_number
from lightmeter.scenes.load import load

SCENES = ("torus", "cornell-box", "grid-sun")
IMAGES = ("the frame", "2 % too bright", "perfect")
LEVEL = 0.95
DOUBT = 1e-3
"""The probability that a coverage of exactly LEVEL is called too low."""
INTERVALS = ("mse", "relmse", "bias")
BOUNDS = (
    "flip", "flip_p95", "flip_p99", "flip_worst_tile", "ssim", "mae", "rms_p95", "rms_p99", "rms_worst_tile",
    "delta_e_itp",
)  # fmt: skip
DRAWS = ((8, 1), (16, 1), (64, 1), (8, 16), (8, 64))
"""(batches, samples per pixel of a batch) of the intervals."""
BOUND_DRAWS = (8, 16, 64)

TEXT = """\
# Coverage

A stated 95 % has to hold the truth 95 % of the time. Here it is counted. A pool of {pool} batches of one sample per
pixel stands for a scene's path tracer at {size}²; batches are drawn from it with replacement, so the truth is exactly
the pool's mean. Tested are the real-time frame, the truth made 2 % too bright (an error far below the noise), and the
truth itself.

Written by `{command}` on {date}.

## Intervals of MSE, relmse and bias

{trials} trials each. Expected is 95 % or more, but for chance: an exact 95 % gives less than {fewest} with a
probability of {doubt}; such figures are bold. "Error" is the image's RMSE over the noise of one batch. Near zero the
MSE's interval is longer than it must be: it has to be for noise in a single direction, which {size}² pixels are not.

| scene | image | error | batches × spp | mse | relmse | bias |
| --- | --- | ---: | ---: | ---: | ---: | ---: |
{intervals}

What falls short are the fireflies of `grid-sun`, whose pixels have a tail of index 1.4: where none of the K batches has
met one, nothing in them says that it exists, and no interval made from them can hold its level. With 64 samples a
batch they are nearly covered. `compare` counts how many samples carry the spread and says so where they are few; a gate
leaves such a reference undecided.

## Bounds of metrics that noise biases

{bound_trials} trials each, batches of one sample: coverage in per cent. An exact 95 % gives less than {bound_fewest}
with a probability of {doubt}; such figures are bold. What falls short is the worst tile of fireflies: where its error
is one rare bright sample, most draws have not met it.

| scene | image | batches | {bound_names} |
| --- | --- | ---: | {rule} |
{bounds}

What these bounds look like: the truth, then value, and the medians of the extrapolated value and of the bound's ends.

| scene | image | batches | metric | truth | value | extrapolated | low | high |
| --- | --- | ---: | --- | ---: | ---: | ---: | ---: | ---: |
{widths}

## A perfect image, with and without correction

RMSE of the truth itself against 8 batches, naive (the root of the mean squared difference from their mean) and
lightmeter's, over the reference's mean:

| scene | naive | lightmeter, with its interval |
| --- | ---: | ---: |
{naive}

Machine: {facts}. {minutes:.0f} minutes.
"""


class Drawn(Comparison):
    """Batches of which only the moments are known: what MSE and bias need."""

    def __init__(self, moments: Moments) -> None:
        self.__dict__["moments"] = moments
        self.confidence = LEVEL

    def unusable(self, spatial: bool = False) -> bool:
        return False


@dataclass(frozen=True)
class Cell:
    """One scene and tested image."""

    scene: str
    image: str
    folder: Path

    def pool(self) -> np.ndarray:
        """(pool, H, W, 3) float32, from the file."""
        return np.load(self.folder / f"{self.scene}.npy", mmap_mode="r")

    def tested(self, truth: np.ndarray) -> np.ndarray:
        """(H, W, 3)."""
        return {
            "the frame": np.load(self.folder / f"{self.scene}-frame.npy"),
            "2 % too bright": truth * 1.02,
            "perfect": truth,
        }[self.image]


@dataclass(frozen=True)
class Coverage:
    """What was found of one cell.

    Attributes:
        cell: which.
        draw: batches and samples per pixel of each.
        hits: metric to the number of trials that held the truth.
        truth: metric to the truth.
        found: metric to the medians of value, corrected, low and high.
        error: the image's RMSE over the noise of one batch.
    """

    cell: Cell
    draw: tuple[int, int]
    hits: dict[str, int]
    truth: dict[str, float]
    found: dict[str, tuple[float, ...]]
    error: float = 0.0


def intervals(cell: Cell, trials: int) -> list[Coverage]:
    """MSE, relmse and bias, from the pool's Gram matrices alone."""
    pool = np.asarray(cell.pool(), np.float64)
    truth = pool.mean(axis=0)
    tested, values = cell.tested(truth), truth.size
    flat = pool.reshape(len(pool), -1)
    differences = tested.ravel() - flat
    whole = Moments(
        values, differences @ differences.T / values, flat @ flat.T / values, differences.mean(1), flat.mean(1)
    )
    mean_square = float(whole.gram.mean())
    exact = {
        "mse": mean_square,
        "relmse": mean_square / float(whole.reference_gram.mean()),
        "bias": float(whole.difference_means.mean()),
    }
    noise = float(np.diag(whole.gram).mean()) - mean_square
    return [
        _of_intervals(cell, draw, trials, whole, exact, np.sqrt(max(0.0, mean_square) / noise * draw[1]))
        for draw in DRAWS
    ]


def _of_intervals(
    cell: Cell, draw: tuple[int, int], trials: int, whole: Moments, exact: dict[str, float], error: float
) -> Coverage:
    random = np.random.default_rng([*draw, SCENES.index(cell.scene)])
    hits = dict.fromkeys(exact, 0)
    for _ in range(trials):
        drawn = Drawn(_averaged(whole, random.integers(whole.batches, size=draw)))
        for name, truth in exact.items():
            hits[name] += _holds(METRICS[name].function(drawn), truth)
    return Coverage(cell, draw, hits, exact, {}, error)


def _averaged(whole: Moments, which: np.ndarray) -> Moments:
    """The moments of batches that are means of `which` (batches, samples) of the pool's."""
    batches, samples = which.shape
    if samples == 1:
        drawn, at = which[:, 0], np.ix_(which[:, 0], which[:, 0])
        means = whole.difference_means[drawn], whole.reference_means[drawn]
        return Moments(whole.values, whole.gram[at], whole.reference_gram[at], *means)
    grams, means = (whole.gram, whole.reference_gram), (whole.difference_means, whole.reference_means)
    at = np.ix_(which.ravel(), which.ravel())
    averaged = (gram[at].reshape(batches, samples, batches, samples).mean(axis=(1, 3)) for gram in grams)
    return Moments(whole.values, *averaged, *(mean[which].mean(axis=1) for mean in means))


def bounds(cell: Cell, batches: int, trials: int) -> Coverage:
    """The metrics that noise biases, from drawn images."""
    pool = cell.pool()
    truth = np.asarray(pool, np.float64).mean(axis=0)
    tested = cell.tested(truth)
    display = display_transform(compile_plan(load(cell.scene), effects()))
    exact = {name: m.value for name, m in measure_all(BOUNDS, Comparison(tested, truth), display=display).items()}
    random = np.random.default_rng([batches, SCENES.index(cell.scene), 1])
    found: dict[str, list[Measurement]] = {name: [] for name in BOUNDS}
    for _ in range(trials):
        drawn = Comparison(tested, pool[random.integers(len(pool), size=batches)], confidence=LEVEL)
        for name, measurement in measure_all(BOUNDS, drawn, display=display).items():
            found[name].append(measurement)
    medians = {
        name: tuple(
            float(np.median([getattr(m, field) for m in measured])) for field in ("value", "corrected", "low", "high")
        )
        for name, measured in found.items()
    }
    hits = {name: sum(_holds(m, exact[name]) for m in measured) for name, measured in found.items()}
    return Coverage(cell, (batches, 1), hits, exact, medians)


def _holds(measurement: Measurement, truth: float) -> bool:
    rounding = 1e-6  # of float32 maps: an SSIM of 1 may come out as 0.9999999
    return measurement.low - rounding <= truth <= measurement.high + rounding


def store(scene: str, folder: Path, device: Device, size: int, pool: int) -> None:
    """Makes a scene's pool and its real-time frame."""
    loaded = load(scene)
    np.save(folder / f"{scene}.npy", reference(loaded, (size, size), spp=1, batches=pool).batches)
    frame = Renderer(device, compile_plan(loaded, effects()), (size, size)).render()
    np.save(folder / f"{scene}-frame.npy", frame.radiance)


def perfect_row(scene: str, folder: Path) -> str:
    """The naive and the corrected nrmse of the truth itself, against 8 batches."""
    cell = Cell(scene, "perfect", folder)
    pool = np.asarray(cell.pool(), np.float64)
    truth, batches = pool.mean(axis=0), pool[:8]
    naive = float(np.sqrt(np.mean((truth - batches.mean(axis=0)) ** 2)) / batches.mean())
    found = measure("nrmse", truth, batches)
    low, high = show_number(found.low), show_number(found.high)
    return f"| {scene} | {show_number(naive)} | {show_number(found.value)} ({low} … {high}) |"


def shown(hits: int, trials: int) -> str:
    """Coverage in per cent, bold where it is below LEVEL beyond chance."""
    text = f"{100 * hits / trials:.1f}"
    return f"**{text}**" if hits < binom.ppf(DOUBT, trials, LEVEL) else text


def fewest(trials: int) -> str:
    """The lowest coverage that is not bold."""
    return f"{100 * binom.ppf(DOUBT, trials, LEVEL) / trials:.1f} %"


def interval_row(found: Coverage, trials: int) -> str:
    """A row of the table of intervals."""
    covers = " | ".join(shown(found.hits[name], trials) for name in INTERVALS)
    batches, spp = found.draw
    cell = found.cell
    return f"| {cell.scene} | {cell.image} | {show_number(round(found.error, 6), 2)} | {batches} × {spp} | {covers} |"


def bound_row(found: Coverage, trials: int) -> str:
    """A row of the table of bounds."""
    covers = " | ".join(shown(found.hits[name], trials) for name in BOUNDS)
    return f"| {found.cell.scene} | {found.cell.image} | {found.draw[0]} | {covers} |"


def width_rows(found: Coverage) -> list[str]:
    """What the bounds of some metrics look like."""
    head = f"| {found.cell.scene} | {found.cell.image} | {found.draw[0]} |"
    return [
        f"{head} {name} | {' | '.join(show_number(x, 3) for x in (found.truth[name], *found.found[name]))} |"
        for name in ("flip", "flip_p99", "flip_worst_tile", "ssim", "rms_worst_tile")
    ]


def main() -> None:
    """Count, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=2000)
    parser.add_argument("--bound-trials", type=int, default=100)
    parser.add_argument("--pool", type=int, default=1024)
    parser.add_argument("--size", type=int, default=48)
    parser.add_argument("--scene", nargs="+", choices=SCENES, default=SCENES)
    parser.add_argument("--output", type=Path, default=Path("docs/coverage.md"))
    args = parser.parse_args()
    console, start = Console(stderr=True), time.perf_counter()
    with tempfile.TemporaryDirectory() as name:
        folder, device = Path(name), Device()
        for scene in args.scene:
            store(scene, folder, device, args.size, args.pool)
            console.print(f"{scene}: {args.pool} batches")
        cells = [Cell(scene, image, folder) for scene in args.scene for image in IMAGES]
        with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:  # OpenGL and Mitsuba do not survive a fork
            of_intervals = [pool.submit(intervals, cell, args.trials) for cell in cells]
            of_bounds = [pool.submit(bounds, cell, k, args.bound_trials) for cell in cells for k in BOUND_DRAWS]
            interval_rows = [interval_row(f, args.trials) for future in of_intervals for f in future.result()]
            console.print("\n".join(interval_rows), highlight=False, soft_wrap=True)
            found = []
            for future in of_bounds:
                found.append(future.result())
                console.print(bound_row(found[-1], args.bound_trials), highlight=False, soft_wrap=True)
        naive = "\n".join(perfect_row(scene, folder) for scene in args.scene)
    facts = ", ".join(f"{key} {value}" for key, value in fingerprint(device.renderer, device.version).items())
    text = TEXT.format(
        pool=args.pool,
        size=args.size,
        command=f"python benchmarks/coverage.py --trials {args.trials} --bound-trials {args.bound_trials}",
        date=datetime.date.today(),
        trials=args.trials,
        fewest=fewest(args.trials),
        doubt=f"{DOUBT:g}",
        intervals="\n".join(interval_rows),
        bound_trials=args.bound_trials,
        bound_fewest=fewest(args.bound_trials),
        bound_names=" | ".join(BOUNDS),
        rule=" | ".join(["---:"] * len(BOUNDS)),
        bounds="\n".join(bound_row(f, args.bound_trials) for f in found),
        widths="\n".join(row for f in found if f.draw[0] == 64 for row in width_rows(f)),
        naive=naive,
        facts=facts,
        minutes=(time.perf_counter() - start) / 60,
    )
    args.output.write_text(text, encoding="utf-8")
    console.print(f"wrote {args.output}")


if __name__ == "__main__":
    main()
