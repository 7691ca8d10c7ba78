"""Python source in child processes, which may die of what they try.

A child reports each fact as it learns it, so that what it knew before it died is not lost.
"""

import json
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

TIMEOUT = 120.0
"""Seconds for one probe. A cold import from a slow disk takes tens of seconds; a hang has no end."""

MISSING_LIBRARY = re.compile(r"(\S+\.so[\w.]*): cannot open shared object file.*")
"""The dynamic loader's words."""


@dataclass(frozen=True)
class Probe:
    """What a child process told, and how it ended: `error` is empty where it ended well."""

    facts: dict = field(default_factory=dict)
    error: str = ""


def run_probe(source: str, environ: Mapping[str, str], timeout: float = TIMEOUT) -> Probe:
    """Run Python source in a child process; a line of JSON on its standard output is a fact or several."""
    # -P: a user's own `drjit.py` or `metrics/` in the working directory is not what is being asked about.
    command = [sys.executable, "-P", "-c", source]
    try:
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, env=dict(environ), timeout=timeout, check=False
        )
    except subprocess.TimeoutExpired as late:
        return Probe(_facts(late.stdout or b""), f"it gave no answer within {timeout:g} s")
    return Probe(_facts(done.stdout), _ending(done.returncode, done.stderr))


def _facts(output: bytes) -> dict:
    """The facts among a child's lines; a driver may print lines of its own."""
    facts: dict = {}
    for line in output.decode(errors="replace").splitlines():
        if line.startswith("{"):
            try:
                facts |= json.loads(line)
            except ValueError:  # cut off by the child's death
                continue
    return facts


def _ending(code: int, stderr: bytes) -> str:
    """How a child ended, in words; empty where it ended well."""
    if code == 0:
        return ""
    if code < 0:
        known = {number.value for number in signal.Signals}
        name = signal.Signals(-code).name if -code in known else f"signal {-code}"
        return f"the process was killed by {name}"
    text = stderr.decode(errors="replace")
    # Dr.Jit's own handling of a library it cannot load fails in turn, so the last line is not the reason.
    library = MISSING_LIBRARY.search(text)
    if library:
        return library[0]
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else f"the process ended with code {code}"


def culprits(
    source: str, names: Sequence[str], environ: Mapping[str, str], works: Callable[[Probe], bool]
) -> list[str]:
    """The variables among `names` that are set, where the probe works once they are gone."""
    present = [name for name in names if name in environ]
    if not present:
        return []
    without = {name: value for name, value in environ.items() if name not in present}
    return present if works(run_probe(source, without)) else []
