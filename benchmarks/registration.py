"""How often registration names a planted fault, with which size, and what it names of frames that have none.

    python benchmarks/registration.py [--seeds 3] [--side 64 128] [--scene NAME …] [--output docs/registration.md]

Faults are planted into two kinds of frames of every built-in scene: one that is path traced with its own random numbers,
and lightmeter's real-time frame with its usual approximations. The tables replace what stands in docs/registration.md
under their heading; what is above it stays.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy is imported; the matrices are small

import argparse
import datetime
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from rich.console import Console
from scipy.ndimage import map_coordinates

from lightmeter.device import fingerprint
from lightmeter.groundtruth.batches import reference
from lightmeter.groundtruth.store import Store
from lightmeter.metrics.registration import Fault, find_faults
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import library
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene
from lightmeter.scenes.optics.color import srgb_decode, srgb_encode

HEADING = "## Measured\n"
TEXT = """\
{heading}
Written by `{command}` on {date}, against references of 8 × {spp} samples per pixel.

### Planted faults

*Named* counts the frames in which exactly the planted faults were named, and nothing else. *Off by* is the largest
difference from the planted size among those: pixels of a shift, percentage points of a field of view, per cent of a
factor, and of a count of pixels. *Path traced* frames are right but for the fault; *real-time* ones carry
lightmeter's usual approximations as well. "—" is a fault that such a frame cannot have.

| planted | pixels | path traced: named | off by | real-time: named | off by |
| --- | ---: | ---: | ---: | ---: | ---: |
{planted}

By scene, all faults and sizes together:

| scene | path traced: named | with another fault named | real-time: named | with another fault named |
| --- | ---: | ---: | ---: | ---: |
{scenes}

### Right frames

Nothing is to be named.

| frame | frames | false alarms |
| --- | ---: | ---: |
{right}

### Time

{times}

Machine: {facts}. {minutes:.0f} minutes.
"""

FINE = 4
"""Pixels of a fine image along a pixel's side."""
FINE_SPP, SPP = 16, 8
ZOOM = 1.02
Image = np.ndarray


@dataclass(frozen=True)
class Planted:
    """A fault, or several.

    Attributes:
        name: as the table calls it.
        sizes: fault to its size, as `Fault.size` has it; what is not stated is not held against it.
        right, down, zoom, narrow: how the frame is rendered: pixels, and scales of the tangent (narrow: across only).
        after: what is done to the finished image.
        alpha: whether the frame is multiplied by an alpha, which it hands in.
        background: whether the surroundings are taken out.
    """

    name: str
    sizes: Mapping[str, Mapping[str, float]]
    right: float = 0.0
    down: float = 0.0
    zoom: float = 1.0
    narrow: float = 1.0
    after: Callable[[Image], Image] = field(default=lambda image: image)
    alpha: bool = False
    background: bool = False


def _encoded(image: Image) -> Image:
    return srgb_encode(np.maximum(image, 0.0))


def _power(exponent: float) -> Callable[[Image], Image]:
    return lambda image: np.maximum(image, 0.0) ** exponent


