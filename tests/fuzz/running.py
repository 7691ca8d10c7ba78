"""Mutated files given to a loader in a child process, whose time per input and memory are bounded.

The child dies of a hang (its alarm ends it, whatever native code it is in) or of a crash; the file that it was at is
then still there, and the next child goes on behind it. An input follows from the loader, the seed and its number.
"""

import faulthandler
import hashlib
import json
import multiprocessing
import resource
import signal
import tempfile
import traceback
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random

from .loaders import DOCUMENTED, Loader, put_neighbours
from .mutation import mutated

SECONDS = 10.0
"""Real time that one input may take; the slowest sound file takes a hundredth of it on an idle machine."""
MEMORY = 2 << 30
"""Bytes of address space that a child may add to what it has when its imports are done."""


@dataclass(frozen=True)
class Finding:
    """An input that a loader did not answer as documented.

    Attributes:
        loader: its name.
        what: the exception's last frame and message, or how the process ended.
        data: the file.
    """

    loader: str
    what: str
    data: bytes

    @property
    def name(self) -> str:
        """Under which it is kept as a regression case."""
        return f"{self.loader}-{hashlib.sha256(self.data).hexdigest()[:12]}"


@dataclass(frozen=True)
class Outcome:
    """What came of the inputs to one loader: how many were read, and how many refused as documented."""

    read: int
    refused: int
    findings: tuple[Finding, ...]


def fault(loader: Loader, path: Path) -> str | None:
    """What is wrong with a loader's answer to the file at `path`: None, "" where it refused it as documented."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            loader.read(path)
        except DOCUMENTED as error:
            return f"a message of several lines: {error!r}" if "\n" in str(error) else ""
        except Exception as error:
            frame = traceback.extract_tb(error.__traceback__)[-1]
            return f"{type(error).__name__}: {error} at {Path(frame.filename).name}:{frame.lineno}"
    return None


def fuzz(loader: Loader, inputs: int, seed: int = 0) -> Outcome:
    """Gives a loader mutated files."""
    findings: dict[str, Finding] = {}
    read = refused = start = 0

    def add(what: str, data: bytes) -> None:
        findings.setdefault(_place(what), Finding(loader.name, what, data))

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        put_neighbours(folder)
        while start < inputs:
            child = multiprocessing.get_context("fork").Process(
                target=_child, args=(loader, folder, range(start, inputs), seed)
            )
            child.start()
            child.join()
            for line in (folder / "findings").read_text().splitlines():
                what, data = json.loads(line)
                add(what, bytes.fromhex(data))
            number, *counts = map(int, (folder / "at").read_text().split())
            read, refused, start = read + counts[0], refused + counts[1], number + 1
            if child.exitcode != 0:
                hung = child.exitcode == -signal.SIGALRM
                what = f"no answer within {SECONDS:g} s" if hung else f"the process ended with {child.exitcode}"
                add(what, (folder / loader.file).read_bytes())
    return Outcome(read, refused, tuple(findings.values()))


def _child(loader: Loader, folder: Path, numbers: Sequence[int], seed: int) -> None:
    held = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (held + MEMORY, held + MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    faulthandler.disable()  # a crash is a finding, told by the parent
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    path, read, refused = folder / loader.file, 0, 0
    with (folder / "findings").open("w") as findings:
        for number in numbers:
            random = Random(f"{loader.name} {seed} {number}")
            data = mutated(random.choice(loader.seeds), random)
            data = loader.repair(data) if random.random() < 0.5 else data
            path.write_bytes(data)
            (folder / "at").write_text(f"{number} {read} {refused}")
            signal.setitimer(signal.ITIMER_REAL, SECONDS)
            found = fault(loader, path)
            signal.setitimer(signal.ITIMER_REAL, 0)
            read, refused = read + (found is None), refused + (found == "")
            if found:
                print(json.dumps([found, data.hex()]), file=findings, flush=True)
    (folder / "at").write_text(f"{numbers[-1]} {read} {refused}")


def _place(what: str) -> str:
    """By which findings are told apart: the kind of exception and its place, not what it says of the input."""
    return f"{what.partition(':')[0]}{what.rpartition(' at ')[2]}"
