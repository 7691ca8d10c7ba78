"""Techniques for environment maps against the truth, and what they cost: the tables of docs/environments.md.

    python benchmarks/environments.py [--only scenes,roughness,sun,sweep] [--map FILE] [--size 128] [--spp 512]
        [--picture FILE]

`scenes`: each technique's error, milliseconds and baking time on two scenes under the built-in maps and one from a
file.
`roughness`: the error on spheres of one metal, by roughness. `sun`: the split sum with and without filtering, by
samples. `sweep`: error against baking time over the split sum's size and samples, with the front. The picture: the grid
by some techniques and by the truth.
"""

import argparse
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from judged import machine
from PIL import Image

from lightmeter.groundtruth.oracles import environment
from lightmeter.groundtruth.world import World
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.pareto import pareto_front
from lightmeter.scenes.environments import BUILT_IN, built_in, environment_from
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Environment, Scene

VARIANTS = (
    ("constant_ambient", {}),
    ("hemisphere_ambient", {}),
    ("spherical_harmonics", {"order": 2}),
    ("spherical_harmonics", {}),
    ("spherical_harmonics", {"window": "hann"}),
    ("irradiance_cube", {}),
    ("mirror_lookup", {}),
    ("split_sum", {}),
    ("split_sum", {"diffuse": "cube"}),
    ("split_sum", {"samples": 256}),
    ("split_sum", {"filtered": False}),
    ("split_sum", {"compensation": "fdez_aguera"}),
)
COMPARED = (VARIANTS[0], VARIANTS[3], VARIANTS[6], VARIANTS[7], VARIANTS[10])
SCENES = ("torus", "metal-rough-grid")
FRAMES = 10
SIZES, SAMPLES = (16, 32, 64, 128), (4, 16, 64, 256)


