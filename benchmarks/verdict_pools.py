"""Pools of stored 1-spp batches of real scenes, and the frame that is judged against them."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.world import World
from lightmeter.metrics.moments import Moments
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load


@dataclass(frozen=True, eq=False)
class Pool:
    """Independent batches of one sample a pixel. Drawn from with replacement, their truth is their mean, exactly.

    Attributes:
        name: of the candidate.
        batches: (N, H, W, 3) float32.
        frame: (H, W, 3) float32, the real-time frame.
    """

    name: str
    batches: np.ndarray
    frame: np.ndarray

    @cached_property
    def _moments(self) -> Moments:
        return Moments.of([self.frame], list(self.batches))

    def comparison(self, groups: np.ndarray, confidence: float) -> Any:
        """What the squared error asks of a `Comparison` of the frame with the means of groups of batches.

        Its sums follow from the pool's own, which are taken once: a gate then touches no image.

        Args:
            groups: (K, n) numbers of batches.
        """
        m, (k, n) = self._moments, groups.shape
        flat = groups.ravel()
        gram = m.gram[flat[:, None], flat].reshape(k, n, k, n).sum(axis=3).sum(axis=1) / n**2
        means = (part[groups].mean(axis=1) for part in (m.difference_means, m.reference_means))
        moments = Moments(m.values, gram, np.zeros((0, 0)), *means)  # relmse alone asks for the reference's own
        return SimpleNamespace(moments=moments, confidence=confidence, unusable=lambda: False)

    @cached_property
    def rmse(self) -> float:
        """The frame's error against the truth of this pool."""
        truth = self.batches.mean(axis=0, dtype=np.float64)
        return float(np.sqrt(np.mean((self.frame - truth) ** 2)))


def pool(name: str, source: str, without: tuple[str, ...], side: int, count: int, device: Device, folder: Path) -> Pool:
    """The pool of a scene, kept in `folder`: rendering it takes a minute or two.

    Args:
        name: of the candidate.
        without: effects that the frame is drawn without. It is supersampled, so that its error is not that of the few
            pixels at edges where the noise is as well.
        side: pixels each way.
        count: how many batches.
    """
    scene = load(source)
    choice = Choice(without=without, settings={"supersampling": {"grid": 4}})
    frame = Renderer(device, compile_plan(scene, effects(), choice), (side, side)).render().radiance
    path = folder / f"{scene.name}-{side}-{count}.npz"
    if path.exists():
        with np.load(path) as known:
            return Pool(name, known["batches"], frame)
    world = World.of(scene)
    batches = np.stack([render_batch(world, (side, side), 1, 7, number) for number in range(count)])
    folder.mkdir(parents=True, exist_ok=True)
    np.savez(path, batches=batches)
    return Pool(name, batches, frame)
