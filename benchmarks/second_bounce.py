"""How much of the light between surfaces each technique recovers: the tables and the picture of docs/second-bounce.md.

python benchmarks/second_bounce.py SCENE [--size 96] [--spp 256] [--dark] [--only sweep] [--picture FILE]
"""

import argparse
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from lightmeter.bounce_errors import against_bounces
from lightmeter.device import fingerprint
from lightmeter.metrics.measurement import Measurement
from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.results import BounceShare
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene
from lightmeter.sides import FramePoints
from lightmeter.truth import Truth

MAPS = {"visibility": "maps"}
TECHNIQUES = (
    ("constant_ambient", {}),
    ("virtual_lights", {}),
    ("virtual_lights", {"tile": 4}),
    ("virtual_lights", MAPS),
    ("virtual_lights", {"bounces": 2}),
    ("virtual_lights", {"bounces": 2} | MAPS),
    ("screen_space_indirect", {}),
    ("screen_space_indirect", {"slices": 8, "steps": 48}),
    ("irradiance_probes", {"ambient": 0.0}),
    ("irradiance_probes", {"ambient": 0.0, "spacing": 0.5}),
    ("irradiance_probes", {}),
    ("irradiance_probes", {"ambient": 1.0}),
)
SWEEP = tuple(
    ("virtual_lights", {"lights": lights, "clamp": 0.0, "emitter_points": 16} | MAPS) for lights in (16, 64, 256, 1024)
)
PICTURED = (1, 5, 6, 10)
"""Of the techniques."""
FRAMES = 5


class Bench:
    """One scene and its truths; every technique is judged at the same points."""

    def __init__(self, scene: Scene, size: int, spp: int) -> None:
        self.scene, self.size, self.device = scene, (size, size), Device()
        self.truth = Truth(self.scene, self.size, Budget(spp=spp))
        self.points = None

    def judge(self, effect: str, knobs: Mapping) -> tuple[tuple[BounceShare, ...], Renderer, np.ndarray]:
        """An effect against each truth, its renderer, and its image."""
        choice = Choice(use=(effect,), settings={effect: knobs})
        renderer = Renderer(self.device, compile_plan(self.scene, effects(), choice), self.size)
        at = FramePoints.of(renderer, self.truth)
        self.points = self.points or at.points  # the same object: what is known of it is remembered
        at = FramePoints(self.truth, at.captures, self.points)
        found = against_bounces(effect, self.truth, at)
        return found, renderer, np.mean([capture.frame["indirect"] for capture in at.captures], axis=0)

    def exact(self, depth: int | None) -> np.ndarray:
        """(H, W, 3): the light of paths up to a depth."""
        truth = self.truth if depth is None else self.truth.to_depth(depth)
        batches = range(self.truth.batches)
        assert self.points is not None, "a technique is judged first"
        spp = max(1, self.truth.reference.spp // len(self.points.shape))
        images = [truth.batch(self.points, n, "frame", spp, terms=("indirect",)).indirect for n in batches]
        return np.mean(images, axis=(0, 1))

    def rows(self, techniques) -> Iterator[str]:
        """A row of Markdown for each."""
        heads = "one bounce: recovered | leaked | missing | two: recovered | all: recovered | nrmse of all | ms"
        yield f"| technique | {heads} |"
        yield "| --- |" + " ---: |" * 7
        for effect, knobs in techniques:
            found, renderer, _ = self.judge(effect, knobs)
            by = {bounce.bounces: bounce for bounce in found}
            times = renderer.measure(FRAMES).of(effect)
            baked = renderer.baking.milliseconds.get(effect)
            once, mean = by[1], self.mean()
            cells = [percent(once.share), percent(once.leaked), percent(once.missing), percent(by[2].share)]
            cells += [percent(by[None].share), f"{by[None].rmse.value / mean:.3f}"]
            cells.append(f"{times.median:.1f}" + (f" (+ {baked:,.0f} once)" if baked else ""))
            yield f"| {title(effect, knobs)} | " + " | ".join(cells) + " |"

    def mean(self) -> float:
        """The mean of all that is scattered."""
        if not hasattr(self, "_mean"):
            self._mean = float(self.exact(None).mean())
        return self._mean

    def picture(self, path: Path) -> None:
        """Above: one bounce, and what techniques give; below: all bounces, and their error against one (red: light)."""
        once = self.exact(3)
        images = [self.judge(*TECHNIQUES[number])[2] for number in PICTURED]
        above = [shown(image, self.scene.camera.exposure) for image in (once, *images)]
        scale = float(np.percentile(once, 99))
        below = [shown(self.exact(None), self.scene.camera.exposure), *(signed((i - once) / scale) for i in images)]
        rows = [np.concatenate(row, axis=1) for row in (above, below)]
        picture = Image.fromarray(np.concatenate(rows, axis=0))
        picture.resize((picture.width * 2, picture.height * 2), Image.Resampling.NEAREST).save(path, quality=90)


def percent(part: Measurement) -> str:
    """With its interval."""
    if part.low is None or part.high is None:
        return f"{100 * part.value:.1f} %"
    return f"{100 * part.value:.1f} ± {50 * (part.high - part.low):.1f} %"


def title(effect: str, knobs: Mapping) -> str:
    """The effect and the knobs that are not as they come."""
    return ", ".join([f"`{effect}`", *(f"{name} {value}" for name, value in knobs.items())])


def shown(radiance: np.ndarray, exposure: float) -> np.ndarray:
    """(H, W, 3) uint8 for looking at; two stops brighter than in the frame."""
    return (255 * np.clip(radiance * 2.0 ** (exposure + 2), 0, 1) ** (1 / 2.2)).astype(np.uint8)


def signed(error: np.ndarray) -> np.ndarray:
    """(H, W, 3) uint8: red where the mean over the channels is too light, blue where too dark, as in heatmaps."""
    mean = error.mean(axis=-1)
    found = np.zeros(error.shape)
    found[..., 0], found[..., 2] = np.clip(mean, 0, 1), np.clip(-mean, 0, 1)
    return (255 * np.sqrt(found)).astype(np.uint8)


def main() -> None:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("--size", type=int, default=96)
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--dark", action="store_true", help="without the scene's environment")
    parser.add_argument("--only", choices=("techniques", "sweep", "picture"))
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    scene = load(options.scene)
    bench = Bench(replace(scene, environment=None) if options.dark else scene, options.size, options.spp)
    print(f"{fingerprint(bench.device.renderer, bench.device.version)}\n")
    for name, techniques in (("techniques", TECHNIQUES), ("sweep", SWEEP)):
        if options.only in (None, name):
            for row in bench.rows(techniques):
                print(row, flush=True)
            print()
    if options.picture:
        if bench.points is None:
            bench.judge(*TECHNIQUES[0])
        bench.picture(options.picture)


if __name__ == "__main__":
    main()
