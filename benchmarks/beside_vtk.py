"""grid-sun beside VTK's PBR renderer in the same run: milliseconds, and errors against the same truth."""

import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from figures import Figure
from PIL import Image

from lightmeter.groundtruth.store import Store
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import measure_all
from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.realtime.timing import Times
from lightmeter.scenes.load import load
from lightmeter.truth import Truth

SCENE = "grid-sun"
SIDE = 512
FRAMES = 20
ROUNDS = 3
METRICS = ("rmse", "nrmse", "relative_bias", "ssim", "flip")
LOWER_IS_BETTER = ("rmse", "nrmse", "flip")
STEEPEST, VTKS_OWN = 88.0, 11.0
"""VTK's shadow maps hold exp(c · depth), depth up to 1. At the largest c whose exponential float32 can hold, ln(2¹²⁸) =
88.7, they come nearest to a true comparison of depths; VTK takes 11 by default."""
CHILD = Path(__file__).with_name("vtk_frame.py")


@dataclass(frozen=True, eq=False)
class Beside:
    """What was found.

    Attributes:
        figures: times and errors.
        frame, truth: ours and the reference's mean, (H, W, 3) scene-linear.
        display: the display transform that was put on all sides.
    """

    figures: list[Figure]
    frame: np.ndarray
    truth: np.ndarray
    display: Callable[[np.ndarray], np.ndarray]


def measure(device: Device, spp: int, picture: Path) -> Beside:
    """Time and judge both, and write VTK | lightmeter | truth to `picture`.

    Args:
        spp: samples per pixel of the truth, which the store keeps.
    """
    scene, size = load(SCENE), (SIDE, SIDE)
    plan = compile_plan(scene, effects())
    renderer = Renderer(device, plan, size)
    ours, theirs = [], []
    for _ in range(ROUNDS):
        ours.append(renderer.measure(FRAMES))
        theirs.append(_vtk(FRAMES, STEEPEST))
    frame, vtk = renderer.render().radiance, theirs[0]
    display = display_transform(plan)
    reference = Truth(scene, size, Budget(spp), store=Store()).reference
    others = {
        "indirect=0": Choice(settings={"constant_ambient": {"indirect": 0.0}}),
        "gtao": Choice(use=("gtao",)),
    }
    images = {
        "lightmeter": frame,
        **{
            f"lightmeter, {name}": Renderer(device, compile_plan(scene, effects(), choice), size).render().radiance
            for name, choice in others.items()
        },
        "VTK": vtk["radiance"],
        "VTK, its default shadows": _vtk(1, VTKS_OWN)["radiance"],
    }
    truth = reference.mean
    _side_by_side(picture, [display(image) for image in (vtk["radiance"], frame, truth)])
    figures = [
        *_times(ours, theirs),
        _framing(renderer, vtk["distance"]),
        *_errors(images, reference.batches, display),
    ]
    return Beside(figures, frame, truth, display)


def _vtk(frames: int, steepness: float) -> dict[str, np.ndarray]:
    """What the child process rendered and timed."""
    with tempfile.TemporaryDirectory(prefix="lightmeter-bench-") as folder:
        out = Path(folder, "frame.npz")
        words = [sys.executable, str(CHILD), SCENE, str(SIDE), str(frames), str(steepness), str(out)]
        subprocess.run(words, check=True)
        with np.load(out) as found:
            return dict(found)


def _times(ours: list[Times], theirs: list[dict[str, np.ndarray]]) -> list[Figure]:
    """Medians over the rounds, which alternate."""
    note = f"median of {ROUNDS} × {FRAMES} frames"
    frame = float(np.median([times.frame.median for times in ours]))
    maps = [sum(t.median for name, _, t in times.passes if name.endswith("· map")) for times in ours]
    drawn, kept = (float(np.median([found[key] for found in theirs])) for key in ("drawn", "kept"))
    which = f"VTK {theirs[0]['version']}"
    return [
        Figure("lightmeter", frame, "ms", drawn, f"{note}; shadow map, shading, tone and encoding"),
        Figure("VTK", drawn, "ms", None, f"{note}; {which}, its shadow map drawn every frame, as ours"),
        Figure(
            "lightmeter, less its shadow map", frame - float(np.median(maps)), "ms", kept, "frame less the map's pass"
        ),
        Figure("VTK, its shadow map kept", kept, "ms", None, "as it does while nothing moves"),
    ]


def _framing(renderer: Renderer, distance: np.ndarray) -> Figure:
    """Pixels where the two see different surfaces: those of a silhouette that is shifted would be hundreds."""
    camera = renderer.plan.scene.camera
    position = renderer.capture(terms=False).points.position.astype(np.float64)
    ours = (camera.position - position) @ camera.matrix[:3, 2]
    apart = float(np.count_nonzero(np.abs(ours - distance) > 0.01))
    return Figure(
        "pixels that see another surface", apart, "", None, f"of {distance.size}, more than 1 cm apart in depth"
    )


def _errors(
    images: dict[str, np.ndarray], batches: np.ndarray, display: Callable[[np.ndarray], np.ndarray]
) -> list[Figure]:
    """Every image's metrics against the same batches and through the same display transform."""
    found = {name: measure_all(METRICS, Comparison(image, batches), display=display) for name, image in images.items()}
    return [
        Figure.of(
            f"{metric} · {name}",
            measured[metric],
            found["VTK"][metric].value if name == "lightmeter" and metric in LOWER_IS_BETTER else None,
        )
        for metric in METRICS
        for name, measured in found.items()
    ]


def _side_by_side(path: Path, pictures: list[np.ndarray]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    row = np.concatenate(pictures, axis=1)
    Image.fromarray(np.round(row * 255).astype(np.uint8)).save(path)
