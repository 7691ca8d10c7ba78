"""`[[candidate]]` in lightmeter.toml:

    [[candidate]]
    name = "our engine"
    command = "engine --scene {gltf} --camera {camera_json} --size {w}x{h} --out {exr}"
    timeout = 120                       # seconds
    environment = { ENGINE_DEVICE = "0" }
    register = ["exposure"]             # correct this before measuring, and say so
    unsupported = { materials = ["glass"], background = true }

In place of `command`: `file = "frames/{name}.exr"`, or `renderer = "NAME"`, which an installed package registers.
"""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from lightmeter.candidates.candidate import DEFAULT_TIMEOUT, Candidate, Transfer, Unsupported
from lightmeter.scenes.validation import Strict

Name = Annotated[str, Field(strict=True, min_length=1, max_length=1000)]
FaultName = Literal["flip", "shift", "field_of_view", "transfer", "exposure", "alpha"]


class UnsupportedEntry(Strict):
    """What the engine cannot draw, by the scene's names."""

    materials: tuple[Name, ...] = ()
    objects: tuple[Name, ...] = ()
    background: Annotated[bool, Field(strict=True)] = False


class CandidateEntry(Strict):
    """One `[[candidate]]`."""

    name: Name
    file: Name | None = None
    command: Name | None = None
    renderer: Name | None = None
    transfer: Transfer | None = None
    exposure: Annotated[float, Field(strict=True, ge=-64, le=64, allow_inf_nan=False)] | None = None
    timeout: Annotated[float, Field(gt=0, le=1e6, allow_inf_nan=False)] = DEFAULT_TIMEOUT
    environment: dict[Name, Annotated[str, Field(strict=True, max_length=10000)]] = Field(default={})
    correct: Annotated[tuple[FaultName, ...], Field(alias="register")] = ()
    unsupported: UnsupportedEntry = UnsupportedEntry()

    @model_validator(mode="after")
    def _one_source(self):
        if sum(getattr(self, source) is not None for source in ("file", "command", "renderer")) != 1:
            raise ValueError("a candidate has one of file, command and renderer")
        return self

    def candidate(self, folder: Path) -> Candidate:
        """The candidate; a file's path is relative to `folder`, that of lightmeter.toml."""
        asked = self.unsupported
        common = {
            "transfer": self.transfer,
            "exposure": self.exposure,
            "timeout": self.timeout,
            "environment": tuple(sorted(self.environment.items())),
            "register": self.correct,
            "unsupported": Unsupported(asked.materials, asked.objects, asked.background),
        }
        if self.file is not None:
            return Candidate(self.name, "file", str(folder / self.file), **common)
        if self.command is not None:
            return Candidate(self.name, "command", self.command, **common)
        assert self.renderer is not None
        return Candidate(self.name, "renderer", self.renderer, **common)
