"""The JSON file that an engine may leave beside its image: times, encoding, what it cannot draw."""

import json
from pathlib import Path
from typing import Annotated

from pydantic import Field, ValidationError

from lightmeter.candidates.candidate import Transfer
from lightmeter.candidates.failure import CandidateError
from lightmeter.scenes.validation import Strict, explain

LARGEST = 1 << 20
"""Bytes of a side file."""

Words = Annotated[str, Field(strict=True, max_length=1000)]
Milliseconds = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)]


class TimeEntry(Strict):
    """The time of a frame, the median over several."""

    median: Milliseconds
    mad: Milliseconds = 0.0
    frames: Annotated[int, Field(ge=1)] = 1


class UnsupportedEntry(Strict):
    """What the engine cannot draw, by the scene's names."""

    materials: tuple[Words, ...] = ()
    objects: tuple[Words, ...] = ()
    background: Annotated[bool, Field(strict=True)] = False


class SideFile(Strict):
    """Everything an engine may say of its frame."""

    engine: Words = ""
    device: Words = ""
    transfer: Transfer | None = None
    exposure: Annotated[float, Field(ge=-64, le=64, allow_inf_nan=False)] | None = None
    time_ms: Milliseconds | TimeEntry | None = None
    unsupported: UnsupportedEntry = UnsupportedEntry()
    notes: tuple[Words, ...] = ()

    @property
    def time(self) -> TimeEntry | None:
        """The time with its spread, however it is written."""
        if self.time_ms is None or isinstance(self.time_ms, TimeEntry):
            return self.time_ms
        return TimeEntry(median=self.time_ms)


def read_side_file(path: Path) -> SideFile:
    """What the file says; nothing where there is none.

    Raises:
        CandidateError: it is too large, no JSON, or does not follow the schema; names the place.
    """
    if not path.is_file():
        return SideFile()
    if path.stat().st_size > LARGEST:
        raise CandidateError(f"{path}: expected a side file of at most {LARGEST} bytes, got {path.stat().st_size}")
    try:
        content = json.loads(path.read_bytes())
    except (ValueError, RecursionError) as error:
        raise CandidateError(f"{path}: this is no JSON ({str(error)[:200]})") from None
    try:
        return SideFile.model_validate(content)
    except ValidationError as error:
        raise CandidateError(str(explain(error, content, str(path)))) from None
