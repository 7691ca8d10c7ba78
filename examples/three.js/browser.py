"""A headless Chromium that shows one page of a local server, and ends with the block."""

import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome")
FLAGS = (
    "--headless",
    "--use-gl=angle",
    "--use-angle=gl-egl",  # Mesa's driver, llvmpipe where there is no GPU
    "--ignore-gpu-blocklist",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-dev-shm-usage",
    "--disable-sync",
    "--no-first-run",
    "--no-pings",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
)
GRACE = 1.0  # seconds to end by itself
SHOWN = 2000  # characters of what it said


@contextlib.contextmanager
def open_page(url: str) -> Iterator[subprocess.Popen]:
    """The browser's process, with a fresh profile. Its last messages are shown if the block gives up."""
    program = next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        raise SystemExit(f"no browser found: install one of {', '.join(NAMES)} (Debian: apt-get install chromium)")
    flags = [*FLAGS, "--no-sandbox"] if os.geteuid() == 0 else FLAGS  # root cannot have the sandbox
    with _fresh_folder() as profile, tempfile.TemporaryFile() as log:
        words = [program, *flags, f"--user-data-dir={profile}", url]
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        try:
            yield process
        except SystemExit:
            log.seek(0)
            sys.stderr.write(log.read().decode("utf-8", "replace")[-SHOWN:])
            raise
        finally:
            process.terminate()
            try:
                process.wait(GRACE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


@contextlib.contextmanager
def _fresh_folder() -> Iterator[Path]:
    """A folder that is removed afterwards; children of an ended browser write there for a moment longer."""
    folder = Path(tempfile.mkdtemp(prefix="three-"))
    try:
        yield folder
    finally:
        end = time.monotonic() + GRACE
        while folder.exists() and time.monotonic() < end:
            shutil.rmtree(folder, ignore_errors=True)
