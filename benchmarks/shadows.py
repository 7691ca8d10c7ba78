"""The shadow techniques side by side: error against the truth, what kind of mistake it is, and milliseconds.

    python benchmarks/shadows.py [--size 256] [--spp 256] [--output TABLES.md]

Writes the tables of docs/shadows.md. `run.py --only shadows` takes the times alone.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from figures import Figure
from judged import machine, parser, publish
from rich.console import Console

from lightmeter.groundtruth.store import Store
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.mse import rmse
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.results import LightShadow
from lightmeter.reports.shadow_content import KINDS, MISTAKES
from lightmeter.reports.significant import show_number
from lightmeter.scenes.load import load
from lightmeter.shadow_errors import shadow_errors
from lightmeter.sides import FramePoints, effect_sides
from lightmeter.truth import Truth

TIMED_SIZE = (512, 512)
FRAMES = 11
SCENES = ("posts", "layers", "avenue", "penumbra", "cornell-box")
RESOLUTIONS = (256, 512, 1024, 2048)


@dataclass(frozen=True)
class Technique:
    """An effect with some of its knobs set.

    Attributes:
        scenes: where it takes part.
        timed: the scene that its time is taken on.
        most: the finest map that is tried, texels.
    """

    name: str
    effect: str
    knobs: dict[str, Any] = field(default_factory=dict)
    scenes: tuple[str, ...] = SCENES
    timed: str = "posts"
    most: int = 2048

    def choice(self, **knobs: Any) -> Choice:
        """What draws it, with more knobs set."""
        return Choice(use=(self.effect,), settings={self.effect: self.knobs | knobs})


TECHNIQUES = (
    Technique("hard", "shadow_map", {"filter": "hard"}),
    Technique("PCF 3 × 3 (default)", "shadow_map"),
    Technique("PCF 9 × 9", "shadow_map", {"filter": "pcf9"}),
    Technique("Poisson disk, 16 in 2 texels", "shadow_map", {"filter": "poisson"}),
    Technique(
        "hard, faces=back, no bias", "shadow_map", {"filter": "hard", "faces": "back", "bias": 0, "slope_bias": 0}
    ),
    Technique(
        "hard, normal offset, no slope bias", "shadow_map", {"filter": "hard", "normal_offset": 1, "slope_bias": 0}
    ),
    Technique("variance, blur 1", "variance_shadow_map", {"resolution": 1024}, most=1024),
    Technique("variance, blur 1, bleeding 0", "variance_shadow_map", {"resolution": 1024, "bleeding": 0}, most=1024),
    Technique("exponential, blur 1", "exponential_shadow_map", {"resolution": 1024}, most=1024),
    Technique("moments, blur 1", "moment_shadow_map", {"resolution": 1024}, most=1024),
    Technique("4 cascades, PCF 3 × 3", "cascaded_shadow_map", scenes=("posts", "layers", "avenue"), timed="avenue"),
    Technique("PCSS", "pcss", {"resolution": 1024}, scenes=("penumbra", "cornell-box"), timed="penumbra"),
    Technique(
        "PCSS, blockers=between, 128 + 64 samples",
        "pcss",
        {"resolution": 1024, "blockers": "between", "samples": 128, "search_samples": 64},
        scenes=("penumbra", "cornell-box"),
        timed="penumbra",
    ),
)


def fastest(device: Device, scene: str, technique: Technique, **knobs: Any) -> float:
    """Milliseconds of the effect's passes at 512², map and comparison: the fastest of some frames.

    What else a machine does can only add to that.
    """
    renderer = Renderer(device, compile_plan(load(scene), effects(), technique.choice(**knobs)), TIMED_SIZE)
    return float(renderer.record(FRAMES, 2).rounds(technique.effect).min())


def measure(device: Device) -> list[Figure]:
    """Every technique's time as it comes, and over resolutions."""
    figures = [Figure(f"{t.name} · {t.timed}", fastest(device, t.timed, t), "ms") for t in TECHNIQUES]
    for technique in TECHNIQUES:
        for resolution in (r for r in RESOLUTIONS if r <= technique.most):
            time = fastest(device, technique.timed, technique, resolution=resolution)
            figures.append(Figure(f"{technique.name} · {technique.timed} · {resolution}", time, "ms"))
    return figures


