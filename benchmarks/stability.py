"""How many digits does GGX keep, as the textbook writes it and by the cross product, against α?

    python benchmarks/stability.py [--plot FILE.svg]

The figures go to docs/stability.md; `lightmeter stress` has the other functions.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from lightmeter.realtime.device import Device
from lightmeter.realtime.stress.ggx_forms import Curve, curves, least_alpha

# Okabe & Ito 2008; the dash tells the arithmetic, so that no colour has to.
COLOURS = {"ggx_textbook": "#D55E00", "ggx_cross": "#0072B2"}
NAMES = {"ggx_textbook": "textbook", "ggx_cross": "cross product"}
DASHES = {"fp32": "-", "mediump": "--", "mediump, denormals flushed": ":"}
CLAMPS = {0.045: "Filament, desktop: 0.045", 0.089: "Filament, mobile: 0.089"}


def main() -> None:
    """Measure, print, draw."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plot", type=Path, metavar="FILE.svg")
    args = parser.parse_args()
    found = curves(Device(), np.geomspace(1e-6, 1, 121))
    Console().print(table(found))
    if args.plot:
        draw(found, args.plot)


def table(found: Sequence[Curve]) -> Table:
    """From which α up each form keeps 1 % and 10 %."""
    shown = Table(title="the smallest α from which up D keeps …")
    for column in ("form", "arithmetic", "1 %", "10 %", "1 % of the peak", "10 % of the peak"):
        shown.add_column(column)
    for curve in found:
        least = [least_alpha(curve, digits, peak) for peak in (False, True) for digits in (2.0, 1.0)]
        shown.add_row(NAMES[curve.form], curve.arithmetic, *(f"{a:.2g} (r {a**0.5:.3f})" for a in least))
    return shown


def draw(found: Sequence[Curve], path: Path) -> None:
    """Digits at the worst half vector within 3 α (matplotlib comes with VTK)."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.rcParams |= {"svg.hashsalt": "lightmeter", "font.size": 11}
    figure, axes = pyplot.subplots(figsize=(8.5, 4.6), layout="constrained")
    for curve in found:
        label = f"{NAMES[curve.form]}, {curve.arithmetic}"
        axes.plot(curve.alphas, curve.digits, DASHES[curve.arithmetic], color=COLOURS[curve.form], lw=2, label=label)
    for roughness, name in CLAMPS.items():
        axes.axvline(roughness**2, color="#666666", lw=1)
        axes.text(roughness**2, 7.0, f" {name}", rotation=90, va="top", ha="left", fontsize=8, color="#444444")
    axes.axhline(2, color="#999999", lw=0.8, ls=(0, (1, 3)))
    axes.set(xscale="log", xlabel="α = roughness²", ylabel="digits kept by D", ylim=(0, 7.2), xlim=(1e-6, 1))
    axes.legend(fontsize=9, loc="upper left")
    axes.grid(alpha=0.25)
    figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main()
