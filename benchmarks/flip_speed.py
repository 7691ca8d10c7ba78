"""FLIP beside NVIDIA's flip-evaluator: same images, same run."""

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from figures import Figure

from lightmeter.metrics.flip import hdr_flip, ldr_flip

RUNS = 7
CHILD = Path(__file__).with_name("nvidia_flip.py")


def measure(frame: np.ndarray, truth: np.ndarray, display: Callable[[np.ndarray], np.ndarray]) -> list[Figure]:
    """Seconds of LDR- and HDR-FLIP, ours and theirs, and how far the means are apart.

    Args:
        frame, truth: (H, W, 3) scene-linear.
        display: their display transform, for LDR.
    """
    pairs = {
        "LDR": tuple(np.ascontiguousarray(display(image), np.float32) for image in (frame, truth)),
        "HDR": tuple(np.ascontiguousarray(np.maximum(image, 0), np.float32) for image in (frame, truth)),
    }
    theirs = _theirs(pairs)
    figures = []
    for mode, function in (("LDR", ldr_flip), ("HDR", lambda t, r: hdr_flip(t, r).error)):
        seconds, error = _median(function, *pairs[mode])
        their_seconds, their_mean = theirs[mode]
        mean = float(error.mean(dtype=np.float64))
        apart = f"mean {mean:.5f}, theirs {their_mean:.5f}"
        figures += [
            Figure(f"{mode}-FLIP", seconds * 1e3, "ms", their_seconds * 1e3, apart),
            Figure(f"{mode}-FLIP, flip-evaluator", their_seconds * 1e3, "ms", None, f"median of {RUNS}"),
        ]
    return figures


def _median(function: Callable, tested: np.ndarray, reference: np.ndarray) -> tuple[float, np.ndarray]:
    error = function(tested, reference)
    seconds = []
    for _ in range(RUNS):
        start = time.perf_counter()
        error = function(tested, reference)
        seconds.append(time.perf_counter() - start)
    return float(np.median(seconds)), error


def _theirs(pairs: dict[str, tuple[np.ndarray, np.ndarray]]) -> dict[str, tuple[float, float]]:
    """Mode to their seconds and mean; in a child process, which their program may end."""
    with tempfile.TemporaryDirectory(prefix="lightmeter-bench-") as folder:
        images, results = Path(folder, "images.npz"), Path(folder, "results.npz")
        np.savez(images, **{f"{mode}_{i}": image for mode, pair in pairs.items() for i, image in enumerate(pair)})
        subprocess.run([sys.executable, str(CHILD), str(images), str(results), str(RUNS)], check=True)
        found = np.load(results)
        return {mode: (float(found[mode][0]), float(found[mode][1])) for mode in pairs}
