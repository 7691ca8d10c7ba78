"""Glare and exposure against their truths: what each technique adds and misses, and how far meters are off.

    python benchmarks/glare_and_exposure.py [--size 192x128] [--spp 1024] [--output TABLES.md] [--picture FILE]

Writes the tables and the picture of docs/glare-and-exposure.md.
"""

import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from rich.console import Console

from lightmeter import options
from lightmeter.groundtruth.oracles import glare
from lightmeter.groundtruth.store import Store
from lightmeter.metrics.flip import ldr_flip
from lightmeter.options import Budget
from lightmeter.realtime.discovery import effect, effects
from lightmeter.realtime.display import display_transform, twin_of
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.scenes import library
from lightmeter.scenes.aperture import Aperture
from lightmeter.scenes.load import load
from lightmeter.scenes.metering import Metering
from lightmeter.truth import Truth

GLARES: tuple[tuple[str, dict[str, Any]], ...] = (
    ("mip_bloom", {}),
    ("mip_bloom", {"strength": 0.005}),
    ("mip_bloom", {"strength": 0.005, "spread": 0.7}),
    ("gaussian_bloom", {}),
    ("gaussian_bloom", {"strength": 0.01}),
    ("gaussian_bloom", {"strength": 0.01, "sigma": 0.005}),
    ("lens_flare", {"threshold": 20.0}),
)
METERS: tuple[tuple[str, dict[str, Any]], ...] = (
    *(("histogram_exposure", {"bins": bins}) for bins in (16, 64, 256)),
    *(("log_average_exposure", {"side": side}) for side in (1, 8, 64, 256)),
)
RULES = {"all pixels": Metering(), "trimmed": Metering(darkest=0.5, brightest=0.05)}


def mean_image(name: str, size: tuple[int, int], spp: int) -> np.ndarray:
    """(H, W, 3) float64 of a scene's reference."""
    truth = Truth(load(name), size, Budget(spp), 0, store=Store())
    return np.mean(truth.reference.batches, axis=0, dtype=np.float64)


def glare_rows(image: np.ndarray, camera, display) -> list[str]:
    """A row for each technique: its errors beside no glare's, and how much light it adds."""
    exact = glare.evaluate(image, camera).astype(np.float64)
    far = np.abs(exact - image).max(axis=-1) < 0.1 * image.mean()  # what glare hardly reaches

    def row(words: str, made: np.ndarray) -> str:
        error = np.sqrt(np.mean((made - exact) ** 2))
        flip = float(ldr_flip(display(made.astype(np.float32)), display(exact.astype(np.float32))).mean())
        added = made.mean() / image.mean() - 1
        veil = (made - exact)[far].mean() / image.mean()
        return f"| {words} | {error:.4f} | {flip:.4f} | {added:+.2%} | {veil:+.2%} |"

    rows = [
        "| technique | RMSE, W/(sr·m²) | FLIP | light added | veil far from lamps |",
        "| --- | --- | --- | --- | --- |",
    ]
    rows.append(row("none", image))
    for name, given in GLARES:
        made = twin_of(name, "glare")(image, effect(name).settings(given))
        rows.append(row(words(name, given), made))
    rows.append(row("truth", exact))
    return rows


def words(name: str, given: dict[str, Any]) -> str:
    """An effect and what is set of it."""
    settings = ", ".join(f"{knob} {value:g}" for knob, value in given.items())
    return f"`{name}`" + (f", {settings}" if settings else "")


def meter_rows(images: dict[str, np.ndarray]) -> list[str]:
    """How many stops each meter is off: the root of the mean square over scenes, and the worst."""
    rows = [
        "| meter | " + " | ".join(f"{rule}: RMS, stops | worst" for rule in RULES) + " |",
        "| --- |" + " --- |" * (2 * len(RULES)),
    ]
    for name, given in METERS:
        knobs, cells = effect(name).settings(given), []
        for rule in RULES.values():
            off = {
                scene: twin_of(name, "exposure")(image, knobs, rule) - rule.average(image)
                for scene, image in images.items()
            }
            worst = max(off, key=lambda scene: abs(off[scene]))
            cells += [f"{np.sqrt(np.mean(np.square(list(off.values())))):.3f}", f"{off[worst]:+.3f} ({worst})"]
        rows.append(f"| {words(name, given)} | " + " | ".join(cells) + " |")
    return rows


def picture(image: np.ndarray, camera, display) -> Image.Image:
    """No glare, three techniques, and the truth for a circle and for six blades."""
    round_one = replace(camera, aperture=replace(camera.aperture, blades=0))
    several = [
        image,
        twin_of("gaussian_bloom", "glare")(image, effect("gaussian_bloom").settings({})),
        twin_of("mip_bloom", "glare")(image, effect("mip_bloom").settings({})),
        twin_of("lens_flare", "glare")(image, effect("lens_flare").settings({"threshold": 20.0})),
        glare.evaluate(image, round_one),
        glare.evaluate(image, camera),
    ]
    shown = [np.rint(255 * display(np.asarray(one, np.float32))).astype(np.uint8) for one in several]
    rows = [np.concatenate(shown[:3], axis=1), np.concatenate(shown[3:], axis=1)]
    return Image.fromarray(np.concatenate(rows, axis=0))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=options.size, default=(192, 128), metavar="WxH", help="of the pictures")
    parser.add_argument("--spp", type=int, default=1024, metavar="N", help="samples of the references (%(default)s)")
    parser.add_argument("--output", type=Path, metavar="FILE", help="write the tables here")
    parser.add_argument("--picture", type=Path, metavar="FILE", help="write the picture here")
    args = parser.parse_args()
    image = mean_image("lamps", args.size, args.spp)
    plan = compile_plan(load("lamps"), effects(), Choice())
    display = display_transform(plan, image)
    camera = plan.scene.camera
    text = ["### Glare\n", *glare_rows(image, camera, display), "", "### Exposure\n"]
    images = {name: mean_image(name, (96, 96), max(16, args.spp // 16)) for name in library.names()}
    text += meter_rows(images)
    Console().print("\n".join(text), markup=False, soft_wrap=True)
    if args.output:
        args.output.write_text("\n".join(text) + "\n", encoding="utf-8")
    if args.picture:
        wide = replace(camera, aperture=Aperture(22.0, 6, camera.aperture.rotation if camera.aperture else 0.0))
        picture(image, wide, display).save(args.picture, quality=92)


if __name__ == "__main__":
    main()
