"""The benchmark: `make bench`, or `python benchmarks/run.py [--only SECTION,…] [--json FILE]`.

Absolute times depend on the machine and on what else it does; what is beside something (flip-evaluator, VTK) was
measured in the same run. docs/benchmarks.md says what is measured and how.
"""

import os

# As lightmeter's own command does: images are filtered by threads, with which a BLAS of several threads would fight.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import json
from dataclasses import asdict
from pathlib import Path

import beside_vtk
import flip_speed
import light_count
import passes
import processes
import shadows
import truth_speed
from figures import Figure, table
from rich.console import Console

from lightmeter.device import fingerprint
from lightmeter.realtime.device import Device

SECTIONS = {
    "processes": "whole processes",
    "passes": "frame time by pass, 512×512",
    "lights": "frame time over the number of lights, 512×512",
    "vtk": "grid-sun beside VTK, 512×512",
    "flip": "FLIP beside flip-evaluator, 512×512",
    "truth": "the truth, 512×512",
    "shadows": "shadow techniques, 512×512",
}
PICTURE = Path("lightmeter-out/benchmark/vtk-lightmeter-truth.png")


def main() -> None:
    """Measure, print a table per section, write JSON where asked to."""
    options = _parse()
    console = Console()
    if not console.is_terminal:
        console.width = 140
    device = Device()
    found: dict[str, list[Figure]] = {}

    def show(section: str, figures: list[Figure]) -> None:
        found[section] = figures
        console.print(table(SECTIONS[section], figures))

    if "processes" in options.only:
        show("processes", processes.measure())
    if "passes" in options.only:
        show("passes", passes.measure(device))
    if "lights" in options.only:
        show("lights", light_count.measure(device))
    if {"vtk", "flip"} & options.only:  # FLIP is timed on the frame and the truth of this section
        beside = beside_vtk.measure(device, options.spp, options.picture)
        show("vtk", beside.figures)
        console.print(f"VTK | lightmeter | truth: {options.picture}\n")
        if "flip" in options.only:
            show("flip", flip_speed.measure(beside.frame, beside.truth, beside.display))
    if "truth" in options.only:
        show("truth", truth_speed.measure(device))
    if "shadows" in options.only:
        show("shadows", shadows.measure(device))
    machine = fingerprint(device.renderer, device.version)
    console.print(", ".join(f"{name} {value}" for name, value in machine.items() if value is not None), style="dim")
    if options.json:
        document = {
            "device": machine,
            "sections": {name: [asdict(figure) for figure in figures] for name, figures in found.items()},
        }
        options.json.write_text(json.dumps(document, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


def _parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Measures lightmeter's speed, beside VTK and flip-evaluator.")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON, too")
    parser.add_argument("--only", type=_sections, default=set(SECTIONS), metavar="SECTION,…", help=", ".join(SECTIONS))
    parser.add_argument(
        "--spp", type=int, default=128, metavar="N", help="samples of the truth beside VTK (%(default)s)"
    )
    parser.add_argument(
        "--picture", type=Path, default=PICTURE, metavar="PNG", help="VTK | lightmeter | truth (%(default)s)"
    )
    return parser.parse_args()


def _sections(text: str) -> set[str]:
    names = set(text.split(","))
    if not names <= set(SECTIONS):
        raise argparse.ArgumentTypeError(f"expected some of {', '.join(SECTIONS)}, got {text!r}")
    return names


if __name__ == "__main__":
    main()
