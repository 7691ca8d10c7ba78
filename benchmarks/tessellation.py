"""Flat, Gouraud and interpolated-normal shading over the tessellation: how wrong are normals, and light?

    python benchmarks/tessellation.py [--size 256] [--output TABLES.md]

Writes the tables of docs/surfaces.md, on the library's scene `tessellation` under its point light alone: direct light
and its shadows are closed forms, and nothing here has noise.
"""

import argparse
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from rich.console import Console

from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene
from lightmeter.sides import FramePoints
from lightmeter.truth import Truth

TECHNIQUES = {"flat_shading": "flat", "gouraud": "Gouraud", "interpolated_normals": "interpolated"}
STEPS = (8, 16, 32, 64, 128)
SHAPES = ("sphere", "torus", "cylinder")
SAMPLES = 2
"""Samples along each side of a pixel, so that an outline's error is of its area and not of a few pixels."""
FACING = 0.5
"""n·v from which a surface counts as seen from the front."""


def lit_scene() -> Scene:
    """The scene under its point light alone."""
    return replace(load("tessellation"), environment=None, max_depth=2)


def points_of(effect: str, steps: int, device: Device, scene: Scene, size: tuple[int, int]) -> FramePoints:
    """The frame's samples with one technique at one tessellation."""
    settings = {effect: {"tessellation": steps}, "supersampling": {"grid": SAMPLES}}
    plan = compile_plan(scene, effects(), Choice(use=(effect,), settings=settings))
    return FramePoints.of(Renderer(device, plan, size), Truth(plan.true_scene, size, Budget(8)))


def normal_error(at: FramePoints, effect: str, shape: int) -> float:
    """The root mean square angle between the normals drawn and the true ones, in degrees, where seen from the front."""
    drawn, true = at.points, at.seen((effect,)).points
    facing = np.sum(true.normal * true.view, axis=-1) > FACING
    both = (drawn.shape == shape) & (true.shape == shape) & facing
    one, other = drawn.normal[both].astype(np.float64), true.normal[both].astype(np.float64)
    angle = np.arctan2(np.linalg.norm(np.cross(one, other), axis=-1), np.sum(one * other, axis=-1))
    return float(np.degrees(np.sqrt(np.mean(angle**2))))


def light_error(at: FramePoints, effect: str, shape: int) -> float:
    """RMSE over the pixels that show the shape, truly or as drawn, by the mean of what is truly there; in percent."""
    tested = at.without(effect, 0, 1)
    true = at.batch((effect,), 0, 1).composition()
    there = ((at.points.shape == shape) | (at.seen((effect,)).points.shape == shape)).any(axis=0)
    off = (tested - true)[there].astype(np.float64)
    return float(100 * np.sqrt(np.mean(off**2)) / true[there].mean(dtype=np.float64))


def measured(size: int) -> Iterator[tuple[str, int, dict[str, tuple[float, float]]]]:
    """(effect, steps, shape to errors of normals and of light)."""
    scene, device = lit_scene(), Device()
    numbers = {shape.name: i for i, shape in enumerate(scene.shapes)}
    for steps in STEPS:
        for effect in TECHNIQUES:
            at = points_of(effect, steps, device, scene, (size, size))
            yield (
                effect,
                steps,
                {n: (normal_error(at, effect, numbers[n]), light_error(at, effect, numbers[n])) for n in SHAPES},
            )


def table(found: dict[tuple[str, int], dict[str, tuple[float, float]]], which: int, techniques: list[str]) -> str:
    """Markdown: a row for each tessellation, a column for each technique and shape."""
    columns = [(technique, shape) for technique in techniques for shape in SHAPES]
    lines = [f"| steps | {' | '.join(f'{TECHNIQUES[t]}, {s}' for t, s in columns)} |"]
    lines.append(f"| ---: | {' | '.join('---:' for _ in columns)} |")
    for steps in STEPS:
        cells = [f"{float(f'{found[technique, steps][shape][which]:.2g}'):g}" for technique, shape in columns]
        lines.append(f"| {steps} | {' | '.join(cells)} |")
    return "\n".join(lines)


def main() -> None:
    """Measure and print, or write, the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=256, help="side of the image in pixels")
    parser.add_argument("--output", type=Path, help="where the tables go; the terminal unless given")
    args = parser.parse_args()
    found, console = {}, Console(stderr=True)
    for effect, steps, errors in measured(args.size):
        found[effect, steps] = errors
        console.print(f"{effect} {steps}: {errors}")
    # Gouraud's shading normal is never looked at between the vertices.
    normals = table(found, 0, ["flat_shading", "interpolated_normals"])
    text = f"Normals, degrees:\n\n{normals}\n\nLight, % of the mean:\n\n{table(found, 1, list(TECHNIQUES))}\n"
    if args.output:
        args.output.write_text(text, encoding="utf-8")
    else:
        print(text)


if __name__ == "__main__":
    main()
