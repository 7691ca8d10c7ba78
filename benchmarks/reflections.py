"""The techniques for reflections side by side: error of `indirect` against the truth, where it is, and milliseconds.

    python benchmarks/reflections.py [--size 128] [--spp 256] [--output TABLES.md]

Writes the tables of docs/reflections.md.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from judged import machine, parser, publish
from rich.console import Console

from lightmeter.groundtruth.store import Store
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.mse import rmse
from lightmeter.metrics.objects import by_object
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.ray_errors import ray_errors
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.ray_content import FATES
from lightmeter.reports.results import RayError
from lightmeter.reports.significant import show_number
from lightmeter.scenes.load import load
from lightmeter.sides import FramePoints, effect_sides
from lightmeter.truth import Truth

TIMED_SIZE = (256, 256)
FRAMES = 7
SCENES = {
    "mirrors": ("wall mirror", "floor mirror", "ball", "rough plate", "floor"),
    "area-lights": (),
}
"""Scenes, and the shapes whose errors are shown by themselves."""
STEPS = (8, 16, 32, 64, 128, 256)
LIT = ("ltc_area_light", "pcss")
"""What lights the frames: the best there is, so that reflections show what is right."""


@dataclass(frozen=True)
class Technique:
    """An effect with some of its knobs set."""

    name: str
    effect: str
    knobs: dict[str, Any] = field(default_factory=dict)

    def choice(self, **knobs: Any) -> Choice:
        """What draws it, with more knobs set; one sample a pixel."""
        return Choice(use=(self.effect, *LIT), without=("supersampling",), settings={self.effect: self.knobs | knobs})


MARCHED = "screen_space_reflections"
TECHNIQUES = (
    Technique("constant ambient light (default)", "constant_ambient"),
    Technique("planar mirrors", "planar_mirror"),
    Technique("planar mirrors, half their size", "planar_mirror", {"scale": 0.5}),
    Technique("static cube map", "static_cube_map"),
    Technique("static cube map, 16 directions", "static_cube_map", {"samples": 16}),
    Technique("local cube map", "local_cube_map"),
    Technique("local cube map, 16 directions", "local_cube_map", {"samples": 16}),
    Technique("dynamic cube map", "dynamic_cube_map"),
    Technique("screen space, else nothing", MARCHED, {"fallback": "none"}),
    Technique("screen space, else ambient light", MARCHED, {"fallback": "ambient"}),
    Technique("screen space, else local cube map", MARCHED),
    Technique("screen space, pyramid of depths", MARCHED, {"march": "hierarchical"}),
    Technique("screen space, 16 directions", MARCHED, {"samples": 16}),
)


@dataclass(frozen=True)
class Row:
    """What one technique gave on one scene: RMSE over all pixels and by shape, and the rays' fates."""

    technique: Technique
    error: float
    shapes: dict[str, float]
    rays: Sequence[RayError]
    time: float
    baking: float


def judge(device: Device, truth: Truth, technique: Technique, **knobs: Any) -> Row:
    """One technique against the truth, and the fastest of some frames' passes: what else a machine does only adds."""
    scene, choice = truth.scene, technique.choice(**knobs)
    renderer = Renderer(device, compile_plan(scene, effects(), choice), truth.size)
    at = FramePoints.of(renderer, truth)
    side = effect_sides(renderer, truth, silent, at, only=(technique.effect,))[technique.effect]
    comparison = Comparison(side.tested, side.truth)
    parts = by_object(comparison, at.captures[0].points.shape)
    shapes = {scene.shapes[i].name: part.metrics["rmse"].value for i, part in parts.items() if i >= 0}
    timed = Renderer(device, compile_plan(scene, effects(), choice), TIMED_SIZE)
    time = float(np.min(timed.record(FRAMES, 2).rounds(technique.effect)))
    baking = timed.baking.milliseconds.get(technique.effect, 0.0)
    return Row(technique, rmse(comparison).value, shapes, ray_errors(renderer, truth, at), time, baking)


def thousandths(value: float) -> str:
    """An error in 10⁻³ of a radiance's unit."""
    return show_number(1000 * value, 3)


def errors_table(scene: str, rows: Iterable[Row]) -> str:
    """RMSE, by shape too, and times."""
    shapes = SCENES[scene]
    lines = [
        f"| {scene} | all | {''.join(f'{shape} | ' for shape in shapes)}ms | once, ms |",
        "| --- |" + " ---: |" * (len(shapes) + 3),
    ]
    for row in rows:
        cells = [thousandths(row.error), *(thousandths(row.shapes[shape]) for shape in shapes)]
        baked = show_number(row.baking, 2) if row.baking else ""
        lines.append(f"| {row.technique.name} | {' | '.join(cells)} | {show_number(row.time, 2)} | {baked} |")
    return "\n".join(lines) + "\n"


def fates_table(scene: str, rows: Iterable[Row]) -> str:
    """Shares of the squared error and of the pixels by where rays end."""
    lines = [f"| {scene} | {' | '.join(fate.label for fate in FATES)} |", "| --- |" + " ---: |" * len(FATES)]
    for row in rows:
        for error in row.rays:
            parts = [error.parts[fate.verdict] for fate in FATES]
            pixels = sum(part.pixels for part in parts)
            cells = [f"{100 * p.share.value:.0f} % ({100 * p.pixels / pixels:.0f} % of pixels)" for p in parts]
            lines.append(f"| {row.technique.name} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def steps_table(device: Device, truth: Truth) -> str:
    """Error and time over the number of steps, for both ways to march."""
    lines = [f"| steps | {' | '.join(map(str, STEPS))} |", "| --- |" + " ---: |" * len(STEPS)]
    for march in ("linear", "hierarchical"):
        technique = Technique(march, MARCHED, {"march": march})
        rows = [judge(device, truth, technique, steps=steps) for steps in STEPS]
        lines.append(f"| {march}: RMSE | {' | '.join(thousandths(row.error) for row in rows)} |")
        mirror = [thousandths(row.shapes["floor mirror"]) for row in rows]
        lines.append(f"| {march}: floor mirror | {' | '.join(mirror)} |")
        lines.append(f"| {march}: ms | {' | '.join(show_number(row.time, 2) for row in rows)} |")
    return "\n".join(lines) + "\n"


def tables(device: Device, size: int, spp: int, console: Console) -> Iterable[str]:
    """Scene by scene errors, times and fates; the sweep over steps; the machine."""
    for scene in SCENES:
        truth = Truth(load(scene), (size, size), Budget(spp=spp), store=Store())
        rows = []
        for technique in TECHNIQUES:
            console.print(f"{scene}: {technique.name}", style="dim")
            if technique.effect in compile_plan(truth.scene, effects(), technique.choice()).effects:
                rows.append(judge(device, truth, technique))
        yield errors_table(scene, rows)
        yield fates_table(scene, rows)
        if scene == "mirrors":
            yield steps_table(device, truth)
    yield machine(device)


def main() -> None:
    """Measure, print, write."""
    options = parser(__doc__, size=128).parse_args()
    console, device = Console(stderr=True), Device()
    publish(tables(device, options.size, options.spp, console), options.output)


if __name__ == "__main__":
    main()
