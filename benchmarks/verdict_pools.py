"""Pools of stored 1-spp batches of real scenes, and the frame that is judged against them."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.world import World
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load


@dataclass(frozen=True, eq=False)
class Pool:
    """Independent batches of one sample a pixel. Drawn from with replacement, their truth is their mean, exactly.

    Attributes:
        batches: (N, H, W, 3) float32.
        frame: (H, W, 3) float32, the real-time frame.
    """

    scene: str
    batches: np.ndarray
    frame: np.ndarray

    @property
    def rmse(self) -> float:
        """The frame's error against the truth of this pool."""
        truth = self.batches.mean(axis=0, dtype=np.float64)
        return float(np.sqrt(np.mean((self.frame - truth) ** 2)))


SUPERSAMPLED = Choice(settings={"supersampling": {"grid": 4}})
"""So that the frame's error is not that of the few pixels at a lamp's edge, where the noise is as well."""


def pool(source: str, side: int, count: int, device: Device, folder: Path) -> Pool:
    """The pool of a scene, kept in `folder`: rendering it takes a minute or two."""
    scene = load(source)
    path = folder / f"{scene.name}-{side}-{count}.npz"
    if path.exists():
        with np.load(path) as known:
            return Pool(scene.name, known["batches"], known["frame"])
    frame = Renderer(device, compile_plan(scene, effects(), SUPERSAMPLED), (side, side)).render().radiance
    world = World.of(scene)
    batches = np.stack([render_batch(world, (side, side), 1, 7, number) for number in range(count)])
    folder.mkdir(parents=True, exist_ok=True)
    np.savez(path, batches=batches, frame=frame)
    return Pool(scene.name, batches, frame)
