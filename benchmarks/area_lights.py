"""Area-light effects against the truth, and what they cost: the tables of docs/lights.md.

    python benchmarks/area_lights.py [--only fit,angles,scenes] [--size 256] [--spp 512] [--picture FILE]

`fit`: how far the table's cosines are from the lobes. `angles`: each effect against Monte Carlo over roughness × angle,
on a white metal under a rectangle. `scenes`: each effect's error and milliseconds on two scenes of the library. The
picture: light from the area lights of `area-lights`, unshadowed, by some effects and by the truth.
"""

import argparse
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from judged import machine
from PIL import Image

from lightmeter.groundtruth.oracles import direct
from lightmeter.groundtruth.world import World
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.effects.ltc_area_light import fit
from lightmeter.realtime.effects.ltc_area_light.table import fitted
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Capture, Renderer
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Camera, Material, Scene, Shape

ROUGHNESSES = (0.1, 0.2, 0.35, 0.5, 0.7, 1.0)
ANGLES = (20, 45, 60, 75, 85)
"""Degrees between view and normal."""

VARIANTS = (
    ("area_as_point", {}),
    ("area_as_point", {"profile": "cosine"}),
    ("representative_point", {}),
    ("representative_point", {"normalization": "mirror"}),
    ("ltc_area_light", {}),
    ("ltc_area_light", {"rim": 8}),
    ("many_sample_light", {"samples": 4}),
    ("many_sample_light", {}),
    ("many_sample_light", {"samples": 64}),
    ("many_sample_light", {"samples": 256}),
)
COMPARED = (VARIANTS[1], VARIANTS[2], VARIANTS[3], VARIANTS[4], VARIANTS[7])
SCENES = ("area-lights", "cornell-box")
FRAMES = 10


def variation(roughness: float, degrees: float) -> float:
    """The total variation between lobe and cosine, as the shader interpolates the table."""
    table, side = fitted(), len(fitted()) - 1
    lobe = fit.Lobe.of(max(roughness**2, 1e-3), math.cos(math.radians(degrees)), 128)
    row, column = roughness * side, math.sqrt(1 - lobe.view[2]) * side
    r, c = min(int(row), side - 1), min(int(column), side - 1)
    low, high = (table[i, c] + (column - c) * (table[i, c + 1] - table[i, c]) for i in (r, r + 1))
    return fit.variation(lobe, fit.Cosine.of(lobe, low + (row - r) * (high - low)), 128)


def under_a_rectangle(roughness: float, degrees: float) -> Scene:
    """A white metal floor, seen in parallel at an angle, under a rectangle of 1 × 0.6 m at half a metre or more.

    It leans over from where the floor's middle mirrors the view to, and so is in the highlight at every angle.
    """
    angle = math.radians(degrees)
    floor = Shape("floor", shapes.plane(6, 6), Material("metal", (1, 1, 1), metallic=1.0, roughness=roughness))
    view = look_at((0, 10 * math.cos(angle), 10 * math.sin(angle)), (0, 0, 0), (0, math.sin(angle) + 0.1, -1))
    mirror = min(angle, math.radians(70))
    place = np.array((0.0, math.cos(mirror), -math.sin(mirror)))
    matrix = np.array(look_at(place, (0, 0, 0), (1, 0.1, 0)))
    matrix[:3, [0, 2]] *= -1  # its front, +Z, turns to the floor's middle
    glow = Material("glow", (0, 0, 0), specular=0.0, emissive=(1.0, 1.0, 1.0))
    camera = Camera("parallel", view, ymag=0.5 * math.cos(angle), near=0.1, far=30.0)
    return Scene("rectangle", (floor, Shape("light", shapes.rectangle(1.0, 0.6), glow, matrix)), camera)


def captured(device: Device, scene: Scene, size: tuple[int, int], effect: str, knobs: dict):
    """A renderer with one effect for the area lights, and what it captures."""
    choice = Choice(use=(effect,), only=(effect,), settings={effect: knobs})
    renderer = Renderer(device, compile_plan(scene, effects(), choice), size)
    return renderer, renderer.capture()