LEFT_RIGHT = {"flip": {"left_right": 1.0, "up_down": 0.0}}
ENCODED = {"transfer": {"exponent": 1 / 2.2}}
FAULTS = (
    Planted("mirrored left to right", LEFT_RIGHT, after=lambda i: i[:, ::-1]),
    Planted("upside down", {"flip": {"left_right": 0.0, "up_down": 1.0}}, after=lambda i: i[::-1]),
    Planted("turned by 180°", {"flip": {"left_right": 1.0, "up_down": 1.0}}, after=lambda i: i[::-1, ::-1]),
    Planted("half a pixel right", {"shift": {"right": 0.5, "down": 0.0}}, right=0.5),
    Planted("half a pixel right and up", {"shift": {"right": 0.5, "down": -0.5}}, right=0.5, down=-0.5),
    Planted("1 pixel left, 2.25 down", {"shift": {"right": -1.0, "down": 2.25}}, right=-1.0, down=2.25),
    Planted("2 % more seen", {"field_of_view": {"horizontal": 2.0, "vertical": 2.0}}, zoom=ZOOM),
    Planted("2 % less seen", {"field_of_view": {"horizontal": -2.0, "vertical": -2.0}}, zoom=2 - ZOOM),
    Planted("2 % less seen across", {"field_of_view": {"horizontal": -2.0, "vertical": 0.0}}, narrow=2 - ZOOM),
    Planted("exposed × 1.5", {"exposure": {"factor": 1.5}}, after=lambda i: i * 1.5),
    Planted("exposed × 0.8", {"exposure": {"factor": 0.8}}, after=lambda i: i * 0.8),
    Planted("sRGB-encoded", ENCODED, after=_encoded),
    Planted("sRGB-encoded and clipped", ENCODED, after=lambda i: _encoded(np.clip(i, 0, 1))),
    Planted("sRGB-decoded", {"transfer": {"exponent": 2.2}}, after=srgb_decode),
    Planted("to the power 1/2.2", ENCODED, after=_power(1 / 2.2)),
    Planted("multiplied by alpha", {"alpha": {}}, alpha=True),
    Planted("black background", {"background": {}}, background=True),
    Planted("mirrored, × 1.5", LEFT_RIGHT | {"exposure": {"factor": 1.5}}, after=lambda i: 1.5 * i[:, ::-1]),
    Planted(
        "half a pixel right, × 0.8",
        {"shift": {"right": 0.5, "down": 0.0}, "exposure": {"factor": 0.8}},
        right=0.5,
        after=lambda i: 0.8 * i,
    ),
    Planted(
        "half a pixel right, sRGB-encoded",
        {"shift": {"right": 0.5, "down": 0.0}} | ENCODED,
        right=0.5,
        after=_encoded,
    ),
    Planted(
        "2 % more seen, × 1.5",
        {"field_of_view": {"horizontal": 2.0, "vertical": 2.0}, "exposure": {"factor": 1.5}},
        zoom=ZOOM,
        after=lambda i: 1.5 * i,
    ),
    Planted(
        "mirrored, 1 pixel left and 2.25 down, × 1.5",
        LEFT_RIGHT | {"shift": {"right": -1.0, "down": 2.25}, "exposure": {"factor": 1.5}},
        right=-1.0,
        down=2.25,
        after=lambda i: 1.5 * i[:, ::-1],
    ),
)
CHOICES = {
    "real-time": Choice(),
    "real-time, 4 × 4 samples": Choice(settings={"supersampling": {"grid": 4}}),
    "real-time, hard shadows of 256²": Choice(settings={"shadow_map": {"filter": "hard", "resolution": 256}}),
    "real-time, twice the indirect light": Choice(settings={"constant_ambient": {"indirect": 1.0}}),
    "real-time, without ambient light": Choice(without=("constant_ambient",)),
    "real-time, without shadows": Choice(without=("shadow_map",)),
    "real-time, direct light alone": Choice(only=("cook_torrance",)),
}


