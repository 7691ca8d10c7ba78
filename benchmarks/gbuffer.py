"""What the G-buffer's formats cost in error: the tables and the picture of docs/gbuffer.md.

    python benchmarks/gbuffer.py [--size 256] [--picture FILE]

For each format: bytes per pixel; how far what is read is from what was to be stored; and how far the frame is from that
of a G-buffer in floats, in radiance and as FLIP. Nothing here is random, nothing is path traced. The picture: a frame
whose positions are half floats, near the origin and far from it, and one that are rebuilt from a 16-bit depth.
"""

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from lightmeter.metrics.flip import FlipAgainst
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.layout import bytes_per_pixel
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.scenes.model import DirectionalLight, Scene
from lightmeter.scenes.points import SurfacePoints

SCENES = ("posts", "torus")
EFFECTS = ("packed_surface", "packed_material")
FLOATS = {"position": "fp32", "normal": "fp32", "albedo": "fp32", "parameters": "fp32"}
SURFACE = ("position", "normal", "depth_encoding", "depth_bits")
DEPTHS = [(bits, encoding) for bits in (16, 24, 32) for encoding in ("linear", "standard", "reversed")]
OFFSETS = (0.0, 10.0, 100.0, 1000.0)
"""How far scenes are moved from the origin, metres along x."""

PICTURED = (0.0, 100.0, 1000.0)

POSITIONS = [{"position": "fp16"}] + [
    {"position": "depth", "depth_bits": bits, "depth_encoding": encoding} for bits, encoding in DEPTHS
]
NORMALS = [{"normal": name} for name in ("fp16", "oct8", "oct12", "oct16")]
MATERIALS = [{"albedo": "linear8"}, {"albedo": "srgb8"}, {"parameters": "unorm8"}]


def choice(knobs: dict[str, object]) -> Choice:
    """What is not named is kept in floats."""
    settings: dict[str, dict[str, object]] = {name: {} for name in EFFECTS}
    for name, value in (FLOATS | knobs).items():
        settings[EFFECTS[0] if name in SURFACE else EFFECTS[1]][name] = value
    return Choice(use=EFFECTS, settings=settings)


def far_away(scene: Scene, distance: float) -> Scene:
    """The whole scene, camera and lights too, moved along x."""
    step = np.array([distance, 0.0, 0.0])
    move = np.eye(4)
    move[:3, 3] = step
    lights = [
        light if isinstance(light, DirectionalLight) else replace(light, position=tuple(light.position + step))
        for light in scene.lights
    ]
    return replace(
        scene,
        shapes=tuple(replace(shape, matrix=move @ shape.matrix) for shape in scene.shapes),
        lights=tuple(lights),
        camera=replace(scene.camera, matrix=move @ scene.camera.matrix),
    )


class Plain:
    """A scene's frame with the G-buffer in floats, for others to be held against."""

    def __init__(self, device: Device, scene: Scene, size: tuple[int, int]) -> None:
        self.device, self.scene, self.size = device, scene, size
        there = Renderer(device, compile_plan(scene, effects()), size)
        self.frame, self.points = there.render().radiance, there.capture(terms=False).points
        self.display = display_transform(there.plan)
        self.flip = FlipAgainst(self.display(self.frame))

    def beside(self, knobs: dict[str, object]) -> tuple[Renderer, np.ndarray, SurfacePoints]:
        """A renderer with those formats, its frame, and its points."""
        there = Renderer(self.device, compile_plan(self.scene, effects(), choice(knobs)), self.size)
        return there, there.render().radiance, there.capture(terms=False).points

    def errors(self, frame: np.ndarray) -> tuple[float, float]:
        """RMSE in radiance, and FLIP."""
        rmse = np.sqrt(np.mean((frame.astype(np.float64) - self.frame) ** 2))
        return float(rmse), float(self.flip(self.display(frame)).mean())


def position_error(plain: SurfacePoints, stored: SurfacePoints) -> np.ndarray:
    """Millimetres."""
    return 1000 * np.linalg.norm(stored.position.astype(np.float64) - plain.position, axis=-1)[plain.hit]


def normal_error(plain: SurfacePoints, stored: SurfacePoints) -> np.ndarray:
    """Degrees."""
    apart = np.linalg.norm(stored.normal.astype(np.float64) - plain.normal, axis=-1)[plain.hit]
    return np.degrees(2 * np.arcsin(apart / 2))


def material_error(plain: SurfacePoints, stored: SurfacePoints) -> np.ndarray:
    """Of the base colour and the other parameters, 0…1."""
    names = ("roughness", "metallic", "specular", "occlusion")
    others = [np.abs(getattr(stored, n).astype(np.float64) - getattr(plain, n))[plain.hit] for n in names]
    color = np.abs(stored.base_color.astype(np.float64) - plain.base_color).max(axis=-1)[plain.hit]
    return np.maximum.reduce([color, *others])


Error = Callable[[SurfacePoints, SurfacePoints], np.ndarray]
TABLES: tuple[tuple[str, list[dict[str, object]], Error], ...] = (
    ("position, mm", POSITIONS, position_error),
    ("normal, degrees", NORMALS, normal_error),
    ("material, 0…1", MATERIALS, material_error),
)


def rows(plain: Plain, formats: list[dict[str, object]], error: Error) -> list[str]:
    """A table row per format."""
    found = []
    for knobs in formats:
        there, frame, points = plain.beside(knobs)
        errors, (rmse, flip) = error(plain.points, points), plain.errors(frame)
        shown = [" ".join(str(v) for v in knobs.values()), str(bytes_per_pixel(there.plan.stored()))]
        shown += [f"{v:.3g}" for v in (errors.max(), np.sqrt(np.mean(errors**2)), rmse, flip)]
        found.append("| " + " | ".join(shown) + " |")
    return found


def picture(device: Device, size: tuple[int, int], path: Path) -> None:
    """Positions in half floats at growing distances from the origin, and rebuilt from a 16-bit depth, side by side."""
    panels: list[tuple[float, dict[str, object]]] = [(distance, POSITIONS[0]) for distance in PICTURED]
    panels.append((0.0, {"position": "depth", "depth_bits": 16, "depth_encoding": "standard"}))
    parts = []
    for distance, knobs in panels:
        plain = Plain(device, far_away(load("posts"), distance), size)
        parts.append(plain.display(plain.beside(knobs)[1]))
    strip = np.clip(np.concatenate(parts, axis=1), 0, 1)
    Image.fromarray((strip * 255 + 0.5).astype(np.uint8)).save(path, quality=90)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--picture", type=Path)
    args = parser.parse_args()
    device, size = Device(), (args.size, args.size)
    head = "| format | bytes | largest | RMS | frame RMSE | FLIP |\n| --- | --- | --- | --- | --- | --- |"
    for name in SCENES:
        plain = Plain(device, load(name), size)
        for title, formats, error in TABLES:
            print(f"\n{name}: {title}\n\n{head}")
            print(*rows(plain, formats, error), sep="\n", flush=True)
    print("\nposts, half float positions, by distance from the origin\n\n" + head)
    for distance in OFFSETS:
        plain = Plain(device, far_away(load("posts"), distance), size)
        print(
            *[row.replace("fp16", f"{distance:g} m") for row in rows(plain, POSITIONS[:1], position_error)], flush=True
        )
    if args.picture:
        picture(device, size, args.picture)


if __name__ == "__main__":
    main()
