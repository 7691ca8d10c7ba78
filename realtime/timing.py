"""Times of passes and frames (design, section 5)."""

import time
from collections.abc import Callable, Sequence
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
    def of(cls, milliseconds: Sequence[float]) -> "Time":
        """The summary of single times."""
        median = float(np.median(milliseconds))
        return cls(median, float(np.median(np.abs(np.array(milliseconds) - median))), len(milliseconds))


@dataclass(frozen=True)
class Recording:
    """Single times of one run of frames, in milliseconds.

    Attributes:
        frame: the whole frame, once per frame.
        passes: (pass, effect, its times, once per frame).
        sampling: the effect that draws the frame more than once; "" where it is drawn once.
        method: how it was timed.
        disagreement: see `Clock`.
    """

    frame: list[float]
    passes: list[tuple[str, str, list[float]]]
    sampling: str
    method: str
    disagreement: float

    def rounds(self, effect: str) -> np.ndarray:
        """(frames,): what an effect's passes took together in each round; the whole frame where `effect` is "".

        What the further samples of a frame cost is the whole less one sample's passes, as in `summarise`.
        """
        whole = np.array(self.frame)
        if not effect:
            return whole
        total = np.sum([times for _, name, times in self.passes if name == effect], axis=0) + np.zeros(len(whole))
        if effect == self.sampling:
            total += np.maximum(0.0, whole - np.sum([times for _, _, times in self.passes], axis=0))
        return total


@dataclass(frozen=True, eq=False)
class Times:
    """What the frame costs.

    Attributes:
        frame: the whole frame, undisturbed.
        passes: (pass, effect, time); the G-buffer belongs to no effect ("").
        method: how it was timed.
        disagreement: see `Clock`.
    """

    frame: Time
    passes: tuple[tuple[str, str, Time], ...]
    method: str
    disagreement: float = 0.0

    def of(self, effect: str) -> Time | None:
        """An effect's passes together; spreads are added, which can only overstate them."""
        found = [time for _, name, time in self.passes if name == effect]
        if not found:
            return None
        return Time(sum(t.median for t in found), sum(t.mad for t in found), found[0].frames)

    @property
    def doubt(self) -> str:
        """Why the times may be wrong, a sentence; "" where nothing speaks against them."""
        if self.disagreement <= CREDIBLE:
            return ""
        return (
            f"Timer queries claimed up to {self.disagreement:.1f} times the wall time that had passed, which cannot "
            "be: this driver's times are not to be trusted."
        )


CREDIBLE = 1.05
"""A query's time over the wall time around it, at most: both clocks tick in steps."""


def summarise(recordings: Sequence[Recording]) -> Times:
    """The summary of one plan's runs of frames, as if they had been one."""
    first = recordings[0]
    whole = Time.of([t for recording in recordings for t in recording.frame])
    passes = [
        (name, effect, Time.of([t for recording in recordings for t in recording.passes[index][2]]))
        for index, (name, effect, _) in enumerate(first.passes)
    ]
    if first.sampling:
        # What the further samples cost is the whole less one sample's passes and the display's.
        rest = max(0.0, whole.median - sum(t.median for _, _, t in passes))
        passes.append((f"{first.sampling} · further samples", first.sampling, Time(rest, 0.0, whole.frames)))
    return Times(whole, tuple(passes), first.method, max(recording.disagreement for recording in recordings))


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
