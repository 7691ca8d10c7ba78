"""Gets a candidate's files: those that are there, or those that a command or a registered renderer makes."""

import re
import shlex
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.running import run
from lightmeter.failures import UsageError
from lightmeter.hints import nearest

PLACEHOLDERS = {
    "gltf": "the scene as glTF",
    "camera_json": "camera, lights and conventions",
    "environment": "the environment map, nothing where the scene has none",
    "w": "width in pixels",
    "h": "height in pixels",
    "exr": "where the image is expected",
    "json": "where times and the like are expected",
    "folder": "the folder of all these",
    "name": "the scene's name",
}
"""What a command's words may hold in braces."""

OF_FILES = ("name", "w", "h")
"""What a file's path may hold, so that one candidate serves several scenes."""


@dataclass(frozen=True)
class Job:
    """What a renderer is asked for.

    Attributes:
        gltf, camera_json: the exported scene.
        environment: its environment map; None where it has none.
        size: (width, height) in pixels.
        image: where the frame is expected, as OpenEXR.
        side_file: where times and the like are expected, as JSON; may be left out.
        scene: the scene's name.
    """

    gltf: Path
    camera_json: Path
    environment: Path | None
    size: tuple[int, int]
    image: Path
    side_file: Path
    scene: str = ""

    @property
    def words(self) -> dict[str, str]:
        """Each placeholder's value."""
        return {
            "gltf": str(self.gltf),
            "camera_json": str(self.camera_json),
            "environment": str(self.environment or ""),
            "w": str(self.size[0]),
            "h": str(self.size[1]),
            "exr": str(self.image),
            "json": str(self.side_file),
            "folder": str(self.gltf.parent),
            "name": self.scene,
        }


@dataclass(frozen=True)
class Files:
    """What a candidate left.

    Attributes:
        seconds: wall time of the command; None where there was none.
    """

    image: Path
    side_file: Path
    seconds: float | None = None


def fill(text: str, values: Mapping[str, str], what: str) -> str:
    """`text` with its placeholders filled in.

    Raises:
        UsageError: it holds one that does not exist; names the nearest.
    """

    def value(match: re.Match) -> str:
        if match[1] not in values:
            raise UsageError(f"{what}: there is no placeholder {{{match[1]}}}; {nearest(match[1], list(values))}")
        return values[match[1]]

    return re.sub(r"\{(\w+)\}", value, text)


def check(candidate: Candidate) -> None:
    """What can be told before anything is rendered.

    Raises:
        UsageError: a placeholder or a renderer does not exist, or a command cannot be split into words.
    """
    what = f"candidate {candidate.name!r}"
    if candidate.source == "renderer":
        find_renderer(candidate.text)
        return
    known = PLACEHOLDERS if candidate.source == "command" else OF_FILES
    fill(candidate.text, dict.fromkeys(known, ""), what)
    if candidate.source == "command" and not _split(candidate.text, what):
        raise UsageError(f"{what}: expected a command, got an empty text")


def obtain(candidate: Candidate, job: Job) -> Files:
    """The candidate's files for one scene and size.

    Raises:
        CandidateError: its command failed, or the file that it should leave is not there.
    """
    if candidate.source == "file":
        image = Path(fill(candidate.text, {key: job.words[key] for key in OF_FILES}, candidate.name))
        return Files(image, image.with_suffix(".json"))
    if candidate.source == "renderer":
        words = [sys.executable, "-m", "lightmeter.candidates.rendering", candidate.text]
        words += [job.words[key] for key in ("gltf", "camera_json", "environment", "w", "h", "exr", "name")]
    else:
        words = [fill(word, job.words, candidate.name) for word in _split(candidate.text, candidate.name)]
    for path in (job.image, job.side_file):
        path.unlink(missing_ok=True)  # what an earlier run left must not pass for this one's
    log = job.image.with_suffix(".log")
    ran = run(words, candidate.timeout, dict(candidate.environment), log)
    if not job.image.is_file():
        said = " ".join(ran.output.split())[-400:]
        raise CandidateError(
            f"it ended well, but there is no image at {job.image}; write it where {{exr}} says"
            + (f"; its last output: {said}" if said else "")
        )
    return Files(job.image, job.side_file, ran.seconds)


def find_renderer(name: str):
    """The entry point of a renderer that an installed package registers.

    Raises:
        UsageError: there is none of that name; names the nearest.
    """
    from importlib.metadata import entry_points

    known = {point.name: point for point in entry_points(group="lightmeter.renderers")}
    if name not in known:
        raise UsageError(
            f"there is no renderer {name!r} among the installed packages' entry points `lightmeter.renderers`; "
            + (nearest(name, list(known)) if known else "there is none at all")
        )
    return known[name]


def _split(text: str, what: str) -> list[str]:
    try:
        return shlex.split(text)
    except ValueError as error:
        raise UsageError(f"{what}: the command cannot be split into words ({error}): {text[:200]}") from None