class Frames:
    """Frames of a scene at a size, and what is known of its pixels."""

    def __init__(self, device: Device, scene: Scene, side: int, store: Store) -> None:
        self._device, self._scene, self._store, self.side = device, scene, store, side
        points = self._renderer(scene, Choice())
        grid = (np.arange(FINE) + 0.5) / FINE - 0.5
        hits = [points.capture((x, y), terms=False).points.hit for y in grid for x in grid]
        self.coverage = np.mean(hits, axis=0)
        self.background = ~points.capture(terms=False).points.hit

    def reference(self, seed: int) -> Image:
        """(8, H, W, 3) batches."""
        return reference(self._scene, (self.side, self.side), spp=SPP, seed=seed, store=self._store).batches

    def traced(self, right: float = 0, down: float = 0, zoom: float = 1, narrow: float = 1) -> Image:
        """(H, W, 3), path traced finely and averaged over pixels that lie as asked."""
        scene, size = _zoomed(self._scene, zoom), (self.side * FINE,) * 2
        fine = reference(scene, size, spp=FINE_SPP // 2, batches=2, seed=1000, store=self._store).mean
        offsets = np.arange(size[0]) - (size[0] - 1) / 2
        rows, columns = ((size[0] - 1) / 2 + at for at in (offsets - down * FINE, narrow * (offsets - right * FINE)))
        if narrow == 1:  # whole fine pixels
            moved = fine[_within(rows, size[0])][:, _within(columns, size[0])]
        else:
            at = np.meshgrid(rows, columns, indexing="ij")
            moved = np.stack([map_coordinates(fine[..., c], at, order=1, mode="nearest") for c in range(3)], axis=2)
        return moved.reshape(self.side, FINE, self.side, FINE, 3).mean(axis=(1, 3))

    def drawn(self, right: float = 0, down: float = 0, zoom: float = 1, choice: Choice | None = None) -> Image:
        """(H, W, 3), lightmeter's own."""
        renderer = self._renderer(_zoomed(self._scene, zoom), choice or Choice())
        renderer.offsets = renderer.offsets - np.array([right, down])
        return renderer.render().radiance

    def _renderer(self, scene: Scene, choice: Choice) -> Renderer:
        return Renderer(self._device, compile_plan(scene, effects(), choice), (self.side, self.side))

    def alpha(self) -> Image:
        """(H, W): the coverage by surfaces, under a veil that thins from the left border to the middle."""
        veil = np.minimum(0.3 + 1.4 * np.arange(self.side) / self.side, 1.0)
        return self.coverage * veil


def _zoomed(scene: Scene, zoom: float) -> Scene:
    camera = scene.camera
    assert camera.yfov is not None
    return replace(scene, camera=replace(camera, yfov=float(2 * np.arctan(zoom * np.tan(camera.yfov / 2)))))


def _within(places: np.ndarray, length: int) -> np.ndarray:
    return np.clip(np.round(places).astype(int), 0, length - 1)


@dataclass(frozen=True)
class Trial:
    """What was named of a frame with a planted fault."""

    planted: Planted
    scene: str
    side: int
    kind: str
    found: tuple[Fault, ...]
    pixels: float

    @property
    def named(self) -> bool:
        """Whether exactly the planted faults were named."""
        return {fault.name for fault in self.found} == set(self.planted.sizes)

    @property
    def wrong(self) -> bool:
        """Whether a fault was named that is not there."""
        return not {fault.name for fault in self.found} <= set(self.planted.sizes)

    @property
    def off(self) -> dict[str, float]:
        """Fault to the difference from the planted size."""
        sizes = self.planted.sizes
        return {fault.name: _off(fault, sizes[fault.name], self.pixels) for fault in self.found if fault.name in sizes}


def _off(fault: Fault, size: Mapping[str, float], pixels: float) -> float:
    if fault.name in ("alpha", "background"):
        return 100 * abs(fault.size["pixels"] / pixels - 1)
    if fault.name == "exposure":
        return 100 * abs(fault.size["factor"] / size["factor"] - 1)
    return max(abs(fault.size[key] - value) for key, value in size.items())


UNITS = {"shift": "px", "field_of_view": "points", "exposure": "%", "alpha": "%", "background": "%"}


def trials(frames: Frames, scene: Scene, seeds: int) -> Iterator[Trial]:
    """Every fault planted into both kinds of frames."""
    references = [frames.reference(seed) for seed in range(seeds)]
    mean = references[0].mean(axis=0)
    lit = mean.mean(axis=2) > 1e-3 * mean.mean()
    for planted in FAULTS:
        pixels = frames.background & lit if planted.background else lit & (frames.alpha() < 0.98)
        if (planted.alpha or planted.background) and np.count_nonzero(pixels) < 16:
            continue
        for kind in ("path traced", "real-time"):
            image = _frame(frames, planted, kind)
            if image is None:
                continue
            alpha = frames.alpha() if planted.alpha else None
            for batches in references:
                found = find_faults(image, batches, alpha=alpha, background=frames.background)
                yield Trial(planted, scene.name, frames.side, kind, found, float(np.count_nonzero(pixels)))


def _frame(frames: Frames, planted: Planted, kind: str) -> Image | None:
    if kind == "path traced":
        image = frames.traced(planted.right, planted.down, planted.zoom, planted.narrow)
    elif planted.narrow == 1:
        image = frames.drawn(planted.right, planted.down, planted.zoom)
    else:
        return None
    if planted.alpha:
        image = image * frames.alpha()[..., None]
    if planted.background:
        # What a renderer without surroundings leaves: what covers a pixel partly stays as it is.
        share = frames.coverage if kind == "path traced" else 1.0 - frames.background
        behind = np.median(image[frames.background], axis=0)
        image = np.maximum(image - (1 - share)[..., None] * behind, 0.0)
    return planted.after(image).astype(np.float32)


def right_frames(frames: Frames, seeds: int) -> Iterator[tuple[str, Image, Image]]:
    """(name, frame, reference) of frames that have no fault of the kind."""
    for seed in range(seeds):
        batches = frames.reference(seed)
        yield "path traced, 4096 samples", frames.traced(), batches
        yield f"path traced, {8 * SPP} samples", frames.reference(seeds + seed).mean(axis=0), batches
        yield f"path traced, {SPP} samples", frames.reference(seeds + seed)[0], batches
        for name, choice in CHOICES.items():
            yield name, frames.drawn(choice=choice), batches


def vtk_frame(side: int) -> Image:
    """(H, W, 3) by VTK, of the scene that vtk_frame.py can take."""
    with tempfile.TemporaryDirectory(prefix="lightmeter-bench-") as folder:
        out = Path(folder, "frame.npz")
        child = Path(__file__).with_name("vtk_frame.py")
        subprocess.run([sys.executable, str(child), "grid-sun", str(side), "1", "88", str(out)], check=True)
        with np.load(out) as found:
            return found["radiance"]


def planted_rows(found: list[Trial], sides: list[int]) -> Iterator[str]:
    """A row per fault and size."""
    for planted in FAULTS:
        for side in sides:
            cells = []
            for kind in ("path traced", "real-time"):
                those = [t for t in found if (t.planted, t.side, t.kind) == (planted, side, kind)]
                good = [t for t in those if t.named]
                off = {name: max(t.off[name] for t in good) for name in planted.sizes if name in UNITS} if good else {}
                cells.append(f"{len(good)} of {len(those)}" if those else "—")
                cells.append(", ".join(f"{value:.2g} {UNITS[name]}" for name, value in off.items()) or "—")
            yield f"| {planted.name} | {side} | {' | '.join(cells)} |"


def scene_rows(found: list[Trial]) -> Iterator[str]:
    """A row per scene."""
    for scene in dict.fromkeys(t.scene for t in found):
        cells = []
        for kind in ("path traced", "real-time"):
            those = [t for t in found if (t.scene, t.kind) == (scene, kind)]
            cells += [f"{sum(t.named for t in those)} of {len(those)}", str(sum(t.wrong for t in those))]
        yield f"| {scene} | {' | '.join(cells)} |"


def timing(frames: Frames) -> str:
    """How long a frame of 512² takes."""
    batches, image = frames.reference(0), frames.drawn()
    parts = []
    for name, tested in (
        ("right", image),
        ("sRGB-encoded", _encoded(image)),
        ("shifted by 3 pixels", np.roll(image, 3, 1)),
    ):
        seconds = []
        for _ in range(3):
            start = time.process_time()
            find_faults(tested.astype(np.float32), batches, background=frames.background)
            seconds.append(time.process_time() - start)
        parts.append(f"{min(seconds):.2f} s where the frame is {name}")
    return f"A frame of {frames.side}², 8 batches, on one core: {', '.join(parts)}."


def main() -> None:
    """Plant, count, and write the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=3, help="references, each with random numbers of its own")
    parser.add_argument("--side", type=int, nargs="+", default=[64, 128])
    parser.add_argument("--scene", nargs="+", choices=library.names(), default=library.names())
    parser.add_argument("--output", type=Path, default=Path("docs/registration.md"))
    args = parser.parse_args()
    console, start = Console(stderr=True), time.perf_counter()
    device, store = Device(), Store()
    found: list[Trial] = []
    alarms: dict[str, list[str]] = {}
    for name in args.scene:
        for side in args.side:
            scene = load(name)
            frames = Frames(device, scene, side, store)
            found += trials(frames, scene, args.seeds)
            right = list(right_frames(frames, args.seeds))
            if name == "grid-sun" and find_spec("vtk"):
                right += [("VTK's PBR renderer", vtk_frame(side), frames.reference(s)) for s in range(args.seeds)]
            for kind, image, batches in right:
                faults = find_faults(image, batches, background=frames.background)
                alarms.setdefault(kind, []).append("; ".join(fault.words for fault in faults))
                if faults:
                    console.print(f"{name} {side}: {kind}: {alarms[kind][-1]}")
            console.print(f"{name} {side}: {time.perf_counter() - start:.0f} s")
    for trial in found:
        if trial.wrong:
            words = "; ".join(fault.words for fault in trial.found)
            console.print(f"{trial.scene} {trial.side} {trial.kind}, {trial.planted.name}: {words}", soft_wrap=True)
    tables = TEXT.format(
        heading=HEADING,
        command=f"python benchmarks/registration.py --seeds {args.seeds} --side {' '.join(map(str, args.side))}",
        date=datetime.date.today(),
        spp=SPP,
        planted="\n".join(planted_rows(found, args.side)),
        scenes="\n".join(scene_rows(found)),
        right="\n".join(f"| {kind} | {len(said)} | {sum(map(bool, said))} |" for kind, said in alarms.items()),
        times=timing(Frames(device, load("grid-sun"), 512, store)),
        facts=", ".join(f"{key} {value}" for key, value in fingerprint(device.renderer, device.version).items()),
        minutes=(time.perf_counter() - start) / 60,
    )
    page = args.output.read_text(encoding="utf-8") if args.output.exists() else ""
    args.output.write_text(page.split(HEADING)[0] + tables, encoding="utf-8")
    console.print(f"wrote {args.output}")


if __name__ == "__main__":
    main()
