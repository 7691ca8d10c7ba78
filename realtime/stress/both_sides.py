"""A BRDF on both sides: what its float64 twin gives, and what the device gives at the same inputs."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..device import Device
from ..glsl_on_device import FunctionOnDevice
from ..twin import Twin
from .design import Inputs
from .judging import exact_results

AT_ONCE = 1 << 19
"""Lanes of one draw: an argument's textures hold 64 bytes for each."""


@dataclass(frozen=True)
class Extreme:
    """Where a law is furthest from being kept.

    Attributes:
        inputs: argument to its components.
        model: by the float64 twin, of directions of length 1.
        given: by the float64 twin of these inputs as they are, directions with the lengths that float32 gives them.
        device: by the device. Infinite, as the others are, where a result is not finite.
        error: by how much each may err itself.
    """

    inputs: dict[str, list[float]]
    model: float
    given: float
    device: float
    error: float = 0.0


class BothSides:
    """A function that its twin declares to be a BRDF.

    Args:
        folder: where the twin's file lies.
    """

    def __init__(self, device: Device, twin: Twin, folder: Path) -> None:
        assert twin.brdf is not None
        self.twin, self.brdf = twin, twin.brdf
        self.arguments = [argument for argument in twin.arguments if not argument.out]
        self._function = FunctionOnDevice(device, twin, folder)

    def model(self, inputs: Inputs) -> np.ndarray:
        """(channels, n) of the twin."""
        return exact_results(self.twin, inputs)[0]

    def device(self, inputs: Inputs) -> np.ndarray:
        """(channels, n) of the device."""
        count = inputs[0].shape[1]
        parts = (self._function([x[:, i : i + AT_ONCE] for x in inputs])[0] for i in range(0, count, AT_ONCE))
        return np.concatenate(list(parts), axis=1)
