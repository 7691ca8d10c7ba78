"""What each effect costs with its knobs as they come, at 512²: a row an effect, on a scene that needs it.

    python benchmarks/effect_times.py [--frames 20] [--output docs/effect-times.md]

An effect without passes of its own, such as one that changes what the G-buffer holds, is timed as the whole frame with
it and without it.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import datetime
from dataclasses import dataclass, replace
from pathlib import Path

from rich.console import Console

from lightmeter.device import fingerprint
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, Plan, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.realtime.timing import Time
from lightmeter.reports.significant import show_number
from lightmeter.scenes import library
from lightmeter.scenes.environments import built_in
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene

SIZE = (512, 512)
FIRST = ("posts", "cornell-box", "torus", "corner", "mirrors", "penumbra", "tessellation")
"""Scenes that are tried before the others."""
TEXT = """\
# What each effect costs

Written by `python benchmarks/effect_times.py` on {date}: knobs as they come, {size} pixels, the median over {frames}
frames after warm-up ± the median absolute deviation. What an effect bakes is made once, and its time holds the
compilation of its shaders. Times of a software rasteriser say little of a GPU's, and their ratios a little more.

| effect | term | scene | ms | of the frame's | baking, ms |
| --- | --- | --- | ---: | ---: | ---: |
{rows}

*whole*: the effect has no passes of its own; the frame with it, less the frame without, whose two medians differ by
some milliseconds of noise. `supersampling` comes with one sample.

{facts}.
"""


@dataclass(frozen=True)
class Row:
    """One effect's."""

    effect: str
    terms: tuple[str, ...]
    scene: str
    time: Time | None
    whole: float
    frame: Time
    baking: float | None


def scenes() -> list[Scene]:
    """The library's, those that show most first, and one in a map of its own."""
    names = [*FIRST, *(name for name in library.names() if name not in FIRST)]
    return [*map(load, names), replace(load("torus"), environment=built_in("studio"))]


def taking(effect: str, among: list[Scene]) -> tuple[Scene, Plan] | None:
    """The first scene in whose plan the effect takes part, and that plan."""
    for scene in among:
        plan = compile_plan(scene, effects(), Choice(use=(effect,)))
        if effect in plan.effects:
            return scene, plan
    return None


def measured(device: Device, effect: str, scene: Scene, plan: Plan, frames: int) -> Row:
    """The effect's passes, or the frame with it and without it."""
    renderer = Renderer(device, plan, SIZE)
    times = renderer.measure(frames)
    own, whole = times.of(effect), 0.0
    if own is None:
        without = compile_plan(scene, effects(), Choice(without=(effect,)))
        whole = times.frame.median - Renderer(device, without, SIZE).measure(frames).frame.median
    baked = renderer.baking.milliseconds.get(effect)
    return Row(effect, plan.terms_of(effect), plan.scene.name, own, whole, times.frame, baked)


def line(row: Row) -> str:
    """A row of the table."""
    if row.time is None:
        cost, share = f"{show_number(row.whole)} (whole)", row.whole / row.frame.median
    else:
        cost = f"{show_number(row.time.median)} ± {show_number(row.time.mad)}"
        share = row.time.median / row.frame.median
    baking = "" if row.baking is None else show_number(row.baking)
    return f"| `{row.effect}` | {', '.join(row.terms)} | {row.scene} | {cost} | {100 * share:.0f} % | {baking} |"


def main() -> None:
    """Measure, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--output", type=Path, default=Path("docs/effect-times.md"))
    args = parser.parse_args()
    console, device, among = Console(), Device(), scenes()
    rows = []
    for name in sorted(effects(), key=lambda name: (effects()[name].terms, name)):
        found = taking(name, among)
        if found is None:
            console.print(f"{name}: no scene takes it")
            continue
        rows.append(measured(device, name, *found, args.frames))
        console.print(line(rows[-1]))
    facts = ", ".join(f"{key} {value}" for key, value in fingerprint(device.renderer, device.version).items())
    args.output.write_text(
        TEXT.format(
            date=datetime.date.today(),
            size="×".join(map(str, SIZE)),
            frames=args.frames,
            rows="\n".join(map(line, rows)),
            facts=facts,
        ),
        encoding="utf-8",
    )
    console.print(f"wrote {args.output}")


if __name__ == "__main__":
    main()
