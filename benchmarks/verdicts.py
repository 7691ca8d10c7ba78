"""Thousands of gates on known truths: how many verdicts are wrong, how many are reached, and after how many samples.

    python benchmarks/verdicts.py [--gates 1000] [--pool FOLDER] [--json FILE] [--only CANDIDATE …]

Each gate draws 1-spp batches of a real scene with replacement from a pool, so that the truth is the pool's mean, and
judges the RMSE of the scene's real-time frame by the rule that `lightmeter gate` uses, at limits that put the error 5 %
or 20 % to either side. docs/verdicts.md has the figures.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table
from verdict_pools import Pool, pool

from lightmeter.device import fingerprint
from lightmeter.metrics.mse import rmse
from lightmeter.metrics.sequential import (
    Bound,
    effective_count,
    error_per_look,
    group_size,
    look,
    plan_looks,
    squared_contributions,
)
from lightmeter.realtime.device import Device

CANDIDATES = {
    "torus, no ambient": ("torus", ("constant_ambient",)),
    "posts, no ambient": ("posts", ("constant_ambient",)),
    "torus": ("torus", ()),
    "grid-sun, no ambient": ("grid-sun", ("constant_ambient",)),
    "grid-sun": ("grid-sun", ()),
}
"""Scenes and what their frames lack. The first two err everywhere, the others where the reference is noisy, too.
grid-sun has fireflies: its shiny spheres mirror a sun into each other."""

SIDE = 64

AWAY = (-0.20, -0.05, 0.05, 0.20)
"""How far the error is from the limit, as a fraction of the limit."""

CONFIDENCE = 0.999
BUDGET = 1024
WITHIN = 256


@dataclass(frozen=True)
class Tally:
    """What came of the gates of one candidate and distance.

    Attributes:
        wrong, decided: verdicts on the wrong side; verdicts at all, within `BUDGET` samples.
        within: verdicts within `WITHIN` samples.
        heavy: gates that gave no verdict because too few samples carried the spread.
        samples: the median, and the 95th percentile, of the samples per pixel that were drawn.
        saved: `BUDGET` over the mean of the samples drawn.
        milliseconds: of statistics for a gate, without rendering.
    """

    candidate: str
    away: float
    gates: int
    wrong: int
    decided: int
    within: int
    heavy: int
    samples: tuple[float, float]
    saved: float
    milliseconds: float


def main() -> None:
    """Run the gates, print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gates", type=int, default=1000)
    parser.add_argument("--pool", type=Path, default=Path("lightmeter-out/verdict-pools"), metavar="FOLDER")
    parser.add_argument("--batches", type=int, default=2048, help="in the pool")
    parser.add_argument("--only", choices=CANDIDATES, nargs="+", default=list(CANDIDATES), metavar="CANDIDATE")
    parser.add_argument("--json", type=Path, metavar="FILE")
    options = parser.parse_args()
    device, found, console = Device(), [], Console(width=160)
    for name in options.only:
        stored = pool(name, *CANDIDATES[name], SIDE, options.batches, device, options.pool)
        for away in AWAY:
            found.append(tally(stored, away, options.gates))
            console.print(found[-1], highlight=False)
    console.print(table(found))
    if options.json:
        document = {"device": fingerprint(device.renderer, device.version), "tallies": [asdict(t) for t in found]}
        options.json.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")


def tally(stored: Pool, away: float, gates: int) -> Tally:
    """Many gates, each with a seed of its own."""
    limit = stored.rmse / (1 + away)
    right = "within" if away < 0 else "beyond"
    start = time.perf_counter()
    ends = [gate(stored, limit, np.random.default_rng([seed, round(1000 * (1 + away))])) for seed in range(gates)]
    spent = time.perf_counter() - start
    drawn = np.array([samples for _, samples, _ in ends])
    decided = [(side, samples) for side, samples, _ in ends if side != "open"]
    return Tally(
        candidate=stored.name,
        away=away,
        gates=gates,
        wrong=sum(side != right for side, _ in decided),
        decided=len(decided),
        within=sum(samples <= WITHIN for _, samples in decided),
        heavy=sum(heavy for side, _, heavy in ends if side == "open"),
        samples=(float(np.median(drawn)), float(np.percentile(drawn, 95))),
        saved=float(BUDGET / drawn.mean()),
        milliseconds=1e3 * spent / gates,
    )


def gate(pool: Pool, limit: float, rng: np.random.Generator) -> tuple[str, int, bool]:
    """One gate: the side it found, the samples it drew, and whether its last look was one of heavy tails."""
    looks = plan_looks(BUDGET)
    bound, alpha = Bound(limit, limit), error_per_look(CONFIDENCE, limits=1, looks=len(looks))
    drawn = rng.integers(len(pool.batches), size=looks[-1])
    found = None
    for at in looks:
        groups = drawn[:at].reshape(-1, group_size(at))
        found = look(bound, alpha, lambda c, g=groups: rmse(pool.comparison(g, c)), lambda g=groups: count(pool, g))
        if found.side != "open":
            return found.side, at, False
    return "open", looks[-1], bool(found and found.heavy)


def count(pool: Pool, groups: np.ndarray) -> float:
    """Effective number of samples behind the squared error's spread."""
    means = [pool.batches[group].mean(axis=0) for group in groups]
    return effective_count(squared_contributions([(pool.frame - mean).reshape(-1, 3) for mean in means]))


def table(tallies: list[Tally]) -> Table:
    """The tallies for the terminal."""
    shown = Table()
    for name in (
        "candidate", "error against limit", "gates", "wrong", f"decided in {WITHIN} spp", f"in {BUDGET} spp",
        "heavy tails", "spp: median, 95 %", f"{BUDGET} spp / mean", "ms a gate",
    ):  # fmt: skip
        shown.add_column(name, justify="left" if name == "candidate" else "right")
    for t in tallies:
        share = [f"{100 * count / t.gates:.1f} %" for count in (t.within, t.decided, t.heavy)]
        samples = f"{t.samples[0]:.0f}, {t.samples[1]:.0f}"
        shown.add_row(
            t.candidate, f"{100 * t.away:+.0f} %", str(t.gates), str(t.wrong), *share, samples, f"{t.saved:.1f}",
            f"{t.milliseconds:.1f}",
        )  # fmt: skip
    return shown


if __name__ == "__main__":
    main()
