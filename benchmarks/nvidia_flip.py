"""Times flip-evaluator on the images of a file: `nvidia_flip.py IMAGES.npz RESULTS.npz RUNS`."""

import sys
import time

import flip_evaluator
import numpy as np


def main(images: str, results: str, runs: int) -> None:
    """Writes, per mode, the median of the seconds and the mean error."""
    pictures, found = np.load(images), {}
    for mode in ("LDR", "HDR"):
        tested, reference = pictures[f"{mode}_0"], pictures[f"{mode}_1"]
        seconds, mean = [], 0.0
        for _ in range(runs + 1):  # the first warms up
            start = time.perf_counter()
            _, mean, _ = flip_evaluator.evaluate(reference, tested, mode, applyMagma=False)
            seconds.append(time.perf_counter() - start)
        found[mode] = np.array([np.median(seconds[1:]), mean])
    np.savez(results, **found)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
