"""Whole processes, as a user starts them: `lightmeter compare` cold and again, and `lightmeter --help`."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from figures import Figure

COMPARE = ("compare", "cornell-box", "--size", "512x512")
HELP_RUNS = 11


def measure() -> list[Figure]:
    """Compare with nothing cached, from the store, and with compiled kernels alone; `--help`."""
    with tempfile.TemporaryDirectory(prefix="lightmeter-bench-") as folder:
        # Dr.Jit keeps compiled kernels, and Mesa compiled shaders, in the home folder: cold is without those, too.
        fresh = {"HOME": folder, "XDG_CACHE_HOME": f"{folder}/cache", "LIGHTMETER_STORE": f"{folder}/store"}
        output = ("-o", f"{folder}/out")
        first = _seconds(*COMPARE, *output, **fresh)
        again = _seconds(*COMPARE, *output, **fresh)
        compiled = _seconds(*COMPARE, *output, **fresh | {"LIGHTMETER_STORE": f"{folder}/other-store"})
        helps = [_seconds("--help") for _ in range(HELP_RUNS)]
    return [
        Figure("compare cornell-box, cold", first, "s", 60, "empty store, no compiled kernels or shaders"),
        Figure("compare cornell-box, from the store", again, "s", 5, "the same command again"),
        Figure("compare cornell-box, empty store", compiled, "s", None, "kernels and shaders compiled before"),
        Figure("--help", float(np.median(helps)), "s", 0.3, f"median of {HELP_RUNS}"),
    ]


def _seconds(*words: str, **environment: str) -> float:
    """The wall time of `lightmeter WORDS`, which must succeed."""
    start = time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-m", "lightmeter", *words],
        env=os.environ | environment,
        cwd=Path(tempfile.gettempdir()),  # so that no folder of a checkout is imported by mistake
        capture_output=True,
        text=True,
        check=False,
    )
    taken = time.perf_counter() - start
    if done.returncode:
        raise SystemExit(f"lightmeter {' '.join(words)} ended with exit code {done.returncode}:\n{done.stderr}")
    return taken