@dataclass(frozen=True)
class Row:
    """What one technique gave on one scene."""

    technique: Technique
    scene: str
    error: float
    shadows: Sequence[LightShadow]


def judge(device: Device, scene: str, size: int, spp: int) -> Iterable[Row]:
    """Every technique that takes part in a scene, against the same truth at the same points."""
    truth = Truth(load(scene), (size, size), Budget(spp=spp), store=Store())
    for technique in (t for t in TECHNIQUES if scene in t.scenes):
        renderer = Renderer(device, compile_plan(truth.scene, effects(), technique.choice()), (size, size))
        at = FramePoints.of(renderer, truth)
        # All lights that it is drawn for; where it takes only some, the others' shadows are another effect's.
        side = effect_sides(renderer, truth, silent, at, only=(technique.effect,))[technique.effect]
        shadows = [shadow for shadow in shadow_errors(renderer, truth, at) if shadow.effect == technique.effect]
        yield Row(technique, scene, rmse(Comparison(side.tested, side.truth)).value, shadows)


def errors_table(rows: Sequence[Row], times: dict[str, float]) -> str:
    """RMSE over scenes and the time."""
    found = {(row.technique.name, row.scene): row for row in rows}
    lines = [f"| technique | {' | '.join(SCENES)} | ms |", "| --- |" + " ---: |" * (len(SCENES) + 1)]
    for technique in TECHNIQUES:
        cells = [found.get((technique.name, scene)) for scene in SCENES]
        shown = [show_number(1000 * row.error, 3) if row else "" for row in cells]
        lines.append(f"| {technique.name} | {' | '.join(shown)} | {show_number(times[technique.name], 2)} |")
    return "\n".join(lines) + "\n"


def mistakes_table(rows: Iterable[Row]) -> str:
    """The shares of the squared error, over all lights of a scene."""
    heads = [f"{KINDS[m.kind].removeprefix('too ')} {m.where}" for m in MISTAKES]
    lines = [f"| scene | technique | {' | '.join(heads)} |", "| --- | --- |" + " ---: |" * len(heads)]
    for row in rows:
        weights = np.array([shadow.rmse.value**2 for shadow in row.shadows])
        shares = [
            np.nansum([w * s.parts[m.kind][m.place].share.value for w, s in zip(weights, row.shadows, strict=True)])
            / max(weights.sum(), 1e-300)
            for m in MISTAKES
        ]
        cells = ["" if abs(share) < 0.005 else f"{100 * share:.0f} %" for share in shares]
        lines.append(f"| {row.scene} | {row.technique.name} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def resolutions_table(device: Device, console: Console) -> str:
    """Milliseconds over resolutions."""
    lines = [
        f"| technique | scene | {' | '.join(map(str, RESOLUTIONS))} |",
        "| --- | --- |" + " ---: |" * len(RESOLUTIONS),
    ]
    for technique in TECHNIQUES:
        console.print(f"times of {technique.name}", style="dim")
        times = [
            show_number(fastest(device, technique.timed, technique, resolution=r), 2) if r <= technique.most else ""
            for r in RESOLUTIONS
        ]
        lines.append(f"| {technique.name} | {technique.timed} | {' | '.join(times)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measure, print, write."""
    options = parser(__doc__, size=256).parse_args()
    console, device = Console(stderr=True), Device()
    publish(tables(device, options.size, options.spp, console), options.output)


def tables(device: Device, size: int, spp: int, console: Console) -> Iterable[str]:
    """Errors and times, mistakes, times over resolutions, the machine."""
    rows = []
    for scene in SCENES:
        console.print(f"errors on {scene}", style="dim")
        rows += judge(device, scene, size, spp)
    yield mistakes_table(rows)
    console.print("times", style="dim")
    yield errors_table(rows, {technique.name: fastest(device, technique.timed, technique) for technique in TECHNIQUES})
    yield resolutions_table(device, console)
    yield machine(device)


if __name__ == "__main__":
    main()