@dataclass(frozen=True, eq=False)
class Case:
    """A scene under a map, with two independent truths: products of what is off each hold no noise in the mean."""

    scene: Scene
    seen: np.ndarray
    truth: tuple[np.ndarray, np.ndarray]
    shape: np.ndarray

    @classmethod
    def of(cls, device: Device, name: str, around: Environment, size: int, spp: int) -> "Case":
        """The case at size × size pixels."""
        scene = replace(load(name), environment=around)
        points = captured(device, scene, size, "constant_ambient", {})[1].points
        world = World.of(scene)
        a, b = (environment.evaluate(world, points, spp=spp // 2, batch=batch).astype(np.float64) for batch in (0, 1))
        return cls(scene, points.hit, (a, b), points.shape)

    def errors(self, got: np.ndarray, where: np.ndarray | None = None) -> tuple[float, float]:
        """RMSE over the mean, and the mean's own error, where a surface is seen."""
        where = self.seen if where is None else where
        (a, b), got = (half[where] for half in self.truth), got[where].astype(np.float64)
        mean = (a.mean() + b.mean()) / 2
        return math.sqrt(max(0.0, float(np.mean((got - a) * (got - b))))) / mean, got.mean() / mean - 1


def captured(device: Device, scene: Scene, size: int, effect: str, knobs: dict):
    """A renderer with one effect for the environment, and what it captures."""
    choice = Choice(use=(effect,), only=(effect,), settings={effect: knobs})
    renderer = Renderer(device, compile_plan(scene, effects(), choice), (size, size))
    return renderer, renderer.capture()


def scenes_table(device: Device, maps: dict[str, Environment], size: int, spp: int) -> Iterator[str]:
    """Rows of nrmse and bias by scene and map, milliseconds a frame and of baking under the last map."""
    places = [(name, around) for name in SCENES for around in maps]
    yield "| technique | " + " | ".join(f"{name}, {around}" for name, around in places) + " | ms | baking, ms |"
    yield "| --- |" + " ---: |" * (len(places) + 2)
    cases = {(name, around): Case.of(device, name, maps[around], size, spp) for name, around in places}
    for effect, knobs in VARIANTS:
        cells = []
        for place in places:
            renderer, seen = captured(device, cases[place].scene, size, effect, knobs)
            error, bias = cases[place].errors(seen.frame["environment"])
            cells.append(f"{error:.3f} ({100 * bias:+.1f} %)")
        time = renderer.measure(FRAMES).of(effect).median
        baked = renderer.baking.milliseconds.get(effect)
        cells += [f"{time:.1f}", "–" if baked is None else f"{baked:.0f}"]
        yield f"| {title(effect, knobs)} | " + " | ".join(cells) + " |"


def roughness_table(device: Device, maps: dict[str, Environment], size: int, spp: int) -> Iterator[str]:
    """Rows of nrmse over the spheres of pure metal in metal-rough-grid, by map and technique."""
    roughnesses = np.linspace(0.2, 1, 6)
    yield "| map | technique | " + " | ".join(f"{r:.2f}" for r in roughnesses) + " |"
    yield "| --- | --- |" + " ---: |" * len(roughnesses)
    for around, found in maps.items():
        case = Case.of(device, "metal-rough-grid", found, size, spp)
        for effect, knobs in COMPARED:
            got = captured(device, case.scene, size, effect, knobs)[1].frame["environment"]
            cells = [f"{case.errors(got, case.shape == 30 + column)[0]:.3f}" for column in range(6)]
            yield f"| {around} | {title(effect, knobs)} | " + " | ".join(cells) + " |"


def sun_table(device: Device, around: Environment, size: int, spp: int) -> Iterator[str]:
    """Rows of nrmse, bias and the brightest pixel over the truth's, by samples, without and with filtering."""
    case = Case.of(device, "metal-rough-grid", around, size, spp)
    brightest = max(half[case.seen].max() for half in case.truth)
    yield "| samples | points: nrmse | bias | brightest | solid angles: nrmse | bias | brightest |"
    yield "| ---: |" + " ---: |" * 6
    for samples in SAMPLES:
        cells = []
        for filtered in (False, True):
            knobs = {"samples": samples, "filtered": filtered}
            got = captured(device, case.scene, size, "split_sum", knobs)[1].frame["environment"]
            error, bias = case.errors(got)
            cells += [f"{error:.3f}", f"{100 * bias:+.1f} %", f"{got[case.seen].max() / brightest:.2f}"]
        yield f"| {samples} | " + " | ".join(cells) + " |"


def sweep_table(device: Device, around: Environment, size: int, spp: int) -> Iterator[str]:
    """Rows of size and samples: nrmse and the milliseconds of baking; the front's in bold."""
    case = Case.of(device, "metal-rough-grid", around, size, spp)
    settings = [{"size": side, "samples": samples} for side in SIZES for samples in SAMPLES]
    points = []
    for knobs in settings:
        renderer, seen = captured(device, case.scene, size, "split_sum", knobs)
        points.append((renderer.baking.milliseconds["split_sum"], case.errors(seen.frame["environment"])[0]))
    front = pareto_front(points)
    yield "| size | " + " | ".join(f"{samples} samples" for samples in SAMPLES) + " |"
    yield "| ---: |" + " ---: |" * len(SAMPLES)
    for row, side in enumerate(SIZES):
        cells = []
        for index in range(row * len(SAMPLES), (row + 1) * len(SAMPLES)):
            bake, error = points[index]
            mark = "**" if front[index] else ""
            cells.append(f"{mark}{error:.3f}, {bake:.0f} ms{mark}")
        yield f"| {side} | " + " | ".join(cells) + " |"


def draw(device: Device, maps: dict[str, Environment], spp: int, path: Path) -> None:
    """A row per map: the grid by some techniques, and by the truth; the environment alone, nothing hidden."""
    rows, size = [], 200
    for around in maps.values():
        case = Case.of(device, "metal-rough-grid", around, size, spp)
        shown = []
        for effect, knobs in COMPARED:
            seen = captured(device, case.scene, size, effect, knobs)[1]
            shown.append(seen.frame["environment"] + seen.points.emission)
        shown.append(sum(case.truth) / 2 + seen.points.emission)
        display = display_transform(compile_plan(case.scene, effects()))
        rows.append(np.concatenate([np.round(255 * display(i.astype(np.float64))).astype(np.uint8) for i in shown], 1))
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.concatenate(rows)).save(path, quality=90)


def title(effect: str, knobs: dict) -> str:
    """The effect with the knobs that are set."""
    return f"`{effect}`" + "".join(f", {name} {str(value).lower()}" for name, value in knobs.items())


def main() -> None:
    """Print the tables that were asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="scenes,roughness,sun,sweep", help="tables, by comma")
    parser.add_argument("--map", type=Path, help="a map from a file, beside the built-in ones")
    parser.add_argument("--size", type=int, default=128, help="side of the picture in pixels (%(default)s)")
    parser.add_argument("--spp", type=int, default=512, help="samples of the truth (%(default)s)")
    parser.add_argument("--picture", type=Path, help="where to write the picture")
    options = parser.parse_args()
    device = Device()
    maps = {name: built_in(name) for name in reversed(BUILT_IN)}
    if options.map:
        maps["outdoor"] = environment_from(options.map)
    sunny = maps.get("outdoor", maps["sky"])
    tables = {
        "scenes": lambda: scenes_table(device, maps, options.size, options.spp),
        "roughness": lambda: roughness_table(device, maps, options.size, options.spp),
        "sun": lambda: sun_table(device, sunny, options.size, options.spp),
        "sweep": lambda: sweep_table(device, sunny, options.size, options.spp),
    }
    for name in filter(None, options.only.split(",")):
        print(f"\n{name}\n")
        for line in tables[name]():
            print(line, flush=True)
    if options.picture:
        draw(device, maps, options.spp, options.picture)
    print("\n" + machine(device))


if __name__ == "__main__":
    main()
