"""Ambient visibility by technique: error against the term and against open directions, and milliseconds.

    python benchmarks/ambient_visibility.py [--size 128] [--spp 256] [--output TABLES.md] [--picture FILE]

Writes the tables of docs/ambient-occlusion.md and its picture.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from judged import machine, parser, publish
from PIL import Image
from rich.console import Console

from lightmeter.groundtruth.store import Store
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import measure_all
from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.significant import show_number
from lightmeter.scenes.load import load
from lightmeter.sides import FramePoints
from lightmeter.truth import Truth

SCENES = ("corner", "lattice", "atrium")
TIMED_SIZE, FRAMES = (512, 512), 3


@dataclass(frozen=True)
class Technique:
    """An effect with some of its knobs set; no effect: nothing is hidden."""

    name: str
    effect: str = ""
    knobs: dict[str, Any] = field(default_factory=dict)

    def choice(self) -> Choice:
        """What draws it."""
        return Choice(use=(self.effect,), settings={self.effect: self.knobs}) if self.effect else Choice()


TECHNIQUES = (
    Technique("none"),
    Technique("ssao", "ssao"),
    Technique("ssao, samples 16", "ssao", {"samples": 16}),
    Technique("ssao, blur bilateral", "ssao", {"blur": "bilateral"}),
    Technique("ssao, resolution half", "ssao", {"resolution": "half"}),
    Technique("ssao, power 2", "ssao", {"power": 2}),
    Technique("gtao", "gtao"),
    Technique("gtao, slices 1, steps 3", "gtao", {"slices": 1, "steps": 3}),
    Technique("gtao, slices 8, steps 16", "gtao", {"slices": 8, "steps": 16}),
    Technique("gtao, resolution half", "gtao", {"resolution": "half"}),
    Technique("gtao, thickness 0.2", "gtao", {"thickness": 0.2}),
    Technique("gtao, multi_bounce", "gtao", {"multi_bounce": True}),
    Technique("gtao, radius 8, steps 16", "gtao", {"radius": 8, "steps": 16}),
    Technique("baked_occlusion, own vertices", "baked_occlusion"),
    Technique("baked_occlusion, spacing 0.2", "baked_occlusion", {"spacing": 0.2}),
)
SWEEPS = {
    "ssao": ("radius", (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)),
    "gtao": ("radius", (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)),
    "baked_occlusion": ("spacing", (0.0, 0.8, 0.4, 0.2, 0.1)),
}
SPECULAR = ("none", "same", "lagarde", "cone")


class Judge:
    """A scene's truths, at the points that a frame of it sees."""

    def __init__(self, device: Device, scene: str, size: int, spp: int) -> None:
        self.device, self.size = device, (size, size)
        self.truth = Truth(load(scene), self.size, Budget(spp=spp), store=Store())
        plain = FramePoints.of(self._renderer(Technique("none")), self.truth)
        self.points, self.spp = plain.points, plain.spp
        terms = ("environment", "environment_visibility")
        batches = [self.truth.batch(self.points, n, "frame", self.spp, terms=terms) for n in range(self.truth.batches)]
        self.unoccluded = [batch.environment[0] for batch in batches]
        self.occluded = [batch.environment_shadowed[0] for batch in batches]
        self.open_within = cache(self._open_within)

    def _renderer(self, technique: Technique) -> Renderer:
        return Renderer(self.device, compile_plan(self.truth.scene, effects(), technique.choice()), self.size)

    def _open_within(self, radius: float) -> list[np.ndarray]:
        shares = [self.truth.ambient_occlusion(self.points, radius, n, self.spp) for n in range(self.truth.batches)]
        return [b * s[0, ..., None] for b, s in zip(self.unoccluded, shares, strict=True)]

    def ratio(self) -> np.ndarray:
        """(H, W, 3) the term, pooled over batches."""
        below = np.sum(self.unoccluded, axis=0)
        return np.where(below > 0, np.sum(self.occluded, axis=0) / np.maximum(below, 1e-9), 1)

    def seen(self, technique: Technique) -> tuple[np.ndarray, float]:
        """(H, W, 3) of a technique, and what baking took, milliseconds."""
        if not technique.effect:
            return np.ones((*self.size[::-1], 3)), 0.0
        renderer = self._renderer(technique)
        found = renderer.capture().frame["environment_visibility"]
        return found, renderer.baking.milliseconds.get(technique.effect, 0.0)

    def errors(self, visibility: np.ndarray, radius: float) -> list[float]:
        """RMSE and relative bias against the term; RMSE against open directions within a radius, and any."""
        tested = [b * visibility for b in self.unoccluded]
        term = measure_all(("rmse", "relative_bias"), Comparison(tested, self.occluded))
        found = [term["rmse"].value, term["relative_bias"].value]
        for reach in (radius, math.inf):
            found.append(measure_all(("rmse",), Comparison(tested, self.open_within(reach)))["rmse"].value)
        return found


