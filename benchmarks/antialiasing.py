"""What each way to sample and filter a pixel leaves of the box filter's error, and what it costs.

    python benchmarks/antialiasing.py [--size 128] [--spp 256] [--frames 20] [--picture FILE] [--output FILE]

Every other term is exact at the frame's samples, so that the error is the sampling's and the filter's alone.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import datetime
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from lightmeter.device import fingerprint
from lightmeter.display_chain import Chained
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.flip import ldr_flip
from lightmeter.metrics.mse import nrmse
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.sides import effect_sides
from lightmeter.truth import Truth

SCENES = ("control", "torus")
TECHNIQUES: dict[str, Choice] = {
    "centre sample": Choice(),
    "`fxaa`": Choice(use=("fxaa",)),
    "`msaa`, 2": Choice(use=("msaa",), settings={"msaa": {"samples": 2}}),
    "`msaa`, 4": Choice(use=("msaa",)),
    "`msaa`, 8": Choice(use=("msaa",), settings={"msaa": {"samples": 8}}),
    "`supersampling`, 2 × 2": Choice(settings={"supersampling": {"grid": 2}}),
    "`supersampling`, 4 × 4": Choice(settings={"supersampling": {"grid": 4}}),
    "`taa`, 16 frames": Choice(use=("taa",)),
    "`taa`, no clamp": Choice(use=("taa",), settings={"taa": {"clamp": False}}),
    "`taa`, no clamp, blend 0": Choice(use=("taa",), settings={"taa": {"clamp": False, "blend": 0.0}}),
}
PICTURED = "torus"
BASE = "centre sample"
MARK = "<!-- measured -->"


@dataclass(frozen=True, eq=False)
class Found:
    """Of one technique in one scene: radiance's error over its mean, and code values'."""

    nrmse: float | None
    codes: float
    flip: float


def judge(renderer: Renderer, truth: Truth) -> Found:
    """The technique's own error, by what `lightmeter compare` calls its sides."""
    plan = renderer.plan
    assert plan.sampler is not None
    linear = effect_sides(renderer, truth, silent, only=(plan.sampler,))[plan.sampler]
    tested, exact = (np.mean(side, axis=0, dtype=np.float64) for side in (linear.tested, linear.truth))
    filters = {name for name in plan.effects if plan.filters_display(name)}
    shown, goal = Chained(plan, tested).whole(()), Chained(plan, exact).whole(filters)
    many = linear.tested[0] if len(linear.tested) == 1 else linear.tested
    error = nrmse(Comparison(many, linear.truth)).value  # not biased by noise
    return Found(None if filters else error, *displayed(shown, goal))


def displayed(shown: np.ndarray, goal: np.ndarray) -> tuple[float, float]:
    """RMS error in codes, and FLIP."""
    difference = np.sqrt(np.mean((shown - goal) ** 2, dtype=np.float64))
    return float(difference) * 255, float(ldr_flip(shown, goal).mean())


def floor(renderer: Renderer, truth: Truth) -> Found:
    """What two halves of the reference differ by, over √2: as much as its noise adds to what is displayed."""
    batches = truth.reference.batches
    halves = [np.mean(batches[start::2], axis=0, dtype=np.float64) for start in (0, 1)]
    shown = [Chained(renderer.plan, half).whole(()) for half in halves]
    codes, flip = displayed(*shown)
    return Found(None, codes / 2**0.5, flip / 2**0.5)


def measure(scene: str, size: int, spp: int, frames: int) -> tuple[dict[str, Found], dict[str, float]]:
    """Errors, and times over the centre sample's, all techniques in turn in every round."""
    device, truth = Device(), Truth(load(scene), (size, size), Budget(spp))
    renderers = {
        name: Renderer(device, compile_plan(truth.scene, effects(), choice), truth.size)
        for name, choice in TECHNIQUES.items()
    }
    found = {name: judge(renderer, truth) for name, renderer in renderers.items()}
    found["*noise*"] = floor(renderers[BASE], truth)
    rounds: dict[str, list[float]] = {name: [] for name in renderers}
    for number in range(frames + 1):
        for name, renderer in renderers.items():
            (milliseconds,) = renderer.record(1, 1 if number == 0 else 0).frame
            if number:
                rounds[name].append(milliseconds)
    ratios = {name: float(np.median(np.array(t) / np.array(rounds[BASE]))) for name, t in rounds.items()}
    return found, ratios


def table(scene: str, found: dict[str, Found], ratios: dict[str, float]) -> list[str]:
    """A scene's rows."""
    lines = [f"## `{scene}`", "", "| | nRMSE | RMSE of codes | FLIP | time |", "| --- | ---: | ---: | ---: | ---: |"]
    for name, one in found.items():
        linear = "" if one.nrmse is None else f"{100 * one.nrmse:.2f} %"
        time = f"{ratios[name]:.2f} ×" if name in ratios else ""
        lines.append(f"| {name} | {linear} | {one.codes:.2f} | {one.flip:.4f} | {time} |")
    return [*lines, ""]


def enlarged(scene: str, size: int, side: int = 32, times: int = 6) -> Image.Image:
    """A part of some techniques' frames beside each other, pixel by pixel."""
    names = (BASE, "`fxaa`", "`msaa`, 4", "`taa`, 16 frames", "`supersampling`, 4 × 4")
    parts = []
    for name in names:
        frame = Renderer(Device(), compile_plan(load(scene), effects(), TECHNIQUES[name]), (size, size)).render()
        assert frame.display is not None
        parts.append(frame.display[size // 3 : size // 3 + side, :side])
    return Image.fromarray(np.concatenate(parts, axis=1).repeat(times, axis=0).repeat(times, axis=1))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--picture", type=Path)
    parser.add_argument("--output", type=Path, default=Path("docs/antialiasing.md"))
    args = parser.parse_args()
    device = Device()
    if args.picture:
        enlarged(PICTURED, args.size).save(args.picture)
    lines = [
        MARK,
        f"Written by `python benchmarks/antialiasing.py --size {args.size} --spp {args.spp} --frames {args.frames}` on "
        f"{datetime.date.today()}.",
        "",
    ]
    for scene in SCENES:
        found, ratios = measure(scene, args.size, args.spp, args.frames)
        lines += table(scene, found, ratios)
    facts = fingerprint(device.renderer, device.version)
    lines += [f"{facts['cpu']}, {facts['cores']} cores, {facts['gl_renderer']}.", ""]
    text = args.output.read_text(encoding="utf-8") if args.output.exists() else "# Anti-aliasing\n\n"
    args.output.write_text(text.partition(MARK)[0] + "\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
