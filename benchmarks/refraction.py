"""Techniques for dielectric solids beside the truth: error of `transmission`, how much light they show, milliseconds.

    python benchmarks/refraction.py [--size 128] [--spp 1024] [--output TABLE.md] [--picture FILE]

Writes the table and the picture of docs/transmission.md.
"""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from judged import parser, publish
from PIL import Image

from lightmeter.groundtruth.store import Store
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.mse import rmse
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene
from lightmeter.sides import FramePoints, effect_sides
from lightmeter.truth import Truth

TECHNIQUES: tuple[tuple[str, dict[str, Any]], ...] = (
    ("refraction_one_interface", {}),
    ("refraction_two_interfaces", {}),
    *(("refraction_bounces", {"bounces": bounces}) for bounces in (1, 2, 4, 8, 16)),
    ("refraction_bounces", {"bounces": 4, "around": "environment"}),
    ("refraction_bounces", {"bounces": 8, "size": 64}),
    ("refraction_bounces", {"bounces": 8, "size": 1024}),
    ("refraction_bounces", {"bounces": 8, "iterations": 2}),
)
PICTURED = (0, 1, 2, 5)
"""Of the techniques, those whose pictures are shown."""


def alone(scene: Scene) -> Scene:
    """The solids of a scene, and what surrounds it."""
    solids = tuple(shape for shape in scene.shapes if shape.material.is_glass)
    return replace(scene, name=f"{scene.name}, alone", shapes=solids)


def rows_of(scene: Scene, size: int, spp: int, pictures: list[np.ndarray]) -> list[str]:
    """A row for each technique; the pictures of some go to `pictures`, the truth's last."""
    truth = Truth(scene, (size, size), Budget(spp), 0, store=Store())
    device, rows, shown = Device(), [], []
    for name, knobs in TECHNIQUES:
        choice = Choice(use=(name,), without=("supersampling",), settings={name: knobs})
        renderer = Renderer(device, compile_plan(scene, effects(), choice), (size, size))
        side = effect_sides(renderer, truth, silent, FramePoints.of(renderer, truth), only=(name,))[name]
        error = rmse(Comparison(np.stack(side.tested), np.stack(side.truth)))
        exact = np.mean(side.truth, axis=0, dtype=np.float64)
        light = np.mean(side.tested, dtype=np.float64) / exact.mean()
        took = renderer.measure(frames=7).of(name)
        half = (error.high - error.low) / 2 if error.high is not None and error.low is not None else 0.0
        settings = ", ".join(f"{knob} {value}" for knob, value in knobs.items())
        label = f"`{name}`" + (f", {settings}" if settings else "")
        rows.append(f"| {scene.name} | {label} | {error.value:.3f} ± {half:.3f} | {light:.0%} | {took.median:.1f} |")
        shown.append(renderer.render().radiance)
        display = display_transform(renderer.plan)
        ior = renderer.capture(terms=False).points.ior
        assert ior is not None
        truly = np.where(ior[..., None] > 0, exact, shown[-1])
    for image in (*(shown[place] for place in PICTURED), truly):
        pictures.append(np.rint(255 * display(np.asarray(image, np.float32))).astype(np.uint8))
    return rows


def main() -> None:
    options = parser(__doc__ or "", 128)
    options.add_argument("--picture", type=Path, metavar="FILE", help="write the picture here")
    args = options.parse_args()
    lines = ["| scene | technique | RMSE, W/(sr·m²) | light shown | ms |", "| --- | --- | --- | --- | --- |"]
    pictures: list[list[np.ndarray]] = []
    for scene in (load("gem"), alone(load("glass-ball")), load("glass-ball")):
        pictures.append([])
        lines += rows_of(scene, args.size, args.spp, pictures[-1])
    publish(["\n".join(lines)], args.output)
    if args.picture:
        sheet = np.concatenate([np.concatenate(row, axis=1) for row in pictures], axis=0)
        Image.fromarray(sheet).save(args.picture, quality=92)


if __name__ == "__main__":
    main()