def fastest(device: Device, technique: Technique, scene: str) -> float:
    """Milliseconds of the effect's passes at 512²: the fastest of some frames."""
    renderer = Renderer(device, compile_plan(load(scene), effects(), technique.choice()), TIMED_SIZE)
    return float(renderer.record(FRAMES, 1).rounds(technique.effect).min())


def cell(value: float) -> str:
    """In thousandths."""
    return show_number(1000 * value, 3)


def techniques_table(judges: dict[str, Judge], device: Device, console: Console) -> Iterable[str]:
    """A table for each scene."""
    for scene, judge in judges.items():
        lines = [
            "| technique | RMSE | bias | against open within its radius | against open | ms | baking, s |",
            "| --- | ---: | ---: | ---: | ---: | ---: | ---: |",
        ]
        for technique in TECHNIQUES:
            console.print(f"{scene}: {technique.name}", style="dim")
            seen, baking = judge.seen(technique)
            knobs = {k.name: k.default for k in effects()[technique.effect].knobs} if technique.effect else {}
            radius = (knobs | technique.knobs).get("radius")
            rmse, bias, near, everywhere = judge.errors(seen, radius or math.inf)
            time = show_number(fastest(device, technique, scene), 2) if technique.effect else ""
            lines.append(
                f"| {technique.name} | {cell(rmse)} | {100 * bias:+.1f} % | {cell(near) if radius else ''} "
                f"| {cell(everywhere)} | {time} | {show_number(baking / 1000, 2) if baking else ''} |"
            )
        yield f"`{scene}`\n\n" + "\n".join(lines) + "\n"


def sweeps_table(judges: dict[str, Judge], console: Console) -> Iterable[str]:
    """RMSE over one knob."""
    for effect, (knob, values) in SWEEPS.items():
        scenes = judges if effect != "baked_occlusion" else ("corner",)
        lines = [f"| `{effect}.{knob}` | {' | '.join(f'{v:g}' for v in values)} |", "| --- |" + " ---: |" * len(values)]
        for scene in scenes:
            judge = judges[scene]
            console.print(f"{effect} over {knob} on {scene}", style="dim")
            seen = [judge.seen(Technique("", effect, {knob: value}))[0] for value in values]
            lines.append(f"| {scene} | {' | '.join(cell(judge.errors(v, math.inf)[0]) for v in seen)} |")
        yield "\n".join(lines) + "\n"


def specular_table(judges: dict[str, Judge]) -> str:
    """RMSE over the specular occlusion, with what errs least on the screen and off it."""
    lines = [f"| technique | scene | {' | '.join(SPECULAR)} |", "| --- | --- |" + " ---: |" * len(SPECULAR)]
    for effect, knobs in (("gtao", {"radius": 8, "steps": 16}), ("baked_occlusion", {"spacing": 0.2})):
        for scene in ("corner", "lattice"):  # where something is of metal
            judge = judges[scene]
            seen = [judge.seen(Technique("", effect, knobs | {"specular_occlusion": s}))[0] for s in SPECULAR]
            lines.append(f"| {effect} | {scene} | {' | '.join(cell(judge.errors(v, math.inf)[0]) for v in seen)} |")
    return "\n".join(lines) + "\n"


def picture(judges: dict[str, Judge]) -> Image.Image:
    """A row for each scene: the term, SSAO, GTAO, baked; below each what is too bright (red) or too dark (blue)."""
    shown = [TECHNIQUES[1], TECHNIQUES[6], TECHNIQUES[-1]]
    rows = []
    for judge in judges.values():
        truth = judge.ratio()
        seen = [truth, *(judge.seen(technique)[0] for technique in shown)]
        off = [np.mean(v - truth, axis=2) for v in seen]
        signed = [
            np.stack([1 - np.maximum(-o, 0) * 1.5, 1 - np.abs(o) * 1.5, 1 - np.maximum(o, 0) * 1.5], 2) for o in off
        ]
        rows += [np.concatenate(seen, axis=1), np.concatenate(signed, axis=1)]
    return Image.fromarray((np.clip(np.concatenate(rows), 0, 1) * 255).astype(np.uint8))


def main() -> None:
    """Measure, print, write."""
    asked = parser(__doc__, size=128)
    asked.add_argument("--picture", type=Path, metavar="FILE", help="write the picture here")
    options = asked.parse_args()
    console, device = Console(stderr=True), Device()
    judges = {scene: Judge(device, scene, options.size, options.spp) for scene in SCENES}
    if options.picture:
        picture(judges).save(options.picture, quality=88)
    publish(tables(judges, device, console), options.output)


def tables(judges: dict[str, Judge], device: Device, console: Console) -> Iterable[str]:
    """Techniques, specular occlusion, sweeps, the machine."""
    yield from techniques_table(judges, device, console)
    yield specular_table(judges)
    yield from sweeps_table(judges, console)
    yield machine(device)


if __name__ == "__main__":
    main()