def halves(scene: Scene, seen: Capture, spp: int) -> list[np.ndarray]:
    """Two independent truths of all area lights together: products of what is off each hold no noise in the mean."""
    world = World.of(scene)
    return [
        sum(direct.evaluate(world, seen.points, light, spp=spp // 2, batch=batch) for light in seen.direct)
        for batch in (0, 1)
    ]


def root(square: float) -> float:
    """The root; an estimate below 0 is noise."""
    return math.sqrt(max(0.0, float(square)))


def angles_table(device: Device, spp: int) -> Iterator[str]:
    """Rows of |error|/|truth| in the root mean square over the floor, per cent."""
    yield "| effect | roughness | " + " | ".join(f"{d}°" for d in ANGLES) + " |"
    yield "| --- | ---: |" + " ---: |" * len(ANGLES)
    errors: dict[tuple[int, float, int], float] = {}
    for roughness in ROUGHNESSES:
        for degrees in ANGLES:
            scene, truth = under_a_rectangle(roughness, degrees), None
            for number, (effect, knobs) in enumerate(COMPARED):
                _, seen = captured(device, scene, (32, 32), effect, knobs)
                floor = seen.points.shape == 0
                truth = halves(scene, seen, spp) if truth is None else truth
                (a, b), got = (half[floor] for half in truth), seen.direct[0][floor]
                errors[number, roughness, degrees] = root(np.mean((got - a) * (got - b)) / np.mean(a * b))
    for number, (effect, knobs) in enumerate(COMPARED):
        for roughness in ROUGHNESSES:
            row = " | ".join(f"{100 * errors[number, roughness, d]:.1f}" for d in ANGLES)
            yield f"| {title(effect, knobs)} | {roughness:g} | {row} |"


def scenes_table(device: Device, size: int, spp: int) -> Iterator[str]:
    """Rows of nrmse, bias and milliseconds; the error without shadows, all area lights together."""
    yield "| effect | " + " | ".join(f"{name}: nrmse | bias | ms" for name in SCENES) + " |"
    yield "| --- |" + " ---: | ---: | ---: |" * len(SCENES)
    truths: dict[str, list[np.ndarray]] = {}
    for effect, knobs in VARIANTS:
        cells = []
        for name in SCENES:
            renderer, seen = captured(device, load(name), (size, size), effect, knobs)
            if name not in truths:
                truths[name] = halves(renderer.plan.scene, seen, spp)
            got, (a, b) = sum(seen.direct.values()), truths[name]
            mean = (a.mean() + b.mean()) / 2
            error = root(np.mean((got - a) * (got - b))) / mean
            time = renderer.measure(FRAMES).of(effect)
            cells.append(f"{error:.3f} | {100 * (got.mean() / mean - 1):+.1f} % | {time.median:.1f}")
        yield f"| {title(effect, knobs)} | " + " | ".join(cells) + " |"


def fit_table() -> Iterator[str]:
    """Rows of the total variation, per cent."""
    yield "| roughness | " + " | ".join(f"{d}°" for d in ANGLES) + " |"
    yield "| ---: |" + " ---: |" * len(ANGLES)
    for roughness in ROUGHNESSES:
        yield f"| {roughness:g} | " + " | ".join(f"{100 * variation(roughness, d):.1f}" for d in ANGLES) + " |"


def draw(device: Device, spp: int, path: Path) -> None:
    """Write two rows of pictures: as a point, representative point as published and for mirrors; LTC, points, truth."""
    shown, size = [], (300, 200)
    for effect, knobs in COMPARED:
        renderer, seen = captured(device, load("area-lights"), size, effect, knobs)
        shown.append(sum(seen.direct.values()) + seen.points.emission)
    scene = renderer.plan.scene
    shown.append(sum(halves(scene, seen, spp)) / 2 + seen.points.emission)
    display = display_transform(compile_plan(scene, effects()))
    pictures = [np.round(255 * display(image.astype(np.float64))).astype(np.uint8) for image in shown]
    rows = [np.concatenate(pictures[i : i + 3], axis=1) for i in (0, 3)]
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.concatenate(rows)).save(path)


def title(effect: str, knobs: dict) -> str:
    """The effect with the knobs that are set."""
    return f"`{effect}`" + "".join(f", {name} {value}" for name, value in knobs.items())


def main() -> None:
    """Print the tables that were asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="fit,angles,scenes", help="tables, by comma")
    parser.add_argument("--size", type=int, default=256, help="side of the picture in pixels (%(default)s)")
    parser.add_argument("--spp", type=int, default=512, help="samples of the truth (%(default)s)")
    parser.add_argument("--picture", type=Path, help="where to write the picture")
    options = parser.parse_args()
    device = Device()
    if options.picture:
        draw(device, options.spp, options.picture)
    tables = {
        "fit": fit_table,
        "angles": lambda: angles_table(device, options.spp),
        "scenes": lambda: scenes_table(device, options.size, options.spp),
    }
    for name in filter(None, options.only.split(",")):
        print(f"\n{name}\n")
        for line in tables[name]():
            print(line, flush=True)
    print("\n" + machine(device))


if __name__ == "__main__":
    main()
