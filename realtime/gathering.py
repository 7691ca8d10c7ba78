"""What becomes of a pixel's samples: their mean, or what the effect that chose them makes of them."""

from importlib import import_module

import numpy as np

from lightmeter.scenes.points import SurfacePoints

from .averager import Averager
from .device import Device
from .graph import Plan
from .stage import Stage


class Mean:
    """The mean of samples that are drawn one after another.

    Attributes:
        texture: what they have come to.
    """

    def __init__(self, device: Device, size: tuple[int, int], count: int) -> None:
        self._averager, self._count = Averager(device), count
        self.texture = device.target(size)
        self._framebuffer = device.framebuffer([self.texture])

    def clear(self) -> None:
        """Begin with the first sample."""
        self._framebuffer.clear()

    def add(self, radiance) -> None:
        """Take one more, a texture of scene-linear radiance."""
        self._averager.add(radiance, self._framebuffer, 1.0 / self._count)


def gatherer(stage: Stage, plan: Plan, count: int):
    """What gathers a frame's samples on the device; None where one sample is the frame."""
    module = _own(plan, "passes")
    if module is not None:
        effect, knobs = plan.effects[plan.sampler or ""]
        return module.Passes(stage, knobs, effect.folder)
    return Mean(stage.device, stage.size, count) if count > 1 else None


def gathered(plan: Plan, samples: np.ndarray, points: SurfacePoints) -> np.ndarray:
    """The twin of what gathers them: (H, W, 3) float32 of the frame's samples in order.

    Args:
        samples: (n, H, W, 3) radiance.
        points: (n, H, W), what was seen there.
    """
    module = _own(plan, "twin")
    if module is None:
        return samples.mean(axis=0, dtype=np.float64).astype(np.float32)
    return module.gathered(samples, points, plan.scene.camera, plan.effects[plan.sampler or ""][1])


def _own(plan: Plan, name: str):
    """A module of the effect that chooses the samples; None where it has no passes of its own."""
    effect = plan.effects[plan.sampler][0] if plan.sampler else None
    if effect is None or not (effect.folder / "passes.py").is_file():
        return None
    return import_module(f"{__package__}.effects.{effect.name}.{name}")
