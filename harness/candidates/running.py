"""Runs an engine's command: within a time, with its last output kept, and nothing of it left behind."""

import contextlib
import os
import signal
import subprocess
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from lightmeter.candidates.failure import CandidateError

KEPT = 1 << 16
"""Bytes of a command's output that are kept: its end. The rest is read and let go, so that no pipe fills up."""
SHOWN = 400
"""Characters of it that a message shows."""
_CHUNK = 1 << 14
_GRACE = 2.0
"""Seconds between asking a command to end and ending it."""


@dataclass(frozen=True)
class Ran:
    """A command that ended well.

    Attributes:
        seconds: wall time from start to end.
        output: the end of what it printed, both streams.
    """

    seconds: float
    output: str


def run(words: Sequence[str], timeout: float, environment: Mapping[str, str], log: Path | None = None) -> Ran:
    """Run a command to its end.

    Args:
        words: the program and its arguments; no shell looks at them.
        timeout: seconds after which it is ended, with everything that it started.
        environment: variables beside those that there are.
        log: a file for the end of its output.

    Raises:
        CandidateError: it cannot be started, does not end in time, or ends with another code than 0.
    """
    start = time.perf_counter()
    try:
        process = subprocess.Popen(
            words,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={**os.environ, **environment},
            start_new_session=True,  # so that its children can be ended with it
        )
    except OSError as error:
        raise CandidateError(f"{words[0]!r} cannot be started: {error.strerror or error}; check the command") from None
    assert process.stdout is not None
    tail = _Tail(process.stdout)
    try:
        code = process.wait(timeout)
    except subprocess.TimeoutExpired:
        raise CandidateError(
            f"it did not end within {timeout:g} s{_last(tail.text())}; give it longer with --timeout, or with timeout "
            "in lightmeter.toml"
        ) from None
    finally:
        _end(process)
        tail.finish()
        if log is not None:
            log.write_text(tail.text(), encoding="utf-8")
    if code != 0:
        how = f"was ended by signal {-code}" if code < 0 else f"ended with exit code {code}"
        raise CandidateError(f"it {how}{_last(tail.text())}")
    return Ran(time.perf_counter() - start, tail.text())


class _Tail:
    """Reads a stream to its end and keeps the last of it."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._stream, self._kept = stream, b""
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def _read(self) -> None:
        with contextlib.suppress(ValueError, OSError):  # closed from the other side
            while chunk := os.read(self._stream.fileno(), _CHUNK):
                self._kept = (self._kept + chunk)[-KEPT:]

    def finish(self) -> None:
        """Wait for the rest, but not for a child that keeps the stream open."""
        self._thread.join(_GRACE)
        if not self._thread.is_alive():
            self._stream.close()

    def text(self) -> str:
        """What was kept, as far as it is printable."""
        text = self._kept.decode("utf-8", "replace")
        return "".join(letter if letter.isprintable() or letter == "\n" else " " for letter in text)


def _end(process: subprocess.Popen) -> None:
    """End the command and whatever it started, first by asking."""
    _signal(process, signal.SIGTERM)
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(_GRACE)
    _signal(process, signal.SIGKILL)
    process.wait()


def _signal(process: subprocess.Popen, number: signal.Signals) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, number)


def _last(output: str) -> str:
    """The last lines of an output, as the end of a message."""
    text = " ".join(output.split())
    if not text:
        return ", without any output"
    return f"; its last output: {'…' if len(text) > SHOWN else ''}{text[-SHOWN:]}"
