"""Times of passes and frames (design, section 5)."""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .device import Device


@dataclass(frozen=True)
class Time:
    """Milliseconds: the median over `frames` frames and the median absolute deviation from it."""

    median: float
    mad: float
    frames: int

    @classmethod
    def of(cls, milliseconds: list[float]) -> "Time":
        """The summary of single times."""
        median = float(np.median(milliseconds))
        return cls(median, float(np.median(np.abs(np.array(milliseconds) - median))), len(milliseconds))


class Clock:
    """Times what is drawn.

    A software rasteriser defers its work beyond a timer query's end (0.04 ms were reported for a pass of 2.2 ms), so
    there wall time around `glFinish` counts. On hardware it is the timer query, and `disagreement` keeps the largest
    ratio by which wall time fell short of it, which can only be a broken query.
    """

    def __init__(self, device: Device) -> None:
        self._device = device
        self.method = "wall time around glFinish" if device.software else "timer query"
        self.disagreement = 0.0

    def measure(self, draw: Callable[[], None]) -> float:
        """Milliseconds that `draw` takes on the device."""
        self._device.finish()
        start = time.perf_counter()
        if self._device.software:
            draw()
            self._device.finish()
            return (time.perf_counter() - start) * 1e3
        query = self._device.gl.query(time=True)
        with query:
            draw()
        self._device.finish()
        wall = (time.perf_counter() - start) * 1e3
        queried = query.elapsed * 1e-6
        self.disagreement = max(self.disagreement, queried / max(wall, 1e-9))
        return queried
